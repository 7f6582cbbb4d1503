#include "jobs/info/map_reports.h"

#include <algorithm>
#include <array>

#include "base/text/text.h"
#include "design/registry.h"
#include "nodes/common/made_fields.h"

namespace ombre::compile {
namespace {

using design::Node;
using design::NodePtr;
using program::Field;
using program::Point;

// Numbers of a map's outputs.
struct MapOutputs {
  size_t region, volume, stretches;

  // Returns nothing for nodes that are no maps, and for maps that fill all space.
  static std::optional<MapOutputs> of(const Node& node) {
    std::array<size_t, 3> numbers{};
    constexpr std::array names{"region", "volume", "stretches"};
    for (size_t n = 0; n < names.size(); ++n) {
      const auto number = node.type().output(names[n]);
      if (!number || !node.gives(*number)) return std::nullopt;
      numbers[n] = *number;
    }
    return MapOutputs{numbers[0], numbers[1], numbers[2]};
  }
};

void include(Extremes& extremes, double value, Vec3 at, bool is_first) {
  if (is_first || value < extremes.least) extremes.least = value, extremes.least_at = at;
  if (is_first || value > extremes.greatest) extremes.greatest = value, extremes.greatest_at = at;
}

class Survey {
 public:
  Survey(const design::Design& design, const Node& node, const MapOutputs& outputs, const Box& box)
      : box_(box),
        fields_({design.materials, diagnostics_, nullptr, node.where(), node.type().name, ""},
                {NodePtr(NodePtr(), &node)}, box, [&](design::Lowering& lowering, const Point& p) {
                  const auto numbers = [&](size_t output) { return lowering.answer(node, output, p).numbers; };
                  const auto stretches = numbers(outputs.stretches);
                  return std::vector<Field>{numbers(outputs.region)[0], numbers(outputs.volume)[0], stretches[0],
                                            stretches[2]};
                }) {}

  // Reports values at side^3 points of the box, as far as they lie in the region.
  MapReport at_points(int side) {
    MapReport report;
    const Vec3 step = (1.0 / side) * box_.size();
    for (int k = 0; k < side; ++k)
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
          include_point(report, box_.lo + Vec3{(i + 0.5) * step.x, (j + 0.5) * step.y, (k + 0.5) * step.z});
    return report;
  }

 private:
  void include_point(MapReport& report, Vec3 at) {
    const std::vector<double> found = fields_.at(at, values_);
    const double outside = found[0], volume = found[1], least = found[2], greatest = found[3];
    if (!(outside <= 0)) return;
    const bool is_first = report.points++ == 0;
    include(report.volume_mm3, volume, at, is_first);
    include(report.stretch_mm, least, at, is_first);
    include(report.stretch_mm, greatest, at, false);
    include(report.aspect, greatest / least, at, is_first);
  }

  Diagnostics diagnostics_;
  Box box_;
  nodes::MadeFields fields_;
  std::vector<double> values_;
};

std::string place(Vec3 p) {
  return '(' + format_rounded(p.x, 4) + ", " + format_rounded(p.y, 4) + ", " + format_rounded(p.z, 4) + ')';
}

Data place_data(Vec3 p) { return DataList{p.x, p.y, p.z}; }

DataMembers data_of(const Extremes& extremes) {
  return {{"least", extremes.least},
          {"least_at", place_data(extremes.least_at)},
          {"greatest", extremes.greatest},
          {"greatest_at", place_data(extremes.greatest_at)}};
}

std::string range_text(const Extremes& extremes, const std::string& unit) {
  const std::string least = format_rounded(extremes.least, 4), greatest = format_rounded(extremes.greatest, 4);
  if (least == greatest) return least + unit;
  return least + unit + " at " + place(extremes.least_at) + " to " + greatest + unit + " at " +
         place(extremes.greatest_at);
}

}  // namespace

std::string MapReport::text() const {
  if (points == 0) return "no point of its region was found";
  return "cells have " + range_text(volume_mm3, " mm3") + "; one is " + range_text(stretch_mm, " mm") +
         " long; it is up to " + format_rounded(aspect.greatest, 4) +
         " times as long in one direction as in another, at " + place(aspect.greatest_at);
}

DataMembers MapReport::data() const {
  return {{"node", node},
          {"line", static_cast<double>(line)},
          {"points", static_cast<double>(points)},
          {"volume_mm3", data_of(volume_mm3)},
          {"stretch_mm", data_of(stretch_mm)},
          {"aspect", data_of(aspect)}};
}

std::vector<MapReport> map_reports_of(const design::Design& design) {
  constexpr std::array sides{24, 48, 96};  // finer where a thin region holds few points
  constexpr size_t enough = 500;
  std::vector<MapReport> reports;
  for (const Node* node : design::topological(design.roots())) {
    const auto outputs = MapOutputs::of(*node);
    if (!outputs) continue;
    const Box box = nodes::box_of({node, outputs->region}, design::design_space());
    if (box.is_empty() || !design::has_ends(box)) continue;
    Survey survey(design, *node, *outputs, box);
    MapReport& report = reports.emplace_back();
    for (const int side : sides) {
      report = survey.at_points(side);
      if (report.points >= enough) break;
    }
    const SourceRange& where = node->where();
    report.node = node->type().name;
    report.line = where.source ? where.source->place(where.begin).line : 0;
  }
  return reports;
}

}  // namespace ombre::compile
