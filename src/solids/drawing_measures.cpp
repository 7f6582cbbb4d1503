#include "solids/drawing_measures.h"

#include "base/text/error.h"
#include "formats/containers/file.h"
#include "formats/drawings/dxf_measures.h"

namespace ombre::solids {
namespace {

bool fits(const std::string& wanted, const std::string& found) { return wanted.empty() || wanted == found; }

// Returns the measures of a file, or null and a warning if it cannot be read.
template <class Value>
std::optional<formats::DxfMeasures> measures_of(const MeasureChoice& choice, Measure<Value>& result) {
  try {
    Diagnostics found;
    auto measures = formats::read_dxf_measures(choice.path, formats::read_file(choice.path), found);
    if (measures) {
      for (const auto& [kind, layer] : measures->others)
        if (fits(choice.layer, layer)) ++result.others[kind];
    } else
      result.warning =
          "Can't read DXF file '" + choice.shown + "'" + (found.list().empty() ? "" : ": " + found.list()[0].message);
    return measures;
  } catch (const Error&) {
    result.warning = "Can't open DXF file '" + choice.shown + "'!";
    return std::nullopt;
  }
}

}  // namespace

Measure<double> dimension_of(const MeasureChoice& choice) {
  Measure<double> result;
  const auto measures = measures_of(choice, result);
  if (!measures) return result;
  for (const formats::DxfDimension& dimension : measures->dimensions) {
    if (!fits(choice.name, dimension.name) || !fits(choice.layer, dimension.layer)) continue;
    result.value = dimension.value;
    if (!result.value)
      result.warning = "Dimension '" + choice.name + "' in '" + choice.shown + "', layer '" + choice.layer +
                       "' has unsupported type!";
    else if (!dimension.is_angle)
      *result.value *= choice.scale;
    return result;
  }
  result.warning =
      "Can't find dimension '" + choice.name + "' in '" + choice.shown + "', layer '" + choice.layer + "'!";
  return result;
}

Measure<Vec2> crossing_of(const MeasureChoice& choice) {
  Measure<Vec2> result;
  const auto measures = measures_of(choice, result);
  if (!measures) return result;
  const formats::DxfLine* first = nullptr;
  for (const formats::DxfLine& line : measures->lines) {
    if (!fits(choice.layer, line.layer)) continue;
    if (!first) {
      first = &line;
      continue;
    }
    const Vec2 a = first->to - first->from, b = line.to - line.from;
    const double turn = cross(a, b);
    if (turn == 0) break;  // parallel
    const Vec2 place = first->from + (cross(line.from - first->from, b) / turn) * a;
    result.value = choice.scale * (place - choice.origin);
    return result;
  }
  result.warning = "Can't find cross in '" + choice.shown + "', layer '" + choice.layer + "'!";
  return result;
}

}  // namespace ombre::solids
