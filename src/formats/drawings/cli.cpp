// Writes Common Layer Interface files, version 2.0.
#include "formats/drawings/cli.h"

#include "formats/containers/append_numbers.h"

namespace ombre::formats {
namespace {

constexpr char inner = '0', outer = '1';  // orientations: clockwise, counter-clockwise

// Replaces characters with a meaning in CLI: commas separate parameters, and $ begins a command.
std::string plain(const std::string& name) {
  std::string text = name;
  for (char& c : text)
    if (c < ' ' || c > '~' || c == ',' || c == '$' || c == '/') c = '_';
  return text;
}

bool is_outer(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (size_t n = 0; n < polygon.size(); ++n)
    twice += cross(polygon[n] - polygon[0], polygon[(n + 1) % polygon.size()] - polygon[0]);
  return twice > 0;
}

// Writes commands as text.
class TextWriter {
 public:
  void layer(double z_mm) {
    text_ += "$$LAYER/";
    append_decimal(text_, z_mm);
    text_ += '\n';
  }

  void polyline(size_t id, const std::vector<Vec2>& polygon) {
    begin("$$POLYLINE/", id);
    text_ += is_outer(polygon) ? outer : inner;
    text_ += ',';
    append_count(text_, polygon.size() + 1);
    for (const Vec2 p : polygon) point(p);
    point(polygon.front());
    text_ += '\n';
  }

  void hatches(size_t id, const std::vector<Hatch>& hatches) {
    begin("$$HATCHES/", id);
    append_count(text_, hatches.size());
    for (const Hatch& hatch : hatches) {
      point(hatch.from);
      point(hatch.to);
    }
    text_ += '\n';
  }

  std::string text() { return std::move(text_); }

 private:
  void begin(const char* command, size_t id) {
    text_ += command;
    append_count(text_, id);
    text_ += ',';
  }
  void point(Vec2 p) {
    text_ += ',';
    append_decimal(text_, p.x);
    text_ += ',';
    append_decimal(text_, p.y);
  }

  std::string text_;
};

// Writes commands of the long form: a command index of 16 bits, integers and floating-point numbers of 32 bits.
class BinaryWriter {
 public:
  void layer(double z_mm) {
    command(127);
    append_f32(bytes_, z_mm);
  }

  void polyline(size_t id, const std::vector<Vec2>& polygon) {
    command(130);
    append_u32(bytes_, static_cast<uint32_t>(id));
    append_u32(bytes_, is_outer(polygon) ? 1 : 0);
    append_u32(bytes_, static_cast<uint32_t>(polygon.size() + 1));
    for (const Vec2 p : polygon) point(p);
    point(polygon.front());
  }

  void hatches(size_t id, const std::vector<Hatch>& hatches) {
    command(132);
    append_u32(bytes_, static_cast<uint32_t>(id));
    append_u32(bytes_, static_cast<uint32_t>(hatches.size()));
    for (const Hatch& hatch : hatches) {
      point(hatch.from);
      point(hatch.to);
    }
  }

  std::string text() { return std::move(bytes_); }

 private:
  void command(unsigned index) {
    bytes_ += static_cast<char>(index);
    bytes_ += '\0';
  }
  void point(Vec2 p) {
    append_f32(bytes_, p.x);
    append_f32(bytes_, p.y);
  }

  std::string bytes_;
};

template <class Writer>
std::string commands_of_layer(double top_mm, const OutlinePolygons& polygons, const CliRules& rules, int64_t layer) {
  Writer writer;
  writer.layer(top_mm);
  for (size_t n = 0; n < polygons.size(); ++n) {
    for (const auto& polygon : polygons[n]) writer.polyline(n + 1, polygon);
    if (!rules.hatch) continue;
    const std::vector<Hatch> hatches = hatches_of(polygons[n], *rules.hatch, layer);
    if (!hatches.empty()) writer.hatches(n + 1, hatches);
  }
  return writer.text();
}

}  // namespace

std::string cli_header(const OutlineDocument& document, uint64_t layers, double bottom_mm, const CliRules& rules) {
  std::string text = "$$HEADERSTART\n";
  text += rules.is_binary ? "$$BINARY\n" : "$$ASCII\n";
  text += "$$UNITS/1\n$$VERSION/200\n";
  for (size_t n = 0; n < document.regions.size(); ++n)
    text += "$$LABEL/" + std::to_string(n + 1) + ',' + plain(document.regions[n].name) + '\n';
  text += "$$DIMENSION/";
  append_point(text, document.box.lo, ',', append_decimal);
  text += ',';
  append_point(text, document.box.hi, ',', append_decimal);
  text += "\n$$LAYERS/" + std::to_string(layers + 1) + "\n$$HEADEREND";
  // Binary commands begin right behind the header.
  if (rules.is_binary) return text + commands_of_layer<BinaryWriter>(bottom_mm, {}, {}, 0);
  return text + "\n$$GEOMETRYSTART\n" + commands_of_layer<TextWriter>(bottom_mm, {}, {}, 0);
}

std::string cli_layer(double top_mm, const OutlinePolygons& polygons, const CliRules& rules, int64_t layer) {
  return rules.is_binary ? commands_of_layer<BinaryWriter>(top_mm, polygons, rules, layer)
                         : commands_of_layer<TextWriter>(top_mm, polygons, rules, layer);
}

std::string cli_end(const CliRules& rules) { return rules.is_binary ? "" : "$$GEOMETRYEND\n"; }

}  // namespace ombre::formats
