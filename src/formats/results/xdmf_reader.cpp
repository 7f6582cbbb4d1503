// Reads uniform grids of XDMF 3, alone or as steps, whose numbers are in the text or in an HDF5 file.
#ifdef OMBRE_3MF

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/containers/hdf5.h"
#include "formats/containers/text_scanner.h"
#include "formats/containers/xml_file.h"
#include "formats/mesh/mesh.h"
#include "formats/results/result_steps.h"
#include "formats/results/results_readers.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

std::optional<ElementKind> element_kind(std::string_view topology) {
  const std::string name = to_lower(topology);
  if (name == "tetrahedron") return ElementKind::tetrahedron4;
  if (name == "tetrahedron_10" || name == "tet_10") return ElementKind::tetrahedron10;
  if (name == "hexahedron") return ElementKind::brick8;
  if (name == "hexahedron_20" || name == "hex_20") return ElementKind::brick20;
  if (name == "wedge") return ElementKind::wedge6;
  if (name == "pyramid") return ElementKind::pyramid5;
  return std::nullopt;
}

// Returns the number of nodes of elements that have no volume and are left out; null for other types.
std::optional<size_t> nodes_of_flat(std::string_view topology) {
  static const std::map<std::string, size_t> counts{{"polyvertex", 1}, {"polyline", 1},        {"triangle", 3},
                                                    {"edge_3", 3},     {"quadrilateral", 4},   {"triangle_6", 6},
                                                    {"tri_6", 6},      {"quadrilateral_8", 8}, {"quad_8", 8}};
  const auto found = counts.find(to_lower(topology));
  return found == counts.end() ? std::nullopt : std::optional(found->second);
}

// The codes of elements in a topology of the type Mixed (XdmfTopologyType). Those without a kind have no volume.
struct MixedKind {
  size_t nodes = 0;  // 0: the list says how many
  std::optional<ElementKind> kind = {};
};
std::optional<MixedKind> mixed_kind(double code) {
  static const std::map<double, MixedKind> kinds{{1, {}},
                                                 {2, {}},
                                                 {3, {}},
                                                 {4, {3}},
                                                 {5, {4}},
                                                 {6, {4, ElementKind::tetrahedron4}},
                                                 {7, {5, ElementKind::pyramid5}},
                                                 {8, {6, ElementKind::wedge6}},
                                                 {9, {8, ElementKind::brick8}},
                                                 {34, {3}},
                                                 {35, {9}},
                                                 {36, {6}},
                                                 {37, {8}},
                                                 {38, {10, ElementKind::tetrahedron10}},
                                                 {48, {20, ElementKind::brick20}}};
  const auto found = kinds.find(code);
  return found == kinds.end() ? std::nullopt : std::optional(found->second);
}

class XdmfReader {
 public:
  XdmfReader(const std::string& name, std::string_view bytes, const ResultsBeside& beside, Diagnostics& diagnostics)
      : file_(name, bytes, diagnostics), numbers_(beside.values), step_(beside.step) {}

  Results run() {
    const xml_node grid = grid_of_step(grid_of_domain());
    const std::string_view type = file_.attribute(grid, "GridType").value_or("Uniform");
    if (type != "Uniform")
      file_.fail_at(grid, "a grid of the type " + formats::quoted(type) + " is not read, as of several pieces",
                    "save each step as one grid, GridType=\"Uniform\"");
    const xml_node mesh = mesh_of(grid);
    add_points(child_of(mesh, "Geometry"));
    add_elements(child_of(mesh, "Topology"));
    for (const xml_node attribute : grid.children("Attribute")) add_field(attribute);
    leave_out(results_, file_.name(), static_cast<uint64_t>(std::ranges::count(is_kept_, false)),
              "points, lines or faces of the grid", file_.diagnostics());
    leave_out(results_, file_.name(), wide_fields_, "fields of more than 9 numbers", file_.diagnostics());
    leave_out(results_, file_.name(), fields_elsewhere_, "fields that are neither of nodes nor of cells",
              file_.diagnostics());
    return std::move(results_);
  }

 private:
  // Returns the type of an element, whose attribute is called Type by newer programs.
  std::optional<std::string_view> type_of(xml_node node, std::string_view older_name) const {
    const auto older = file_.attribute(node, older_name);
    return older ? older : file_.attribute(node, "Type");
  }

  xml_node child_of(xml_node parent, const char* name) const {
    const xml_node child = parent.child(name);
    if (!child) file_.fail_at(parent, "expected " + formats::quoted(name) + " in the grid");
    return child;
  }

  static bool is_series(xml_node grid) {
    return grid.attribute("GridType").value() == std::string_view("Collection") &&
           grid.attribute("CollectionType").value() == std::string_view("Temporal");
  }

  // Returns the grid of the domain. Beside a series may stand a grid that has only the mesh of its steps.
  xml_node grid_of_domain() const {
    const xml_node domain = file_.root("Xdmf").child("Domain");
    const xml_node first = domain.child("Grid");
    if (!first) file_.fail_at(file_.root("Xdmf"), "expected a grid in a domain");
    xml_node chosen = first;
    for (xml_node grid = first.next_sibling("Grid"); grid; grid = grid.next_sibling("Grid")) {
      const bool is_mesh_before = !is_series(chosen) && !chosen.child("Attribute") && is_series(grid);
      const bool is_mesh_behind = is_series(chosen) && !is_series(grid) && !grid.child("Attribute");
      if (!is_mesh_before && !is_mesh_behind) file_.fail_at(grid, "several grids are not read");
      if (is_mesh_before) chosen = grid;
    }
    return chosen;
  }

  // Returns the wanted step of a series; a grid that is none is its own only step.
  xml_node grid_of_step(xml_node grid) {
    std::vector<xml_node> steps;
    std::vector<std::string> times;
    if (!is_series(grid)) {
      steps.push_back(grid);
    } else {
      for (const xml_node step : grid.children("Grid")) steps.push_back(step);
    }
    if (steps.empty()) file_.fail_at(grid, "the collection has no grids");
    for (const xml_node step : steps) times.emplace_back(step.child("Time").attribute("Value").value());
    const size_t chosen = step_index(file_.name(), times, step_, file_.diagnostics());
    if (is_series(grid)) set_steps(results_, times, chosen);
    return steps[chosen];
  }

  // Returns the grid that has the mesh of a step: its own, or that which an XInclude names, as meshio and FEniCS write
  // it: xpointer(//Grid[@Name="mesh"]/*[self::Topology or self::Geometry]).
  xml_node mesh_of(xml_node grid) const {
    xml_node include;
    for (const xml_node child : grid.children())
      if (local_name(child) == "include") include = child;
    if (!include || grid.child("Geometry")) return grid;
    const std::string_view pointer = file_.required(include, "xpointer");
    constexpr std::string_view head = "xpointer(//Grid[@Name=", all = "/*[self::Topology or self::Geometry])";
    constexpr std::string_view first = "/Grid[1]";
    if (include.attribute("href") || !pointer.starts_with(head) || !pointer.ends_with(all)) fail_include(include);
    std::string_view name = pointer.substr(head.size(), pointer.size() - head.size() - all.size());
    const bool is_of_series = name.ends_with(first);
    if (is_of_series) name.remove_suffix(first.size());
    if (name.size() < 3 || !name.ends_with(']') || name[0] != name[name.size() - 2]) fail_include(include);
    name = name.substr(1, name.size() - 3);
    for (const xml_node other : file_.root("Xdmf").child("Domain").children("Grid"))
      if (other.attribute("Name").value() == name) return is_of_series ? other.child("Grid") : other;
    fail_include(include);
  }

  [[noreturn]] void fail_include(xml_node include) const {
    file_.fail_at(include, "the mesh that this include names is not found",
                  "write Topology and Geometry into each grid, or include them as meshio and FEniCS do");
  }

  std::vector<double> numbers_of(xml_node parent) {
    const xml_node item = parent.child("DataItem");
    if (!item) file_.fail_at(parent, "expected a DataItem");
    const std::string_view format = file_.attribute(item, "Format").value_or("XML");
    if (format == "XML") return numbers_in_text(item);
    if (format != "HDF") file_.fail_at(item, "expected the format XML or HDF, found " + formats::quoted(format));
    return numbers_in_hdf5(item);
  }

  std::vector<double> numbers_in_text(xml_node item) const {
    std::string_view text = item.text().get();
    std::vector<double> numbers;
    for (std::string_view word = next_word(text); !word.empty(); word = next_word(text))
      numbers.push_back(file_.number(item, word, "a number"));
    return numbers;
  }

  // Reads the numbers of an item such as "part.h5:/Mesh/geometry".
  std::vector<double> numbers_in_hdf5(xml_node item) {
    const std::string_view place = trim(std::string_view(item.text().get()));
    const size_t colon = place.rfind(":/");
    if (colon == std::string_view::npos)
      file_.fail_at(item,
                    "expected a file and a path in it, as part.h5:/Mesh/geometry, found " + formats::quoted(place));
    if (!numbers_)
      file_.fail_at(item, "the numbers are in the file " + formats::quoted(place.substr(0, colon)),
                    "name it by values=\"...\"");
    const std::string_view name = place.substr(0, colon), path = place.substr(colon + 1);
    if (name_of_numbers_.empty()) name_of_numbers_ = name;
    if (name != name_of_numbers_)
      file_.fail_at(
          item,
          "the numbers lie in several files: " + formats::quoted(name_of_numbers_) + " and " + formats::quoted(name),
          "save them in one");
    std::string problem;
    try {
      if (auto found = open_numbers(item).numbers(std::string(path), problem)) return std::move(found->values);
    } catch (const Error& error) {
      file_.fail_at(item, numbers_->name + ": " + error.what());
    }
    file_.fail_at(item, formats::quoted(numbers_->name) + " has no numbers at " + formats::quoted(path) +
                            (problem.empty() ? "" : ": " + problem));
  }

  // Opens the file of numbers when it is first needed.
  const Hdf5File& open_numbers(xml_node item) {
    if (!hdf5_) hdf5_ = open_hdf5(numbers_->bytes);
    if (!hdf5_) file_.fail_at(item, numbers_->name + ": this is no file of HDF5, or it is damaged");
    return *hdf5_;
  }

  void add_points(xml_node geometry) {
    if (type_of(geometry, "GeometryType").value_or("XYZ") != "XYZ")
      file_.fail_at(geometry, "expected the geometry XYZ");
    const std::vector<double> numbers = numbers_of(geometry);
    if (numbers.size() % 3 != 0 || numbers.size() / 3 > UINT32_MAX)
      file_.fail_at(geometry, "expected three coordinates for each point, found " + std::to_string(numbers.size()));
    for (size_t n = 0; n < numbers.size(); n += 3) {
      for (size_t axis = 0; axis < 3; ++axis)
        if (!(std::abs(numbers[n + axis]) <= greatest_coordinate))
          file_.fail_at(geometry,
                        "point " + std::to_string(n / 3) + " has a coordinate that is not finite or beyond 1e15");
      results_.points.push_back({numbers[n], numbers[n + 1], numbers[n + 2]});
    }
  }

  void add_elements(xml_node topology) {
    const std::string_view type = type_of(topology, "TopologyType").value_or("");
    first_point_ = file_.number(topology, file_.attribute(topology, "BaseOffset").value_or("0"), "a number of a point");
    if (to_lower(type) == "mixed") {
      add_mixed(topology, numbers_of(topology));
      return check_count(topology);
    }
    if (const auto nodes = nodes_of_flat(type)) return leave_out_elements(topology, *nodes);
    const auto kind = element_kind(type);
    if (!kind)
      file_.fail_at(topology, "elements of the type " + formats::quoted(type) +
                                  " are not read; read are Tetrahedron, Tetrahedron_10, Hexahedron, Hexahedron_20, "
                                  "Wedge, Pyramid and Mixed");
    const std::vector<double> numbers = numbers_of(topology);
    const size_t each = node_count(*kind);
    if (numbers.empty() || numbers.size() % each != 0)
      file_.fail_at(topology, "expected " + std::to_string(each) + " nodes for each element, found " +
                                  std::to_string(numbers.size()));
    for (size_t n = 0; n < numbers.size(); n += each) add_element(topology, *kind, &numbers[n]);
    check_count(topology);
  }

  // The topology may say how many elements it has, in one of two attributes.
  void check_count(xml_node topology) const {
    auto stated = file_.attribute(topology, "NumberOfElements");
    if (!stated) stated = file_.attribute(topology, "Dimensions");
    const auto count = stated ? parse_number(*stated) : std::nullopt;
    if (count && *count != static_cast<double>(is_kept_.size()))
      file_.fail_at(topology, "the topology says that it has " + format_number(*count) + " elements, and lists " +
                                  std::to_string(is_kept_.size()));
  }

  void leave_out_elements(xml_node topology, size_t usual_nodes) {
    const auto stated = file_.attribute(topology, "NodesPerElement");
    const uint64_t each = stated ? file_.count(topology, *stated, "a count of nodes") : usual_nodes;
    is_kept_.assign(numbers_of(topology).size() / std::max<uint64_t>(each, 1), false);
  }

  void add_element(xml_node topology, ElementKind kind, const double* numbers) {
    std::array<uint32_t, 20> nodes{};
    for (size_t c = 0; c < node_count(kind); ++c) {
      const double number = numbers[c] - first_point_;
      if (!(number >= 0 && number < static_cast<double>(results_.points.size())))
        file_.fail_at(topology, "element " + std::to_string(is_kept_.size()) + " names point " +
                                    format_number(numbers[c]) + "; there are " +
                                    std::to_string(results_.points.size()));
      nodes[c] = static_cast<uint32_t>(number);
    }
    results_.add_element(kind, nodes.data());
    is_kept_.push_back(true);
  }

  // Adds elements from a list in which each has its code before its nodes.
  void add_mixed(xml_node topology, const std::vector<double>& numbers) {
    for (size_t n = 0; n < numbers.size();) {
      const auto kind = mixed_kind(numbers[n]);
      if (!kind)
        file_.fail_at(topology, "element " + std::to_string(is_kept_.size()) + " is of XDMF's type " +
                                    format_number(numbers[n]) +
                                    "; read are tetrahedra (6, 38), hexahedra (9, 48), wedges (8) and pyramids (7)");
      size_t nodes = kind->nodes;
      if (++n < numbers.size() && nodes == 0)
        nodes = numbers[n] >= 0 ? static_cast<size_t>(std::min(numbers[n++], 1e9)) : 0;
      if (n + nodes > numbers.size())
        file_.fail_at(topology, "the last element has not the " + std::to_string(nodes) + " nodes of its type");
      if (kind->kind)
        add_element(topology, *kind->kind, &numbers[n]);
      else
        is_kept_.push_back(false);
      n += nodes;
    }
  }

  void add_field(xml_node attribute) {
    ResultField field;
    set_name(field, file_.attribute(attribute, "Name").value_or("values"));
    const std::string_view centre = file_.attribute(attribute, "Center").value_or("Node");
    if (centre != "Node" && centre != "Cell") {
      ++fields_elsewhere_;
      return;
    }
    field.is_of_elements = centre == "Cell";
    field.values = numbers_of(attribute);
    const size_t count = field.is_of_elements ? is_kept_.size() : results_.points.size();
    field.components = count == 0 ? 0 : field.values.size() / count;
    if (field.components < 1 || field.components * count != field.values.size())
      file_.fail_at(attribute, "the field " + formats::quoted(field.name) + " has " +
                                   std::to_string(field.values.size()) + " numbers for " + std::to_string(count) +
                                   (field.is_of_elements ? " elements" : " nodes"));
    if (field.components > most_components) {
      ++wide_fields_;
      return;
    }
    if (type_of(attribute, "AttributeType").value_or("") == "Tensor6") reorder(field);
    if (field.is_of_elements) leave_out_flat(field);
    results_.fields.push_back(std::move(field));
  }

  void leave_out_flat(ResultField& field) const {
    size_t n = 0;
    std::erase_if(field.values, [&](double) { return !is_kept_[n++ / field.components]; });
  }

  // Reorders xx, xy, xz, yy, yz, zz to xx, yy, zz, xy, yz, zx.
  static void reorder(ResultField& field) {
    if (field.components != 6) return;
    for (size_t n = 0; n < field.values.size(); n += 6) {
      double* const t = &field.values[n];
      const std::array<double, 6> was{t[0], t[1], t[2], t[3], t[4], t[5]};
      t[1] = was[3], t[2] = was[5], t[3] = was[1], t[4] = was[4], t[5] = was[2];
    }
  }

  XmlFile file_;
  const std::optional<ResultsFile>& numbers_;
  std::unique_ptr<Hdf5File> hdf5_;
  std::string name_of_numbers_;  // as the items write it
  uint64_t step_ = 0;            // number of the step, or 0
  Results results_;
  static constexpr size_t most_components = 9;
  double first_point_ = 0;  // by which the elements call the first point
  uint64_t wide_fields_ = 0;
  uint64_t fields_elsewhere_ = 0;  // with values at edges, faces or the whole grid
  std::vector<bool> is_kept_;      // by element of the file: false if it has no volume
};

}  // namespace

Results read_xdmf(const std::string& name, std::string_view bytes, const ResultsBeside& beside,
                  Diagnostics& diagnostics) {
  return XdmfReader(name, bytes, beside, diagnostics).run();
}

}  // namespace ombre::formats

#endif
