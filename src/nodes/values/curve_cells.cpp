// Maps of cells along curves.
#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "nodes/common/curve_frames.h"
#include "nodes/values/cell_counts.h"
#include "nodes/values/cell_outputs.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct CurveCells : CellOutputs<CurveCells> {
  Points points;
  double width = 6, depth = 6;
  std::optional<Vec3> size;
  std::optional<Counts3> count;
  Vec3 toward{0, 0, 1};
  std::shared_ptr<CurveFrames> curve;  // made with the node

  static Spec<CurveCells> spec() {
    return {
        "curve_cells",
        "A map of cells in a rod of rectangular section along a smooth curve through points: u runs along the curve, v "
        "and w across, without turning around it.",
        {{"points", &CurveCells::points, "Two or more points", required(unit::points)},
         {"width", &CurveCells::width, "Width of the rod along v", unit::positive_mm},
         {"depth", &CurveCells::depth, "Depth of the rod along w", unit::positive_mm},
         {"size", &CurveCells::size, cell_size_doc, unit::positive_mm},
         {"count", &CurveCells::count, cell_count_doc, whole_from_one()},
         {"toward", &CurveCells::toward, "Direction of w at the start, as far as it is perpendicular to the curve"}},
        no_inputs,
        "tpms(\"gyroid\", map=curve_cells([(0, 0, 0), (15, 0, 0), (20, 12, 8)], 5, 5, count=(6, 1, 1)), "
        "thickness=0.4, material=\"red\");",
        outputs()};
  }

  bool complete(const Reader& reader) {
    curve = smooth_curve(points, {toward, CurveRule::Ends::straight}, reader);
    if (!curve) return false;
    curve->set_reach(reach() * (1 + 1e-9));
    return fits(reader) && find_counts(reader, {curve->length(), width, depth}, size, count, counts);
  }

  Slope cells_at(const Point& p) const {
    return {read(p, CurveFrames::along) * (counts.x / curve->length()),
            (read(p, CurveFrames::first) / width + 0.5) * counts.y,
            (read(p, CurveFrames::second) / depth + 0.5) * counts.z};
  }
  Slope size_at(const Point& p) const {
    constexpr double least = 1e-6;  // beyond the centre of curvature there are no cells
    return {max(read(p, CurveFrames::stretch), least) * (curve->length() / counts.x), p.constant(width / counts.y),
            p.constant(depth / counts.z)};
  }

  Field outside(const Ask& ask) const {
    const Point& p = ask.p;
    const Field along = read(p, CurveFrames::along);
    const Field ends = abs(along - curve->length() / 2) - curve->length() / 2;
    const Field sides =
        max(abs(read(p, CurveFrames::first)) - width / 2, abs(read(p, CurveFrames::second)) - depth / 2);
    return max(max(sides, ends), read(p, CurveFrames::distance) - reach());
  }
  Box region_within(const Box&) const { return curve->box().expanded(reach()); }

 private:
  double reach() const { return std::hypot(width, depth) / 2; }

  Field read(const Point& p, int channel) const { return p.builder().source(curve, channel, p.x, p.y, p.z); }

  // The corners of the section must stay nearer to the curve than its centres of curvature, and than the curve's other
  // parts.
  bool fits(const Reader& reader) const {
    const double radius = curve->least_radius();
    if (!(reach() < radius))
      return refuse_at(reader, "cells of curve_cells are folded", curve->tightest(),
                       "the curve's radius is " + format_rounded(radius) +
                           " mm there; sqrt(width^2 + depth^2)/2, which is " + format_rounded(reach()) +
                           " mm, must be less");
    const auto meeting = curve->near_itself(reach());
    return !meeting || refuse_at(reader, "cells of curve_cells overlap", *meeting,
                                 "the curve comes back there; make width and depth smaller, or move points apart");
  }
  static bool refuse_at(const Reader& reader, const std::string& what, Vec3 at, const std::string& hint) {
    return reader.refuse(
        what + " at (" + format_rounded(at.x) + ", " + format_rounded(at.y) + ", " + format_rounded(at.z) + ")", hint);
  }
};

}  // namespace

void add_curve_cells(Registry& registry) { registry.add<CurveCells>("cells"); }

}  // namespace ombre::nodes
