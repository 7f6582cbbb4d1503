// Finds the voxels of a row inside of a mesh, by winding numbers.
#include "import/surfaces/row_winding.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace ombre::importing {
namespace {

using Crossing = RowWinding::Crossing;
using program::Span;

// Largest index of a voxel; up to it, doubles represent every integer.
constexpr double farthest_index = 4e15;
constexpr uint32_t most_layer_cells = 1u << 20;
// Number of layers whose outlines each thread caches, because layers are requested a few rows at a time.
constexpr size_t remembered_layers = 32;

uint64_t next_id() {
  static std::atomic<uint64_t> last{0};
  return ++last;
}

std::vector<Vec3> place(const Surface& surface, const Affine& source_from_index) {
  const Affine index_from_source = inverse(source_from_index);
  std::vector<Vec3> placed;
  placed.reserve(surface.vertices.size());
  for (const Vec3& p : surface.vertices) placed.push_back(index_from_source(p));
  return placed;
}

// Returns the first integer not less than `value`, clamped to [lo, hi]; lo for NaN.
int64_t ceil_within(double value, int64_t lo, int64_t hi) {
  if (!(value > static_cast<double>(lo))) return lo;
  if (value > static_cast<double>(hi)) return hi;
  return static_cast<int64_t>(std::ceil(value));
}

// Returns the bins of triangles by the layers zmin <= k < zmax that they cross; triangles between two layers are left
// out.
DyadicBins bin_by_layer(const Surface& surface, const std::vector<Vec3>& vertices) {
  std::vector<DyadicBins::Rectangle> ranges;
  double lowest = farthest_index, highest = -farthest_index;
  for (uint32_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& t = surface.triangles[i];
    const auto [least, greatest] = std::minmax({vertices[t[0]].z, vertices[t[1]].z, vertices[t[2]].z});
    if (!(std::abs(least) < farthest_index && std::abs(greatest) < farthest_index)) continue;
    const double first = std::ceil(least), last = std::ceil(greatest) - 1;
    if (first > last) continue;
    ranges.push_back({{first, 0}, {last, 0}, i});
    lowest = std::min(lowest, first);
    highest = std::max(highest, last);
  }
  const double layers = std::max(1.0, highest - lowest + 1);
  const double cells = std::min({layers, static_cast<double>(ranges.size() + 1), double{most_layer_cells}});
  return {ranges, {static_cast<uint32_t>(cells), 1}};
}

// Appends the spans of a row inside of the mesh. The winding number starts with `winding` and changes at the crossings.
// A row that is not closed ends at its last crossing.
void append_spans(std::span<Crossing> row, int64_t winding, InsideRule rule, std::vector<Span>& spans) {
  std::sort(row.begin(), row.end(), [](const Crossing& a, const Crossing& b) { return a.voxel < b.voxel; });
  int64_t begin = 0;
  for (size_t i = 0; i < row.size();) {
    const int64_t voxel = row[i].voxel;
    const bool was_inside = is_inside(winding, rule);
    for (; i < row.size() && row[i].voxel == voxel; ++i) winding += row[i].winding;
    if (is_inside(winding, rule) == was_inside) continue;
    if (was_inside)
      spans.push_back({begin, voxel});
    else
      begin = voxel;
  }
  if (is_inside(winding, rule) && !row.empty() && row.back().voxel > begin) spans.push_back({begin, row.back().voxel});
}

// Surfaces are cut off at the eye, so winding numbers are counted from the far ends of rays.
int64_t winding_at_eye(std::span<const Crossing> row) {
  int64_t winding = 0;
  for (const Crossing& crossing : row) winding -= crossing.winding;
  return winding;
}

// Buffers that a thread reuses between calls.
struct Scratch {
  std::vector<Crossing> found, sorted;
  std::vector<size_t> ends;
};

// Sorts crossings by row; afterwards row r is sorted[ends[r], ends[r + 1]).
void sort_by_row(Scratch& scratch, int64_t j_begin, size_t row_count) {
  scratch.ends.assign(row_count + 2, 0);
  for (const Crossing& crossing : scratch.found) ++scratch.ends[crossing.row - j_begin + 2];
  for (size_t r = 2; r < scratch.ends.size(); ++r) scratch.ends[r] += scratch.ends[r - 1];
  scratch.sorted.resize(scratch.found.size());
  for (const Crossing& crossing : scratch.found) scratch.sorted[scratch.ends[crossing.row - j_begin + 1]++] = crossing;
}

}  // namespace

RowWinding::RowWinding(SurfacePtr surface, const Affine& source_from_index, InsideRule rule)
    : id_(next_id()),
      surface_(std::move(surface)),
      vertices_(place(*surface_, source_from_index)),
      rule_(rule),
      by_layer_(bin_by_layer(*surface_, vertices_)) {}

RowWinding::RowWinding(const Surface& surface, const program::RayLattice& rays, const Affine& source_from_view,
                       InsideRule rule)
    : id_(next_id()),
      surface_(std::make_shared<Surface>(seen_in_perspective(surface, rays, source_from_view))),
      vertices_(surface_->vertices),
      depth_(rays),
      rule_(rule),
      by_layer_(bin_by_layer(*surface_, vertices_)) {}

struct RowWinding::Outline {
  uint64_t of = 0;  // id of a placement; 0: none
  int64_t k = 0;
  std::vector<Segment> segments;
};

// Returns the segments of the outline in layer k. Valid until this thread requests another layer.
const std::vector<Segment>& RowWinding::outline(int64_t k) const {
  static thread_local std::array<Outline, remembered_layers> recent;
  Outline& kept = recent[(static_cast<uint64_t>(k) + id_) % remembered_layers];
  if (kept.of == id_ && kept.k == k) return kept.segments;
  kept.of = 0;
  kept.segments.clear();
  const auto plane = static_cast<double>(k);
  by_layer_.at(plane, 0, [&](uint32_t triangle) {
    const auto& t = surface_->triangles[triangle];
    if (const auto segment = slice({vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]}, plane))
      kept.segments.push_back(*segment);
  });
  kept.of = id_;
  kept.k = k;
  return kept.segments;
}

void RowWinding::cross_rows(const Segment& segment, int64_t j_begin, int64_t j_end, int64_t width,
                            std::vector<Crossing>& found) const {
  const auto [lowest, highest] = std::minmax(segment.from.y, segment.to.y);
  const int64_t begin = ceil_within(lowest, j_begin, j_end), end = ceil_within(highest, j_begin, j_end);
  for (int64_t j = begin; j < end; ++j) {
    const auto row = static_cast<double>(j);
    const int winding_here = winding(segment, row);
    if (winding_here == 0) continue;  // only if coordinates are NaN
    const double x = cross_row(segment, row);
    found.push_back({j, ceil_within(depth_ ? depth_->voxel(x) : x, 0, width), winding_here});
  }
}

void RowWinding::find_crossings(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
                                std::vector<Crossing>& found) const {
  const double below = static_cast<double>(j_begin), above = static_cast<double>(j_end - 1);
  for (const Segment& segment : outline(k)) {
    if (segment.from.y < below && segment.to.y < below) continue;
    if (segment.from.y > above && segment.to.y > above) continue;
    cross_rows(segment, j_begin, j_end, width, found);
  }
}

void RowWinding::layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
                       std::vector<std::vector<Span>>& rows) const {
  const auto row_count = static_cast<size_t>(std::max<int64_t>(0, j_end - j_begin));
  rows.resize(row_count);
  for (auto& row : rows) row.clear();

  static thread_local Scratch scratch;
  scratch.found.clear();
  find_crossings(k, j_begin, j_end, width, scratch.found);
  if (scratch.found.empty()) return;
  sort_by_row(scratch, j_begin, row_count);
  for (size_t r = 0; r < row_count; ++r) {
    const size_t begin = scratch.ends[r], end = scratch.ends[r + 1];
    const std::span<Crossing> row(scratch.sorted.data() + begin, end - begin);
    append_spans(row, depth_ ? winding_at_eye(row) : 0, rule_, rows[r]);
  }
}

}  // namespace ombre::importing
