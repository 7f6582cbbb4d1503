#include "fea/files/inp_writer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <map>
#include <set>

#include "base/system/not_copied.h"
#include "base/text/error.h"
#include "base/text/text.h"

namespace ombre::fea {
namespace {

std::string_view type_name(BrickType type) {
  constexpr std::array<std::string_view, 3> names{"C3D8", "C3D8I", "C3D8R"};
  return names[static_cast<size_t>(type)];
}

// Makes unique names of capitals, digits and _ that begin with a letter.
template <class Named>
std::vector<std::string> deck_names(const std::vector<Named>& things) {
  constexpr size_t longest = 60;
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const Named& thing : things) {
    std::string name;
    for (const char c : thing.name.substr(0, longest)) {
      const auto byte = static_cast<unsigned char>(c);
      name += std::isalnum(byte) != 0 && byte < 128 ? static_cast<char>(std::toupper(byte)) : '_';
    }
    if (name.empty() || std::isalpha(static_cast<unsigned char>(name[0])) == 0) name.insert(0, "M_");
    std::string unique = name;
    for (size_t n = 2; !taken.insert(unique).second; ++n) unique = std::string(name).append("_" + std::to_string(n));
    names.push_back(unique);
  }
  return names;
}

// Gathers text, and writes it in large pieces.
class Lines : NotCopied {
 public:
  explicit Lines(const Sink& sink) : sink_(sink) {}
  ~Lines() = default;

  Lines& operator<<(std::string_view text) {
    text_ += text;
    if (text_.size() > most) flush();
    return *this;
  }
  // CalculiX reads 20 characters of a number.
  Lines& operator<<(double value) {
    constexpr size_t longest = 20;
    constexpr int digits_that_fit = 12;
    const std::string exact = format_number(value);
    return *this << (exact.size() <= longest ? exact : format_rounded(value, digits_that_fit));
  }
  Lines& operator<<(size_t value) { return *this << std::to_string(value); }
  void flush() {
    sink_(text_);
    text_.clear();
  }

 private:
  static constexpr size_t most = size_t{1} << 20;
  const Sink& sink_;
  std::string text_;
};

// Writes a node set, sixteen numbers to a line, counted from 1.
void write_set(const NodeSet& set, const std::string& name, Lines& lines) {
  constexpr size_t of_line = 16;
  lines << "*NSET, NSET=" << name << "\n";
  for (size_t n = 0; n < set.nodes.size(); ++n) {
    const bool is_last = n + 1 == set.nodes.size() || n % of_line + 1 == of_line;
    lines << size_t{set.nodes[n]} + 1 << (is_last ? "\n" : ", ");
  }
}

void write_mesh(const ModelView& model, std::string_view type, const std::vector<std::string>& names, Lines& lines) {
  const MeshView& mesh = model.mesh;
  lines << "*NODE, NSET=NALL\n";
  for (size_t n = 0; n < mesh.node_count(); ++n) {
    const Vec3 p = mesh.node(n);
    lines << n + 1 << ", " << p.x << ", " << p.y << ", " << p.z << "\n";
  }
  for (size_t section = 0; section < names.size(); ++section) {
    bool is_first = true;
    for (size_t n = 0; n < mesh.count(); ++n) {
      if (model.section_of[n] != section) continue;
      if (is_first) lines << "*ELEMENT, TYPE=" << type << ", ELSET=" << names[section] << "\n";
      is_first = false;
      lines << n + 1;
      for (const uint32_t node : mesh.nodes(n)) lines << ", " << size_t{node} + 1;
      lines << "\n";
    }
  }
}

void write_material(const Section& section, Physics physics, Lines& lines) {
  const Elastic& elastic = section.elastic;
  if (physics != Physics::mechanics) {
    lines << "*CONDUCTIVITY\n" << section.conductivity << "\n";  // 1 W/(m K) is 1 mW/(mm K)
    return;
  }
  lines << "*ELASTIC\n" << elastic.modulus_mpa << ", " << elastic.poissons_ratio << "\n";
  if (elastic.density_t_mm3 > 0) lines << "*DENSITY\n" << elastic.density_t_mm3 << "\n";
}

void write_sections(const ModelView& model, Physics physics, const std::vector<std::string>& names, Lines& lines) {
  std::vector<bool> used(names.size());
  for (const uint16_t section : model.section_of) used[section] = true;
  for (size_t n = 0; n < names.size(); ++n) {
    if (!used[n]) continue;
    lines << "*MATERIAL, NAME=" << names[n] << "\n";
    write_material(model.sections[n], physics, lines);
    lines << "*SOLID SECTION, ELSET=" << names[n] << ", MATERIAL=" << names[n] << "\n";
  }
}

// Requests results as text in job.dat, which calculix.h reads.
void write_prints(const char* of_nodes, const char* of_elements, Lines& lines) {
  lines << "*NODE PRINT, NSET=NALL\n" << of_nodes << "\n*EL PRINT, ELSET=EALL\n" << of_elements << "\n";
}

// Returns the node of the period along an axis; these nodes come after those of the mesh.
size_t period_node(const ModelView& model, size_t axis) { return model.mesh.node_count() + 1 + axis; }

void write_periods(const ModelView& model, const Repeat& repeat, Lines& lines) {
  const Vec3 corner = model.mesh.bounds().lo;
  for (size_t axis = 0; axis < 3; ++axis) {
    Vec3 at = corner;
    at[static_cast<int>(axis)] += repeat.period_mm[static_cast<int>(axis)];
    lines << "*NODE, NSET=PERIOD_" << axis + 1 << "\n"
          << period_node(model, axis) << ", " << at.x << ", " << at.y << ", " << at.z << "\n";
  }
  constexpr size_t of_line = 4;
  for (const Tie& tie : repeat.ties)
    for (size_t direction = 1; direction <= 3; ++direction) {
      std::vector<std::pair<size_t, int>> terms{{size_t{tie.node} + 1, 1}, {size_t{tie.of} + 1, -1}};
      for (size_t axis = 0; axis < 3; ++axis)
        if (tie.periods[axis] != 0) terms.emplace_back(period_node(model, axis), -tie.periods[axis]);
      lines << "*EQUATION\n" << terms.size() << "\n";
      for (size_t n = 0; n < terms.size(); ++n)
        lines << terms[n].first << ", " << direction << ", " << std::to_string(terms[n].second)
              << (n + 1 == terms.size() || n % of_line + 1 == of_line ? "\n" : ", ");
    }
}

void write_mean_strain(const ModelView& model, const Repeat& repeat, Lines& lines) {
  for (size_t axis = 0; axis < 3; ++axis)
    for (size_t direction = 0; direction < 3; ++direction)
      lines << period_node(model, axis) << ", " << direction + 1 << ", " << direction + 1 << ", "
            << repeat.displacement_mm(static_cast<int>(axis))[static_cast<int>(direction)] << "\n";
}

void write_static_step(const ModelView& model, const Conditions& conditions, bool prints, Lines& lines) {
  lines << "*STEP\n*STATIC\n";
  if (!conditions.displacements.empty()) lines << "*BOUNDARY\n";
  for (const Prescribed& held : conditions.displacements) {
    const size_t axis = size_t{held.axis} + 1;
    lines << size_t{held.node} + 1 << ", " << axis << ", " << axis << ", " << held.value << "\n";
  }
  if (conditions.repeat) write_mean_strain(model, *conditions.repeat, lines);
  if (!conditions.forces.empty()) lines << "*CLOAD\n";
  for (const Prescribed& force : conditions.forces)
    lines << size_t{force.node} + 1 << ", " << size_t{force.axis} + 1 << ", " << force.value << "\n";
  if (prints)
    write_prints("U, RF", "S, E", lines);
  else
    lines << "*NODE FILE\nU, RF\n*EL FILE\nS, E\n";
  lines << "*END STEP\n";
}

// Returns the loaded area of a side as a share of the side.
double share_of_side(const MeshView& mesh, const OuterSide& side) {
  double area = 0;
  for (const NodeShare& here : side_shares(mesh, side)) area += here.share;
  return area / length(side_area(mesh, side));
}

// Temperatures are degree of freedom 11.
void write_heat_step(const MeshView& mesh, const Conditions& conditions, bool prints, Lines& lines) {
  constexpr double milli = 1000;
  lines << "*STEP\n*HEAT TRANSFER, STEADY STATE\n";
  if (!conditions.displacements.empty()) lines << "*BOUNDARY\n";
  for (const Prescribed& held : conditions.displacements)
    lines << size_t{held.node} + 1 << ", 11, 11, " << held.value << "\n";
  if (!conditions.forces.empty()) lines << "*CFLUX\n";
  for (const Prescribed& flow : conditions.forces)
    lines << size_t{flow.node} + 1 << ", 11, " << milli * flow.value << "\n";
  if (!conditions.films.empty()) lines << "*FILM\n";
  for (const Film& film : conditions.films)
    lines << size_t{film.side.element} + 1 << ", F" << size_t{film.side.side} + 1 << ", " << film.ambient_c << ", "
          << share_of_side(mesh, film.side) * film.coefficient_w_m2k / milli << "\n";
  if (prints)
    write_prints("NT, RFL", "HFL", lines);
  else
    lines << "*NODE FILE\nNT, RFL\n*EL FILE\nHFL\n";
  lines << "*END STEP\n";
}

std::string_view element_name(const MeshView& mesh, BrickType type, Physics physics) {
  const bool is_plain = mesh.kind() != ElementKind::c3d8 || physics != Physics::mechanics;
  return is_plain ? mesh.shape().name : type_name(type);
}

// The sections of a deck, whose elements are whole. Each kind of cut brick becomes a section whose properties are those
// of the material times the share inside.
struct DeckSections {
  std::vector<Section> sections;
  std::vector<uint16_t> section_of;
};

Section cut_section(const Section& whole, Fill fill) {
  const double share = fill_share(fill);
  Section cut = whole;
  cut.name += " filled " + std::to_string(std::popcount(fill)) + " of " + std::to_string(parts_of_brick);
  cut.elastic.modulus_mpa *= share;
  cut.elastic.density_t_mm3 *= share;
  cut.conductivity *= share;
  return cut;
}

DeckSections deck_sections(const ModelView& model) {
  DeckSections made{model.sections, model.section_of};
  if (!model.mesh.bricks()) return made;
  std::map<std::pair<uint16_t, int>, size_t> known;
  for (size_t n = 0; n < model.mesh.count(); ++n) {
    const Fill fill = model.mesh.bricks()->fill(n);
    if (fill == full_fill) continue;
    const auto [place, is_new] = known.try_emplace({model.section_of[n], std::popcount(fill)}, made.sections.size());
    if (is_new) made.sections.push_back(cut_section(model.section(n), fill));
    if (made.sections.size() > std::numeric_limits<uint16_t>::max())
      throw Error(
          Code::limit,
          "the deck would have more than 65,535 sections, since each share of a cut brick needs its own; choose "
          "fewer sections, or bricks by their centres");
    made.section_of[n] = static_cast<uint16_t>(place->second);
  }
  return made;
}

}  // namespace

void write_inp(const ModelView& whole, const Conditions& conditions, BrickType type, const std::string& title,
               const Sink& sink, bool prints) {
  const DeckSections split = deck_sections(whole);
  const ModelView model(whole, split.sections, split.section_of);
  const bool is_mechanics = conditions.physics == Physics::mechanics;
  const std::vector<std::string> names = deck_names(model.sections);
  Lines lines(sink);
  lines << "*HEADING\n" << title << (is_mechanics ? "; mm, N, MPa, tonne\n" : "; mm, mW, degrees Celsius\n");
  write_mesh(model, element_name(model.mesh, type, conditions.physics), names, lines);
  const std::vector<std::string> set_names = deck_names(conditions.sets);
  for (size_t n = 0; n < set_names.size(); ++n) write_set(conditions.sets[n], set_names[n], lines);
  if (prints) lines << "*ELSET, ELSET=EALL, GENERATE\n1, " << model.mesh.count() << ", 1\n";
  write_sections(model, conditions.physics, names, lines);
  if (conditions.repeat) write_periods(model, *conditions.repeat, lines);
  if (is_mechanics)
    write_static_step(model, conditions, prints, lines);
  else
    write_heat_step(model.mesh, conditions, prints, lines);
  lines.flush();
}

}  // namespace ombre::fea
