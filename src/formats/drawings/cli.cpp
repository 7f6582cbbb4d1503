// Writes Common Layer Interface files, version 2.0, ASCII.
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

void append_point(std::string& text, Vec2 p) {
  text += ',';
  append_decimal(text, p.x);
  text += ',';
  append_decimal(text, p.y);
}

void append_polyline(std::string& text, size_t id, const std::vector<Vec2>& polygon) {
  text += "$$POLYLINE/";
  append_count(text, id);
  text += ',';
  text += is_outer(polygon) ? outer : inner;
  text += ',';
  append_count(text, polygon.size() + 1);
  for (const Vec2 p : polygon) append_point(text, p);
  append_point(text, polygon.front());
  text += '\n';
}

std::string layer_begin(double z_mm) {
  std::string text = "$$LAYER/";
  append_decimal(text, z_mm);
  return text + '\n';
}

}  // namespace

std::string cli_header(const OutlineDocument& document, uint64_t layers, double bottom_mm) {
  std::string text = "$$HEADERSTART\n$$ASCII\n$$UNITS/1\n$$VERSION/200\n";
  for (size_t n = 0; n < document.regions.size(); ++n)
    text += "$$LABEL/" + std::to_string(n + 1) + ',' + plain(document.regions[n].name) + '\n';
  text += "$$DIMENSION/";
  append_point(text, document.box.lo, ',', append_decimal);
  text += ',';
  append_point(text, document.box.hi, ',', append_decimal);
  text += "\n$$LAYERS/" + std::to_string(layers + 1) + "\n$$HEADEREND\n$$GEOMETRYSTART\n";
  return text + layer_begin(bottom_mm);
}

std::string cli_layer(double top_mm, const OutlinePolygons& polygons) {
  std::string text = layer_begin(top_mm);
  for (size_t n = 0; n < polygons.size(); ++n)
    for (const auto& polygon : polygons[n]) append_polyline(text, n + 1, polygon);
  return text;
}

std::string cli_end() { return "$$GEOMETRYEND\n"; }

}  // namespace ombre::formats
