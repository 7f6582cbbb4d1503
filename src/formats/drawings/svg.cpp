// Writes SVG 1.1: a layer's regions as filled paths, with one unit per millimetre.
#include "formats/drawings/svg.h"

#include "formats/containers/append_numbers.h"
#include "formats/containers/xml_text.h"

namespace ombre::formats {
namespace {

std::string number(double value) {
  std::string text;
  append_decimal(text, value);
  return text;
}

std::string fill_of(const Rgba& colour) {
  const std::string fill = xml_attribute("fill", hex_colour({colour.data(), 3}));
  return colour[3] == 255 ? fill : fill + xml_attribute("fill-opacity", number(colour[3] / 255.0));
}

void append_polygon(std::string& text, const std::vector<Vec2>& polygon) {
  char command = 'M';
  for (const Vec2 p : polygon) {
    text += command;
    append_decimal(text, p.x);
    text += ' ';
    append_decimal(text, -p.y);
    command = 'L';
  }
  text += 'Z';
}

void append_path(std::string& text, size_t number, const OutlinedRegion& region,
                 const std::vector<std::vector<Vec2>>& polygons) {
  text += "<path" + xml_attribute("id", "region-" + std::to_string(number)) + fill_of(region.colour) +
          " fill-rule=\"evenodd\" d=\"";
  for (const auto& polygon : polygons) append_polygon(text, polygon);
  text += "\"><title>" + xml_escaped(region.name) + "</title></path>\n";
}

}  // namespace

std::string svg_bytes(const OutlineDocument& document, const std::string& title, const OutlinePolygons& polygons) {
  const Vec3 lo = document.box.lo, size = document.box.size();
  const std::string width = number(size.x), height = number(size.y);
  std::string text(xml_declaration);
  text += "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"" + xml_attribute("width", width + "mm") +
          xml_attribute("height", height + "mm") +
          xml_attribute("viewBox", number(lo.x) + ' ' + number(-document.box.hi.y) + ' ' + width + ' ' + height) +
          ">\n<title>" + xml_escaped(title) + "</title>\n";
  for (size_t n = 0; n < polygons.size(); ++n)
    if (!polygons[n].empty()) append_path(text, n + 1, document.regions[n], polygons[n]);
  return text + "</svg>\n";
}

}  // namespace ombre::formats
