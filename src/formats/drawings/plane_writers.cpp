#include "formats/drawings/plane_writers.h"

#include "base/math/box.h"
#include "formats/containers/append_numbers.h"
#include "formats/containers/xml_text.h"

namespace ombre::formats {
namespace {

constexpr Rgba light_gray{211, 211, 211, 255};

std::string decimal(double value) {
  std::string text;
  append_decimal(text, value + 0.0);
  return text;
}

void append_svg_ring(std::string& text, const Ring& ring) {
  char command = 'M';
  for (const Vec2& p : ring) {
    text += command;
    text += decimal(p.x) + ',' + decimal(-p.y) + ' ';
    command = 'L';
  }
  text += "z\n";
}

std::string fill_attributes(const Rgba& colour) {
  const std::string fill = xml_attribute("fill", hex_colour({colour.data(), 3}));
  return colour[3] == 255 ? fill : fill + xml_attribute("fill-opacity", decimal(colour[3] / 255.0));
}

void append_pair(std::string& text, int code, const std::string& value) {
  text += std::to_string(code) + '\n' + value + '\n';
}

// Returns the layer of a part; names of layers cannot contain line ends.
std::string layer_of(const std::string& part) {
  std::string layer = part.empty() ? "0" : part;
  for (char& c : layer)
    if (static_cast<unsigned char>(c) < ' ') c = '_';
  return layer;
}

}  // namespace

std::string drawing_svg(const std::string& title, const std::vector<DrawnRegion>& regions) {
  Box box;
  for (const DrawnRegion& region : regions)
    for (const Ring& ring : region.rings)
      for (const Vec2& p : ring) box = hull(box, Box{{p.x, p.y, 0}, {p.x, p.y, 0}});
  const Vec3 size = box.size();
  std::string text(xml_declaration);
  text += "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\"" + xml_attribute("width", decimal(size.x) + "mm") +
          xml_attribute("height", decimal(size.y) + "mm");
  if (!box.is_empty())
    text += xml_attribute("viewBox",
                          decimal(box.lo.x) + ' ' + decimal(-box.hi.y) + ' ' + decimal(size.x) + ' ' + decimal(size.y));
  text += ">\n<title>" + xml_escaped(title) + "</title>\n";
  for (const DrawnRegion& region : regions) {
    text += "<path";
    if (!region.part.empty()) text += xml_attribute("class", region.part);
    text += fill_attributes(region.colour.value_or(light_gray)) + " fill-rule=\"evenodd\" d=\"\n";
    for (const Ring& ring : region.rings) append_svg_ring(text, ring);
    text += "\"/>\n";
  }
  return text + "</svg>\n";
}

std::string drawing_dxf(const std::vector<DrawnRegion>& regions) {
  std::string text = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  for (const DrawnRegion& region : regions)
    for (const Ring& ring : region.rings) {
      append_pair(text, 0, "LWPOLYLINE");
      append_pair(text, 8, layer_of(region.part));
      append_pair(text, 90, std::to_string(ring.size()));
      append_pair(text, 70, "1");  // a closed polyline
      for (const Vec2& p : ring) {
        append_pair(text, 10, decimal(p.x));
        append_pair(text, 20, decimal(p.y));
      }
    }
  return text + "0\nENDSEC\n0\nEOF\n";
}

}  // namespace ombre::formats
