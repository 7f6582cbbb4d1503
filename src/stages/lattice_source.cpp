#include "stages/lattice_source.h"

#include <algorithm>
#include <cmath>

namespace ombre::compile {
namespace {

// Distance in cells below which centres count as the same.
constexpr double centre_slack = 1e-6;

// Returns the signed distance to the box, negative inside.
double distance_to(const Box& box, Vec3 p) {
  Vec3 beyond;
  double deepest = -Box::inf;
  for (int axis = 0; axis < 3; ++axis) {
    const double out = std::max(box.lo[axis] - p[axis], p[axis] - box.hi[axis]);
    beyond[axis] = std::max(out, 0.0);
    deepest = std::max(deepest, out);
  }
  return deepest > 0 ? length(beyond) : deepest;
}

// Reads the cells of a source that lie under the voxels of a job.
class CellRows final : public program::ValueSampler {
 public:
  // Values beyond `cells` are 0.
  CellRows(const LatticeSource& source, size_t channel, const CellIndex& shift, const IndexBox& cells)
      : source_(source), channel_(channel), shift_(shift), cells_(cells) {}

  void values(int64_t i, int64_t j, int64_t k, std::span<float> values) const override {
    const CellIndex cell = shifted({i, j, k});
    const IndexBox row{cell, {cell[0] + static_cast<int64_t>(values.size()), cell[1] + 1, cell[2] + 1}};
    const IndexBox within = intersect(row, cells_);
    if (within.is_empty()) return std::fill(values.begin(), values.end(), 0.0f);
    const auto begin = static_cast<size_t>(within.lo[0] - cell[0]), end = static_cast<size_t>(within.hi[0] - cell[0]);
    std::fill_n(values.begin(), begin, 0.0f);
    std::fill(values.begin() + static_cast<ptrdiff_t>(end), values.end(), 0.0f);
    source_.read_cells(channel_, within.lo, values.subspan(begin, end - begin));
  }
  Interval range(const IndexBox& voxels) const override {
    const IndexBox cells{shifted(voxels.lo), shifted(voxels.hi)}, within = intersect(cells, cells_);
    if (within.is_empty()) return Interval(0);
    const Interval range = source_.range_of_cells(channel_, within);
    return within == cells ? range : hull(range, 0);
  }

 private:
  CellIndex shifted(const CellIndex& voxel) const {
    return {voxel[0] + shift_[0], voxel[1] + shift_[1], voxel[2] + shift_[2]};
  }

  const LatticeSource& source_;
  size_t channel_;
  CellIndex shift_;
  IndexBox cells_;
};

// A reader that reads cells one by one.
class PlainReader final : public CellReader {
 public:
  explicit PlainReader(const LatticeSource& source) : source_(source) {}
  void read(size_t channel, const CellIndex& first, std::span<float> values) override {
    source_.read_cells(channel, first, values);
  }

 private:
  const LatticeSource& source_;
};

double between(double a, double b, double share) { return share > 0 ? a + share * (b - a) : a; }

// Returns the cells whose centres lie in the box.
IndexBox centres_in(const Box& box, const LatticeFrame& frame) {
  IndexBox cells = frame.cells;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    const double pitch = frame.lattice.pitch[a].mm(), origin = frame.lattice.origin[axis];
    const double lo = std::ceil((box.lo[axis] - origin) / pitch - 0.5 - centre_slack);
    const double hi = std::floor((box.hi[axis] - origin) / pitch - 0.5 + centre_slack) + 1;
    if (lo > static_cast<double>(cells.lo[a])) cells.lo[a] = static_cast<int64_t>(lo);
    if (hi < static_cast<double>(cells.hi[a])) cells.hi[a] = static_cast<int64_t>(hi);
  }
  return cells;
}

}  // namespace

LatticeSource::LatticeSource(LatticeFrame frame)
    : frame_(std::move(frame)), cell_mm_(frame_.lattice.voxel_mm()), cells_in_box_(centres_in(frame_.box, frame_)) {
  for (size_t n = 0; n < frame_.channels.size(); ++n)
    if (frame_.channels[n].name == "inside" && frame_.channels[n].is_flag) inside_ = static_cast<int>(n);
}

int LatticeSource::channel(std::string_view channel_name) const {
  const auto found = std::ranges::find(frame_.channels, channel_name, &design::StageChannel::name);
  if (found != frame_.channels.end()) return static_cast<int>(found - frame_.channels.begin());
  return channel_name == "distance" && inside_ >= 0 ? static_cast<int>(frame_.channels.size()) : -1;
}

double LatticeSource::sample(int channel, Vec3 p) const {
  if (is_distance(channel)) return distance(p);
  const auto n = static_cast<size_t>(channel);
  if (!frame_.channels[n].is_flag) {
    double value = 0;
    sample_all(channel, {&p, 1}, {&value, 1});
    return value;
  }
  return frame_.box.contains(p) ? at(n, cell_of(p)) : 0;
}

void LatticeSource::sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const {
  if (is_distance(channel) || frame_.channels[static_cast<size_t>(channel)].is_flag)
    return FieldSource::sample_all(channel, points, values);
  const auto cells = reader();
  for (size_t n = 0; n < points.size(); ++n)
    values[n] = between_centres(static_cast<size_t>(channel), points[n], *cells);
}

Interval LatticeSource::range(int channel, const Box& box) const {
  if (!is_distance(channel)) {
    const auto n = static_cast<size_t>(channel);
    if (frame_.channels[n].is_flag) return range_of_flag(n, box);
    return range_between_centres(n, box);
  }
  if (!box.is_bounded() || !has_values()) return Interval::everything();
  const Interval flags = range_of_flag(static_cast<size_t>(inside_), box);
  const Vec3 center = box.center();
  const double value = distance(center), room = 0.5 * length(box.size());
  return outward(flags.hi == 0 ? std::max(0.0, value - room) : value - room,
                 flags.lo == 1 ? std::min(0.0, value + room) : value + room);
}

std::unique_ptr<program::RowSampler> LatticeSource::rows(int channel, const Affine& source_from_index) const {
  if (is_distance(channel)) return nullptr;
  CellIndex shift;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 step;
    step[axis] = cell_mm_[axis];
    for (int other = 0; other < 3; ++other)
      if (!(std::abs(source_from_index.rows[static_cast<size_t>(axis)][other] - step[other]) <=
            centre_slack * centre_slack * cell_mm_[axis]))
        return nullptr;
    const double cells = (source_from_index.offset[axis] - frame_.lattice.origin[axis]) / cell_mm_[axis] - 0.5;
    if (!(std::abs(cells - std::round(cells)) <= centre_slack)) return nullptr;
    shift[static_cast<size_t>(axis)] = static_cast<int64_t>(std::llround(cells));
  }
  const auto n = static_cast<size_t>(channel);
  return std::make_unique<CellRows>(*this, n, shift, frame_.channels[n].is_flag ? cells_in_box_ : frame_.cells);
}

std::unique_ptr<CellReader> LatticeSource::reader() const { return std::make_unique<PlainReader>(*this); }

Interval LatticeSource::declared_range(size_t channel) const { return hull(frame_.channels[channel].range, 0); }

CellIndex LatticeSource::cell_of(Vec3 p) const {
  CellIndex cell;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    const double lo = static_cast<double>(frame_.cells.lo[a]) - 2, hi = static_cast<double>(frame_.cells.hi[a]) + 1;
    const double cells = std::floor((p[axis] - frame_.lattice.origin[axis]) / cell_mm_[axis]);
    cell[a] = static_cast<int64_t>(cells >= lo ? std::min(cells, hi) : lo);  // NaN goes to lo
  }
  return cell;
}

float LatticeSource::at(size_t channel, const CellIndex& cell) const {
  for (size_t a = 0; a < 3; ++a)
    if (cell[a] < frame_.cells.lo[a] || cell[a] >= frame_.cells.hi[a]) return 0;
  float value = 0;
  read_cells(channel, cell, {&value, 1});
  return value;
}

Box LatticeSource::box_of(const CellIndex& cell) const {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<double>(cell[static_cast<size_t>(axis)]);
    box.lo[axis] = frame_.lattice.origin[axis] + at * cell_mm_[axis];
    box.hi[axis] = frame_.lattice.origin[axis] + (at + 1) * cell_mm_[axis];
  }
  return box;
}

// Interpolates along x, then y, then z. If all values are the same, the result is exactly that value.
double LatticeSource::between_centres(size_t channel, Vec3 p, CellReader& reader) const {
  if (!is_finite(p)) return 0;
  CellIndex low;
  std::array<double, 3> share;  // fraction of the way to the next centre
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    const double at = in_centres(axis, p[axis]), nearest = std::round(at);
    const bool is_centre = std::abs(at - nearest) <= centre_slack;
    const double below = is_centre ? nearest : std::floor(at);
    low[a] = static_cast<int64_t>(below);
    share[a] = is_centre ? 0 : at - below;
  }
  if (const auto same = reader.same_around(channel, low)) return static_cast<double>(*same);
  std::array<double, 2> layers{};
  for (int64_t k = 0; k < (share[2] > 0 ? 2 : 1); ++k) {
    std::array<double, 2> rows{};
    for (int64_t j = 0; j < (share[1] > 0 ? 2 : 1); ++j) {
      const auto [first, second] = pair_at(channel, {low[0], low[1] + j, low[2] + k}, reader);
      rows[static_cast<size_t>(j)] = between(first, second, share[0]);
    }
    layers[static_cast<size_t>(k)] = between(rows[0], rows[1], share[1]);
  }
  return between(layers[0], layers[1], share[2]);
}

// Returns the distance in cells from the first cell's centre; a place beyond all cells gives some number there.
double LatticeSource::in_centres(int axis, double mm) const {
  const auto a = static_cast<size_t>(axis);
  const double lo = static_cast<double>(frame_.cells.lo[a]) - 2, hi = static_cast<double>(frame_.cells.hi[a]) + 1;
  return std::clamp((mm - frame_.lattice.origin[axis]) / cell_mm_[axis] - 0.5, lo, hi);
}

std::array<float, 2> LatticeSource::pair_at(size_t channel, const CellIndex& cell, CellReader& reader) const {
  std::array<float, 2> values{};
  const IndexBox pair{cell, {cell[0] + 2, cell[1] + 1, cell[2] + 1}}, within = intersect(pair, frame_.cells);
  if (within.is_empty()) return values;
  const auto begin = static_cast<size_t>(within.lo[0] - cell[0]);
  reader.read(channel, within.lo, std::span(values).subspan(begin, static_cast<size_t>(within.size(0))));
  return values;
}

Interval LatticeSource::range_between_centres(size_t channel, const Box& box) const {
  const Interval declared = hull(frame_.channels[channel].range, 0);
  if (!has_values() || declared.is_everything() || !box.is_bounded()) return declared;
  IndexBox touched;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    touched.lo[a] = static_cast<int64_t>(std::floor(in_centres(axis, box.lo[axis]) - centre_slack));
    touched.hi[a] = static_cast<int64_t>(std::floor(in_centres(axis, box.hi[axis]) + centre_slack)) + 2;
  }
  const IndexBox cells = intersect(touched, frame_.cells);
  if (cells.is_empty()) return Interval(0);
  Interval range = range_of_cells(channel, cells);
  if (cells != touched) range = hull(range, 0);
  if (range.is_point()) return range;
  const double rounding = 1e-12 * (std::abs(range.lo) + std::abs(range.hi));
  return {range.lo - rounding, range.hi + rounding};
}

double LatticeSource::distance(Vec3 p) const { return std::max(distance_to(frame_.box, p), distance_to_cells(p)); }

// Returns the distance to the nearest cell of the other kind among the neighbours.
double LatticeSource::distance_to_cells(Vec3 p) const {
  const CellIndex own = cell_of(p);
  const bool is_inside = holds(own);
  double least = std::min({cell_mm_.x, cell_mm_.y, cell_mm_.z});
  for (int64_t n = 0; n < 27; ++n) {
    const CellIndex other{own[0] + n % 3 - 1, own[1] + n / 3 % 3 - 1, own[2] + n / 9 - 1};
    if (holds(other) != is_inside) least = std::min(least, std::max(0.0, distance_to(box_of(other), p)));
  }
  return is_inside ? -least : least;
}

Interval LatticeSource::range_of_flag(size_t channel, const Box& box) const {
  const Box within = intersect(box, frame_.box);
  if (within.is_empty()) return Interval(0);
  if (!has_values()) return {0, 1};
  const CellIndex lo = cell_of(within.lo), hi = cell_of(within.hi);
  const IndexBox touched{lo, {hi[0] + 1, hi[1] + 1, hi[2] + 1}}, cells = intersect(touched, frame_.cells);
  if (cells.is_empty()) return Interval(0);
  const Interval flags = range_of_cells(channel, cells);
  return within == box && cells == touched ? flags : hull(flags, 0);
}

}  // namespace ombre::compile
