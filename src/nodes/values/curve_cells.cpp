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

struct CurveCells : CurveParameters, CellOutputs<CurveCells> {
  double width = 6, depth = 6;
  std::optional<Vec3> size;
  std::optional<Counts3> count;

  static Spec<CurveCells> spec() {
    return {
        "curve_cells",
        "A map of cells in a rod of rectangular section along a smooth curve through points: u runs along the curve, v "
        "and w across, without turning around it.",
        {{"points", &CurveCells::points, "Two or more points; three or more if the curve is closed",
          required(unit::points)},
         {"width", &CurveCells::width, "Width of the rod along v", unit::positive_mm},
         {"depth", &CurveCells::depth, "Depth of the rod along w", unit::positive_mm},
         {"size", &CurveCells::size, cell_size_doc, unit::positive_mm},
         {"count", &CurveCells::count, cell_count_doc, whole_from_one()},
         {"toward", &CurveCells::toward, "Direction of w at the start, as far as it is perpendicular to the curve",
          unit::direction},
         {"closed", &CurveCells::is_closed,
          "Continues the curve from the last point to the first. Cells then have no seam: v and w turn evenly around "
          "the curve by as much as is needed to meet themselves"}},
        no_inputs,
        "tpms(\"gyroid\", map=curve_cells([(0, 0, 0), (15, 0, 0), (20, 12, 8)], 5, 5, count=(6, 1, 1)), "
        "thickness=0.4, material=\"red\");",
        outputs()};
  }

  bool complete(const Reader& reader) {
    curve = smooth_curve(points, {toward, is_closed ? CurveRule::Ends::closed : CurveRule::Ends::straight}, reader);
    if (!curve) return false;
    curve->set_reach(reach() * (1 + 1e-9));
    return fits(reader) && find_counts(reader, {curve->length(), width, depth}, size, count, counts);
  }

  Slope cells_at(const Point& p) const {
    return {read(p, CurveFrames::along) * (counts.x / curve->length()),
            (read(p, CurveFrames::first) / width + 0.5) * counts.y,
            (read(p, CurveFrames::second) / depth + 0.5) * counts.z};
  }
  // Frames that turn around the curve shear the cells.
  bool has_right_angles() const { return curve->turn() == 0; }
  Slope size_at(const Point& p) const {
    return {stretch(p) * (curve->length() / counts.x), p.constant(width / counts.y), p.constant(depth / counts.z)};
  }

  // Where the curve moves on by ds, the point (a, b) of a section moves by stretch ds along the tangent. Across, it
  // moves by -b turn ds along the direction of a, and by a turn ds along that of b. Slopes are the rows of the inverse
  // map.
  Slope slope(const Point& p, size_t n) const {
    const Slope tangent = read_vector(p, CurveFrames::tangent_x), up = read_vector(p, CurveFrames::normal_x);
    const double length = n == 0 ? curve->length() : n == 1 ? width : depth;
    const double per_mm = counts[static_cast<int>(n)] / length;
    if (n == 0) return sum_of(tangent, inverse(stretch(p)) * per_mm, tangent, p.constant(0));
    const Slope across = n == 1 ? cross_without_zeros(up, tangent) : up;
    const Field other = read(p, n == 1 ? CurveFrames::second : CurveFrames::first);
    const Field onward = other * inverse(stretch(p)) * ((n == 1 ? 1 : -1) * curve->turn() * per_mm);
    return sum_of(across, p.constant(per_mm), tangent, onward);
  }

  Field outside(const Ask& ask) const {
    const Point& p = ask.p;
    const Field sides =
        max(abs(read(p, CurveFrames::first)) - width / 2, abs(read(p, CurveFrames::second)) - depth / 2);
    const Field rod = max(sides, read(p, CurveFrames::distance) - reach());
    if (is_closed) return rod;
    return max(rod, abs(read(p, CurveFrames::along) - curve->length() / 2) - curve->length() / 2);
  }
  Box region_within(const Box&) const { return curve->box().expanded(reach()); }

 private:
  double reach() const { return std::hypot(width, depth) / 2; }

  Field read(const Point& p, int channel) const { return p.builder().source(curve, channel, p.x, p.y, p.z); }
  Slope read_vector(const Point& p, int channel) const {
    return {read(p, channel), read(p, channel + 1), read(p, channel + 2)};
  }
  Field stretch(const Point& p) const {
    constexpr double least = 1e-6;  // beyond the centre of curvature there are no cells
    return max(read(p, CurveFrames::stretch), least);
  }
  static Field inverse(Field v) { return v.builder->constant(1) / v; }
  static Slope sum_of(const Slope& a, Field share_a, const Slope& b, Field share_b) {
    Slope sum = a;
    for (size_t n = 0; n < 3; ++n)
      sum[n] = sum_without_zeros(product_without_zeros(a[n], share_a), product_without_zeros(b[n], share_b));
    return sum;
  }

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
