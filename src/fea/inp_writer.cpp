#include "fea/inp_writer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "base/text.h"

namespace ombre::fea {
namespace {

std::string_view type_name(BrickType type) {
  constexpr std::array<std::string_view, 3> names{"C3D8", "C3D8I", "C3D8R"};
  return names[static_cast<size_t>(type)];
}

// Capitals, digits and _, a letter first, each name once.
std::vector<std::string> deck_names(const std::vector<Section>& sections) {
  constexpr size_t longest = 60;
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const Section& section : sections) {
    std::string name;
    for (const char c : section.name.substr(0, longest)) {
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

// Gathers text, and hands it on in large pieces.
class Lines {
 public:
  explicit Lines(const Sink& sink) : sink_(sink) {}
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;
  ~Lines() = default;

  Lines& operator<<(std::string_view text) {
    text_ += text;
    if (text_.size() > most) flush();
    return *this;
  }
  Lines& operator<<(double value) { return *this << format_number(value); }
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

void write_mesh(const Model& model, BrickType type, const std::vector<std::string>& names, Lines& lines) {
  const Bricks& bricks = model.bricks;
  lines << "*NODE, NSET=NALL\n";
  for (size_t n = 0; n < bricks.node_count(); ++n) {
    const Vec3 p = bricks.node(n);
    lines << n + 1 << ", " << p.x << ", " << p.y << ", " << p.z << "\n";
  }
  for (size_t section = 0; section < names.size(); ++section) {
    bool is_first = true;
    for (size_t n = 0; n < bricks.count(); ++n) {
      if (model.section_of[n] != section) continue;
      if (is_first) lines << "*ELEMENT, TYPE=" << type_name(type) << ", ELSET=" << names[section] << "\n";
      is_first = false;
      lines << n + 1;
      for (const uint32_t node : bricks.nodes[n]) lines << ", " << size_t{node} + 1;
      lines << "\n";
    }
  }
}

void write_sections(const Model& model, const std::vector<std::string>& names, Lines& lines) {
  std::vector<bool> used(names.size());
  for (const uint16_t section : model.section_of) used[section] = true;
  for (size_t n = 0; n < names.size(); ++n) {
    if (!used[n]) continue;
    const Elastic& elastic = model.sections[n].elastic;
    lines << "*MATERIAL, NAME=" << names[n] << "\n*ELASTIC\n"
          << elastic.modulus_mpa << ", " << elastic.poissons_ratio << "\n";
    if (elastic.density_t_mm3 > 0) lines << "*DENSITY\n" << elastic.density_t_mm3 << "\n";
    lines << "*SOLID SECTION, ELSET=" << names[n] << ", MATERIAL=" << names[n] << "\n";
  }
}

void write_step(const Conditions& conditions, Lines& lines) {
  lines << "*STEP\n*STATIC\n";
  if (!conditions.displacements.empty()) lines << "*BOUNDARY\n";
  for (const Prescribed& held : conditions.displacements) {
    const size_t axis = size_t{held.axis} + 1;
    lines << size_t{held.node} + 1 << ", " << axis << ", " << axis << ", " << held.value << "\n";
  }
  if (!conditions.forces.empty()) lines << "*CLOAD\n";
  for (const Prescribed& force : conditions.forces)
    lines << size_t{force.node} + 1 << ", " << size_t{force.axis} + 1 << ", " << force.value << "\n";
  lines << "*NODE FILE\nU, RF\n*EL FILE\nS, E\n*END STEP\n";
}

}  // namespace

void write_inp(const Model& model, const Conditions& conditions, BrickType type, const std::string& title,
               const Sink& sink) {
  const std::vector<std::string> names = deck_names(model.sections);
  Lines lines(sink);
  lines << "*HEADING\n" << title << "; mm, N, MPa, tonne\n";
  write_mesh(model, type, names, lines);
  write_sections(model, names, lines);
  write_step(conditions, lines);
  lines.flush();
}

}  // namespace ombre::fea
