#include "formats/drawings/dxf_measures.h"

#include <cmath>
#include <set>

#include "base/math/math.h"
#include "formats/drawings/dxf_entities.h"

namespace ombre::formats {
namespace {

double angle_of(Vec2 way) { return math::atan2(way.y, way.x) / math::degree; }

// Returns the value of a dimension. Group code 70 is the kind; codes 10, 13, 14, 15 and 16 are points (DXF reference,
// DIMENSION).
std::optional<double> value_of(const DxfValues& values) {
  constexpr int kinds = 7, x_ordinate = 64;
  const int flags = static_cast<int>(values.number(70));
  const Vec2 first = values.point(13), second = values.point(14), way = second - first;
  switch (flags & kinds) {
    case 0: {  // along a line at an angle
      const double angle = values.number(50) * math::degree;
      return std::abs(way.x * math::cos(angle) + way.y * math::sin(angle));
    }
    case 1:  // aligned
      return length(way);
    case 2:  // the angle between two lines
      return std::abs(angle_of(values.point(10) - values.point(15)) - angle_of(way));
    case 3:  // diameter
    case 4:  // radius
      return length(values.point(15) - values.point(10));
    case 6:
      return (flags & x_ordinate) ? first.x : first.y;
    default:
      return std::nullopt;
  }
}

bool is_angle(const DxfValues& values) { return (static_cast<int>(values.number(70)) & 7) == 2; }

}  // namespace

std::optional<DxfMeasures> read_dxf_measures(const std::string& name, std::string_view bytes,
                                             Diagnostics& diagnostics) {
  try {
    const TextScanner scanner(name, bytes, diagnostics);
    DxfMeasures measures;
    for (const DxfEntity& entity : read_dxf_document(name, bytes, scanner, diagnostics).entities) {
      const DxfValues values(scanner, entity);
      const std::string layer(values.text(8));
      if (entity.kind == "DIMENSION")
        measures.dimensions.push_back({std::string(values.text(1)), layer, value_of(values), is_angle(values)});
      else if (entity.kind == "LINE")
        measures.lines.push_back({layer, values.point(10), values.point(11)});
      else
        measures.others.push_back({std::string(entity.kind), layer});
    }
    return measures;
  } catch (const DesignError&) {
    return std::nullopt;
  }
}

std::vector<std::string> dxf_layers(const std::string& name, std::string_view bytes) {
  Diagnostics diagnostics;
  try {
    const TextScanner scanner(name, bytes, diagnostics);
    std::set<std::string> layers;
    for (const DxfEntity& entity : read_dxf_document(name, bytes, scanner, diagnostics).entities)
      layers.emplace(DxfValues(scanner, entity).text(8));
    layers.erase("");
    return {layers.begin(), layers.end()};
  } catch (const DesignError&) {
    return {};
  }
}

}  // namespace ombre::formats
