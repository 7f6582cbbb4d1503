#include "import/fields/beam_rows.h"

#include <algorithm>
#include <cmath>

#include "import/fields/spans.h"

namespace ombre::importing {
namespace {

using program::Span;

// Distance from the eye below which nothing is visible, as a share of the distance from the eye to the picture plane.
constexpr double nearest_seen = 1.0 / 200;
// Largest coordinate of a voxel; up to it, doubles represent every integer.
constexpr double farthest_voxel = 4e15;
// Rounding error of a chord's end; a voxel centre nearer to the end is tested by itself.
constexpr double doubt = 1e-6;

int64_t whole(double index) { return static_cast<int64_t>(std::clamp(index, -farthest_voxel, farthest_voxel)); }

// Returns the first voxel at or after the beginning of a chord. A voxel whose centre is the beginning, up to rounding,
// is tested with `holds`.
template <class Holds>
int64_t first_voxel(double begin, const Holds& holds) {
  const double centre = std::nearbyint(begin);
  if (std::abs(begin - centre) > doubt * (1 + std::abs(centre))) return whole(std::ceil(begin));
  return whole(centre) + (holds(centre) ? 0 : 1);
}

// Returns a box around the beam in another space.
Box box_of(const BeamShape& shape, const Affine& to_from_source) {
  Vec3 reach;
  for (int axis = 0; axis < 3; ++axis) reach[axis] = shape.greatest_radius() * length(to_from_source.rows[axis]);
  const Vec3 start = to_from_source(shape.end(0)), end = to_from_source(shape.end(1));
  const Box around = hull(Box{start, start}, Box{end, end});
  return {around.lo - reach, around.hi + reach};
}

Interval least_and_greatest(std::initializer_list<double> values) { return {std::min(values), std::max(values)}; }

}  // namespace

BeamRows::BeamRows(BeamShapes shapes, const Affine& source_from_index)
    : shapes_(std::move(shapes)), grid_{source_from_index, false, {}} {
  build();
}

BeamRows::BeamRows(BeamShapes shapes, const program::RayLattice& rays, const Affine& source_from_view)
    : shapes_(std::move(shapes)), grid_{source_from_view, true, rays} {
  build();
}

void BeamRows::build() {
  const Affine grid_from_source = inverse(grid_.source_from_grid);
  for (uint32_t n = 0; n < shapes_->size(); ++n) {
    // Boxes are half a voxel larger, because rounding may move what lies on their sides.
    const Box box = grid_.index_box(box_of((*shapes_)[n], grid_from_source)).expanded(0.5);
    if (box.is_empty()) continue;
    numbers_.push_back(n);
    boxes_.push_back(box);
  }
  tree_ = BoxTree(boxes_);
}

BeamRows::Line BeamRows::Grid::line(int64_t j, int64_t k) const {
  const auto row = static_cast<double>(j), layer = static_cast<double>(k);
  if (!is_perspective) return {source_from_grid({0, row, layer}), source_from_grid.linear({1, 0, 0}), 0};
  // Behind the picture plane, lengths grow with the distance from the eye.
  const Vec3 place{0, row * rays.step.y + rays.first.y, layer * rays.step.z + rays.first.z};
  const double grown = 1 + rays.first.x / rays.eye_mm, growth = rays.step.x / rays.eye_mm;
  const Vec3 origin = Vec3{rays.first.x, 0, 0} + grown * place, step = Vec3{rays.step.x, 0, 0} + growth * place;
  return {source_from_grid(origin), source_from_grid.linear(step), whole(std::ceil((nearest_seen - grown) / growth))};
}

Box BeamRows::Grid::index_box(const Box& grid_box) const {
  if (!is_perspective) return grid_box;
  const double depth = std::max(grid_box.lo.x, (nearest_seen - 1) * rays.eye_mm);
  if (!(depth <= grid_box.hi.x)) return Box::empty();
  const double near = 1 + depth / rays.eye_mm, far = 1 + grid_box.hi.x / rays.eye_mm;
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = axis == 0 ? depth : grid_box.lo[axis], hi = grid_box.hi[axis];
    const Interval seen = axis == 0 ? Interval(lo, hi) : least_and_greatest({lo / near, lo / far, hi / near, hi / far});
    const double one = (seen.lo - rays.first[axis]) / rays.step[axis];
    const double other = (seen.hi - rays.first[axis]) / rays.step[axis];
    box.lo[axis] = std::min(one, other);
    box.hi[axis] = std::max(one, other);
  }
  return box;
}

void BeamRows::add(const BeamShape& shape, const Line& line, int64_t width, std::vector<Span>& row) const {
  if (shape.is_missed_by(line.origin, line.step)) return;
  for (const BeamShape::Piece piece : BeamShape::pieces) {
    if (!shape.has(piece)) continue;
    const Interval chord = shape.chord(piece, line.origin, line.step);
    if (!(chord.lo <= chord.hi)) continue;
    const auto holds = [&](double i) { return shape.holds(piece, line.origin + i * line.step); };
    const int64_t begin = std::max({first_voxel(chord.lo, holds), line.first, int64_t{0}});
    const int64_t end = std::min(-first_voxel(-chord.hi, [&](double i) { return holds(-i); }) + 1, width);
    if (begin < end) row.push_back({begin, end});
  }
}

void BeamRows::layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
                     std::vector<std::vector<Span>>& rows) const {
  rows.resize(static_cast<size_t>(std::max<int64_t>(0, j_end - j_begin)));
  for (auto& row : rows) row.clear();
  if (rows.empty()) return;
  std::vector<Line> lines;
  for (int64_t j = j_begin; j < j_end; ++j) lines.push_back(grid_.line(j, k));
  const auto layer = static_cast<double>(k);
  const Box here{{0, static_cast<double>(j_begin), layer},
                 {static_cast<double>(width), static_cast<double>(j_end - 1), layer}};
  tree_.each_that_meets(here, [&](uint32_t n) {
    const int64_t begin = std::max(j_begin, whole(std::ceil(boxes_[n].lo.y)));
    const int64_t end = std::min(j_end, whole(std::floor(boxes_[n].hi.y)) + 1);
    for (int64_t j = begin; j < end; ++j) {
      const auto row = static_cast<size_t>(j - j_begin);
      add((*shapes_)[numbers_[n]], lines[row], width, rows[row]);
    }
  });
  for (auto& row : rows) unite(row);
}

}  // namespace ombre::importing
