// Reads meshes of Abaqus and CalculiX decks (.inp): nodes and solid elements, with parts and their instances. What does
// not change the mesh is ignored.
#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "base/math/degrees.h"
#include "base/text/text.h"
#include "formats/results/deck_part.h"
#include "formats/results/deck_sets.h"
#include "formats/results/deck_shells.h"
#include "formats/results/results_readers.h"

namespace ombre::formats {
namespace {

// Families of solid elements, by what stands before the number of nodes in names such as "C3D10M", "DC3D4", "SC8R".
constexpr auto solid_families = std::to_array<std::string_view>({"c3d", "q3d", "sc", "coh3d", "gk3d", "css"});

// Returns the number of nodes of a solid element type; null for other types. Solid types have one or two digits.
std::optional<size_t> solid_nodes(std::string_view type) {
  for (const std::string_view family : solid_families) {
    const size_t at = type.find(family);
    if (at == std::string_view::npos || (family != "c3d" && at != 0)) continue;
    std::string_view digits = type.substr(at + family.size());
    digits = digits.substr(0, digits.find_first_not_of("0123456789"));
    const auto count = digits.size() <= 2 ? parse_number(digits) : std::nullopt;
    if (count) return static_cast<size_t>(*count);
  }
  return std::nullopt;
}

std::optional<ElementKind> kind_of_nodes(size_t count) {
  for (const ElementKind kind : {ElementKind::tetrahedron4, ElementKind::tetrahedron10, ElementKind::brick8,
                                 ElementKind::brick20, ElementKind::wedge6, ElementKind::pyramid5})
    if (node_count(kind) == count) return kind;
  return std::nullopt;
}

// Keywords that change the mesh, and are not read.
constexpr auto unread_keywords =
    std::to_array<std::string_view>({"*nmap", "*imperfection", "*symmetric model generation", "*import", "*adjust",
                                     "*refine mesh", "*crack propagation", "*substructure"});

// A system of coordinates in which nodes are given (*SYSTEM): points a, b on its x axis, c in its xy plane.
Affine system_of(const DeckLine& line, const std::vector<double>& numbers) {
  const auto point = [&](size_t n) {
    const auto at = [&](size_t i) { return i < numbers.size() ? numbers[i] : 0.0; };
    return Vec3{at(3 * n), at(3 * n + 1), at(3 * n + 2)};
  };
  if (numbers.size() <= 3) return Affine::translation(point(0));
  const Vec3 origin = point(0), along = point(1) - origin;
  const Vec3 other = numbers.size() > 6 ? point(2) - origin : Vec3{-along.y, along.x, 0};
  const Vec3 up = cross(along, other);
  if (!(length(along) > 0) || !(length(up) > 0)) line.fail("the points of the system lie on a line");
  const Vec3 x = 1 / length(along) * along, z = 1 / length(up) * up, y = cross(z, x);
  return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, origin};
}

// Returns the turn about the axis from one point to another that a line of *INSTANCE or *NCOPY describes.
Affine turn_of(const DeckLine& line, const std::vector<double>& numbers) {
  if (numbers.size() < 7) line.fail("expected two points of the axis and an angle in degrees");
  const Vec3 a{numbers[0], numbers[1], numbers[2]}, b{numbers[3], numbers[4], numbers[5]};
  if (!(length(b - a) > 0)) line.fail("the two points of the axis are the same");
  return Affine::translation(a) * Affine::rotation(b - a, numbers[6]) * Affine::translation(-a);
}

struct DeckInstance {
  std::string part;
  Affine move;
  DeckLine line;
  DeckPart own;  // nodes and elements that stand in the instance itself
};

class InpReader : public DeckListener {
 public:
  InpReader(const std::string& name, Diagnostics& diagnostics) : name_(name), diagnostics_(diagnostics) {}

  NumberedResults take() { return std::move(result_); }

  void keyword(const Keyword& keyword) override {
    finish_block();
    keyword_ = keyword;
    data_lines_ = 0;
    if (std::ranges::find(unread_keywords, keyword.name) != unread_keywords.end())
      keyword.line.fail(keyword.name + " changes the mesh and is not read", "save the mesh that it makes");
    enter_scope();
    sets_.note_names(keyword);
    if (keyword.name == "*node") system_here_ = system_letter();
    if (keyword.name == "*element") begin_elements();
    if (keyword.name == "*system") part().system = Affine();
    if (keyword.name == "*normal") normals_ = keyword.line;
    section_ = nullptr;
    if (keyword.name == "*shell section" || keyword.name == "*shell general section") begin_section();
    if (keyword.name == "*elcopy") mesh().copy_elements(keyword);
    if (keyword.name == "*model change" && keyword.has("remove")) ++removed_;
  }

  void data(const DeckLine& line) override {
    ++data_lines_;
    const std::string& name = keyword_.name;
    if (name == "*node")
      add_node(line);
    else if (name == "*shell section" || name == "*shell general section")
      add_thickness(line);
    else if (name == "*element")
      add_element_numbers(line);
    else if (name == "*instance")
      move_instance(line);
    else if (name == "*system" || name == "*ncopy")
      block_.emplace_back(line);
    else if (name == "*surface")
      sets_.add_to_surface(keyword_, line, in_instance_ ? 0 : current_);
    else if ((name == "*nset" || name == "*elset") && keyword_.has("instance"))
      sets_.add_to_set_of_instance(keyword_, line);
    else if (name == "*nset")
      mesh().add_to_node_set(keyword_, line);
    else if (name == "*elset")
      mesh().add_to_element_set(keyword_, line);
    else if (name == "*ngen")
      mesh().generate_nodes(keyword_, line);
    else if (name == "*nfill")
      mesh().fill_nodes(keyword_, line);
    else if (name == "*elgen")
      generate_elements(line);
  }

  void end() override {
    finish_block();
    if (instances_.empty())
      for (size_t n = 0; n < parts_.size(); ++n) add_part(n, Affine());
    else
      add_instances();
    result_.results.sets = sets_.take();
    tell_left_out();
  }

 private:
  struct Part {
    std::string name;  // empty: what stands in no part
    DeckPart mesh;
    Affine system;  // in which nodes are given
  };

  Part& part() {
    if (parts_.empty()) parts_.push_back({});
    return parts_[in_instance_ ? 0 : current_];
  }
  DeckPart& mesh() { return in_instance_ ? instances_.back().own : part().mesh; }

  // Parts, instances and the assembly begin and end with keywords.
  void enter_scope() {
    if (parts_.empty()) parts_.push_back({});
    const std::string& name = keyword_.name;
    if (name == "*part") {
      parts_.push_back({keyword_.name_of("name"), {}, {}});
      current_ = parts_.size() - 1;
    } else if (name == "*end part") {
      current_ = 0;
    } else if (name == "*instance") {
      if (keyword_.has("library") || keyword_.has("instance"))
        keyword_.line.fail("the instance comes from another analysis, which is not read",
                           "save the deck with all of its parts");
      instances_.push_back({keyword_.name_of("part"), {}, keyword_.line, {}});
      in_instance_ = true;
    } else if (name == "*end instance") {
      in_instance_ = false;
    }
  }

  // Returns the letter of the system of *NODE: rectangular, cylindrical or spherical.
  char system_letter() const {
    const std::string system = keyword_.name_of("system");
    if (system.empty()) return 'r';
    if (system == "r" || system == "c" || system == "s") return system[0];
    keyword_.line.fail("expected SYSTEM=R, C or S, found " + formats::quoted(system));
  }

  void begin_elements() {
    const std::string type = keyword_.name_of("type");
    if (type.empty()) keyword_.line.fail("expected the type of the elements", "write for example TYPE=C3D8");
    const auto nodes = solid_nodes(type);
    is_shell_ = !nodes && thick_shell_kind(type);
    kind_ = nodes ? kind_of_nodes(*nodes) : thick_shell_kind(type);
    if (nodes && !kind_)
      keyword_.line.fail("elements of the type " + formats::quoted(type) + " are not read",
                         "read are C3D4, C3D10, C3D8, C3D20, C3D6 and C3D5");
    if (!kind_) left_out_.insert(keyword_.value("type"));
  }

  // Begins a section of shells, whose lines of data give the thickness. Without a material a general section has
  // stiffnesses in their place.
  void begin_section() {
    if (keyword_.has("nodal thickness") || keyword_.has("shell thickness"))
      keyword_.line.fail("shells with a thickness that varies are not read", "save the mesh of solids that they make");
    if (keyword_.name == "*shell general section" && !keyword_.has("material") && !keyword_.has("composite")) return;
    section_ = &mesh().add_shell_section({keyword_.name_of("elset"), 0, offset_of_section()});
  }

  double offset_of_section() const {
    if (!keyword_.has("offset")) return 0;
    const std::string offset = keyword_.name_of("offset");
    if (offset == "spos" || offset == "sneg") return offset == "spos" ? 0.5 : -0.5;
    const auto number = parse_number(offset);
    if (!number) keyword_.line.fail("expected OFFSET=SPOS, SNEG or a number, found " + formats::quoted(offset));
    return *number;
  }

  // The first line of a section has its thickness, each line of a composite one that of a layer.
  void add_thickness(const DeckLine& line) {
    if (!section_ || (data_lines_ > 1 && !keyword_.has("composite"))) return;
    const auto fields = line.fields();
    const auto thickness = fields.empty() ? std::nullopt : parse_number(fields[0]);
    if (!thickness || !(*thickness > 0)) line.fail("expected the thickness of the shells, above 0");
    section_->thickness_mm += *thickness;
  }

  void add_node(const DeckLine& line) {
    const std::vector<double> list = line.numbers();
    const auto at = [&](size_t n) { return n < list.size() ? list[n] : 0.0; };
    mesh().add_node(line, deck_number(line, list[0]), part().system(point({at(1), at(2), at(3)})),
                    keyword_.name_of("nset"));
  }

  // Angles are degrees. Source: Abaqus keywords reference guide, *NODE.
  Vec3 point(Vec3 given) const {
    using degrees::cosine, degrees::sine;
    if (system_here_ == 'r') return given;
    if (system_here_ == 'c') return {given.x * cosine(given.y), given.x * sine(given.y), given.z};
    return {given.x * cosine(given.z) * cosine(given.y), given.x * cosine(given.z) * sine(given.y),
            given.x * sine(given.z)};
  }

  void add_element_numbers(const DeckLine& line) {
    if (!kind_) {
      ++flat_;
      return;
    }
    if (element_.empty()) element_line_ = line;
    for (const double number : line.numbers()) element_.push_back(deck_number(line, number));
    if (element_.size() > nodes_of_element()) finish_element();
  }

  void finish_element() {
    if (element_.empty()) return;
    if (element_.size() != nodes_of_element() + 1)
      element_line_.fail("element " + std::to_string(element_[0]) + " has " + std::to_string(element_.size() - 1) +
                         " nodes; its type has " + std::to_string(nodes_of_element()));
    mesh().add_element(element_line_, element_[0], *kind_, std::span(element_).subspan(1), keyword_.name_of("elset"),
                       is_shell_);
    element_.clear();
  }

  size_t nodes_of_element() const { return is_shell_ ? DeckPart::shell_node_count(*kind_) : node_count(*kind_); }

  // Masters that are no solids have been left out, and so are the elements that they generate.
  void generate_elements(const DeckLine& line) {
    const auto master = line.numbers();
    if (!master.empty() && !left_out_.empty() && !mesh().has_element(deck_number(line, master[0])))
      ++flat_;
    else
      mesh().generate_elements(keyword_, line);
  }

  // The first line moves the instance, the second one turns it after that. A blank first line is passed over.
  void move_instance(const DeckLine& line) {
    Affine& move = instances_.back().move;
    const std::vector<double> list = line.numbers();
    if (data_lines_ == 1 && list.size() <= 3) {
      const auto at = [&](size_t n) { return n < list.size() ? list[n] : 0.0; };
      move = Affine::translation({at(0), at(1), at(2)});
    } else if (data_lines_ <= 2) {
      move = turn_of(line, list) * move;
    }
  }

  void finish_block() {
    finish_element();
    if (keyword_.name == "*system" && !block_.empty()) {
      std::vector<double> numbers;
      for (const DeckLine& line : block_)
        for (const double number : line.numbers()) numbers.push_back(number);
      part().system = system_of(block_.front(), numbers);
    }
    if (keyword_.name == "*ncopy") mesh().copy_nodes(keyword_, copy_move());
    block_.clear();
  }

  // Returns how *NCOPY moves nodes: by the first line, and turned by the second after that.
  Affine copy_move() const {
    if (!keyword_.has("shift") || keyword_.has("multiple"))
      keyword_.line.fail("*ncopy is read with SHIFT alone", "write out the nodes that it makes");
    Affine move;
    if (!block_.empty()) {
      std::vector<double> by = block_[0].numbers();
      by.resize(3, 0.0);
      move = Affine::translation({by[0], by[1], by[2]});
    }
    return block_.size() > 1 ? turn_of(block_[1], block_[1].numbers()) * move : move;
  }

  void add_instances() {
    std::vector<bool> is_used(parts_.size());
    for (DeckInstance& instance : instances_) {
      const auto part = std::ranges::find(parts_, instance.part, &Part::name);
      if (part == parts_.end() && instance.own.nodes().empty())
        instance.line.fail("there is no part " + formats::quoted(instance.part));
      if (part != parts_.end()) {
        const auto place = static_cast<size_t>(part - parts_.begin());
        is_used[place] = true;
        add_part(place, instance.move);
      }
      add(instance.own, instance.move);
      for (const ResultSet& set : instance.own.sets()) sets_.add(set.of, set.name, set.count);
    }
    for (size_t n = 0; n < parts_.size(); ++n) {
      if (parts_[n].name.empty())
        add_part(n, Affine());
      else if (!is_used[n] && !parts_[n].mesh.elements().empty())
        ++unused_parts_;
    }
  }

  void add_part(size_t n, const Affine& move) {
    add(parts_[n].mesh, move);
    sets_.count(parts_[n].mesh, n);
  }

  // Adds a copy of the mesh to the result.
  void add(const DeckPart& mesh, const Affine& move) {
    if (mesh.nodes().empty() && mesh.elements().empty()) return;
    if (!result_.results.points.empty()) result_.is_of_several_parts = true;
    const auto first = static_cast<uint32_t>(result_.results.points.size());
    for (const DeckPart::Node& node : mesh.nodes()) {
      result_.node_places.try_emplace(node.number, static_cast<uint32_t>(result_.results.points.size()));
      result_.results.points.push_back(move(node.at));
    }
    for (const DeckPart::Element& element : mesh.elements()) {
      if (element.is_shell) continue;
      std::array<uint32_t, 20> places{};
      size_t n = 0;
      for (const uint64_t node : mesh.nodes_of(element)) places[n++] = first + mesh.place_of(element, node);
      result_.element_places.try_emplace(element.number, static_cast<uint32_t>(result_.results.kinds.size()));
      result_.results.add_element(element.kind, places.data());
    }
    add_shells(ThickShells(mesh), move);
  }

  void add_shells(const ThickShells& shells, const Affine& move) {
    thin_ += shells.thin();
    if (shells.solids().empty()) return;
    if (normals_) normals_->fail("the normals of shells are not read", "save the mesh of solids that they make");
    const auto first = static_cast<uint32_t>(result_.results.points.size());
    for (size_t n = 0; n < shells.points().size(); ++n) {
      result_.copies.emplace_back(first + n, result_.node_places.at(shells.nodes()[n]));
      result_.results.points.push_back(move(shells.points()[n]));
    }
    for (ThickShells::Solid solid : shells.solids()) {
      for (uint32_t& point : solid.points) point += first;
      result_.element_places.try_emplace(solid.shell->number, static_cast<uint32_t>(result_.results.kinds.size()));
      result_.results.add_element(solid.shell->kind, solid.points.data());
    }
  }

  void tell_left_out() {
    const auto leave = [&](uint64_t count, const std::string& what) {
      leave_out(result_.results, name_, count, what, diagnostics_);
    };
    leave(flat_, "lines of elements that are no solids (" +
                     join(std::vector<std::string>(left_out_.begin(), left_out_.end()), ", ") + ")");
    leave(thin_, "shells without a thickness (*SHELL SECTION)");
    leave(unused_parts_, "parts of which the assembly has no instance");
    if (removed_ > 0)
      diagnostics_.warning({make_source(name_, ""), 0, 0}, "*model change removes elements in a step; they are read");
  }

  const std::string& name_;
  Diagnostics& diagnostics_;
  Keyword keyword_;  // of the lines of data that follow
  std::vector<DeckLine> block_;
  size_t data_lines_ = 0;
  std::vector<Part> parts_;  // the first is what stands in no part
  size_t current_ = 0;
  std::vector<DeckInstance> instances_;
  bool in_instance_ = false;
  char system_here_ = 'r';
  std::optional<ElementKind> kind_;  // null: neither a solid nor a shell
  bool is_shell_ = false;
  ShellSection* section_ = nullptr;  // which the lines of data belong to
  std::optional<DeckLine> normals_;  // the line of *NORMAL
  std::vector<uint64_t> element_;    // number of the element, followed by those of its nodes
  DeckLine element_line_;
  uint64_t flat_ = 0, thin_ = 0, unused_parts_ = 0, removed_ = 0;
  std::set<std::string> left_out_;  // types of elements
  DeckSets sets_;
  NumberedResults result_;
};

}  // namespace

bool NumberedResults::add_node(uint64_t number, Vec3 point) {
  const auto place = static_cast<uint32_t>(results.points.size());
  results.points.push_back(point);
  return node_places.try_emplace(number, place).second;
}

std::string NumberedResults::add_element(ElementKind kind, uint64_t number, std::span<const uint64_t> nodes) {
  std::array<uint32_t, 20> places{};
  for (size_t n = 0; n < nodes.size(); ++n) {
    const auto found = node_places.find(nodes[n]);
    if (found == node_places.end())
      return "element " + std::to_string(number) + " names node " + std::to_string(nodes[n]) + ", which is not there";
    places[n] = found->second;
  }
  if (!element_places.try_emplace(number, static_cast<uint32_t>(results.kinds.size())).second)
    return "element " + std::to_string(number) + " comes twice";
  results.add_element(kind, places.data());
  return "";
}

NumberedResults read_inp(const std::string& name, std::string_view bytes, const std::vector<ResultsFile>& beside,
                         Diagnostics& diagnostics) {
  InpReader reader(name, diagnostics);
  read_cards(name, bytes, beside, reader, diagnostics);
  return reader.take();
}

}  // namespace ombre::formats
