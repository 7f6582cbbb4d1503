#include "import/fields/volume_source.h"

#include <cmath>
#include <limits>
#include <optional>

#include "import/fields/value_blocks.h"

namespace ombre::importing {
namespace {

enum VolumeChannel : int { value_channel, nearest_channel, cubic_channel, cubic_x, cubic_y, cubic_z };
constexpr std::array<std::string_view, 6> channel_names{"value", "nearest", "cubic", "cubic_x", "cubic_y", "cubic_z"};

template <class T>
struct Grid {
  formats::VoxelVolume volume;
  VoxelCorner count;
  formats::Numbers<T> values;

  explicit Grid(formats::VoxelVolume from)
      : volume(std::move(from)),
        count(volume.count),
        values(volume.in_file.empty() ? formats::Numbers<T>(std::get<std::vector<T>>(volume.values))
                                      : formats::Numbers<T>(volume.in_file.data(), volume.in_file.size() / sizeof(T))) {
  }

  size_t row(int64_t j, int64_t k) const { return static_cast<size_t>((k * count[1] + j) * count[0]); }
  double at(int64_t i, int64_t j, int64_t k) const {
    return static_cast<double>(values[row(j, k) + static_cast<size_t>(i)]);
  }
  // Returns the range of the voxels [first, end) of a row.
  Interval range_of_row(int64_t j, int64_t k, int64_t first, int64_t end) const {
    const size_t begin = row(j, k);
    T least = values[begin + static_cast<size_t>(first)], greatest = least;
    for (int64_t i = first + 1; i < end; ++i) {
      const T value = values[begin + static_cast<size_t>(i)];
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
    return {static_cast<double>(least), static_cast<double>(greatest)};
  }
};

// A place between two voxels along an axis; `share` is its distance from the first of them.
struct VoxelPair {
  int64_t first, next;
  double share;
};

VoxelPair pair_at(double at, int64_t count) {
  const double place = std::clamp(at, 0.0, static_cast<double>(count - 1));
  const auto first = static_cast<int64_t>(place);
  return {first, std::min(first + 1, count - 1), place - static_cast<double>(first)};
}

int64_t nearest_to(double at, int64_t count) {
  return static_cast<int64_t>(std::clamp(std::floor(at + 0.5), 0.0, static_cast<double>(count - 1)));
}

double blend(double a, double b, double share) { return a + share * (b - a); }

template <class T>
double interpolated(const Grid<T>& grid, Vec3 p) {
  const VoxelPair x = pair_at(p.x, grid.count[0]), y = pair_at(p.y, grid.count[1]), z = pair_at(p.z, grid.count[2]);
  const auto row = [&](int64_t j, int64_t k) { return blend(grid.at(x.first, j, k), grid.at(x.next, j, k), x.share); };
  const auto layer = [&](int64_t k) { return blend(row(y.first, k), row(y.next, k), y.share); };
  return blend(layer(z.first), layer(z.next), z.share);
}

// The eight voxels around places that differ in x only: for each of four rows, the value at the first voxel and the
// difference to the next.
struct CellCorners {
  std::array<double, 4> values{}, differences{};

  template <class T>
  CellCorners(const Grid<T>& grid, const std::array<size_t, 4>& rows, const VoxelPair& x) {
    for (size_t n = 0; n < 4; ++n) {
      values[n] = static_cast<double>(grid.values[rows[n] + static_cast<size_t>(x.first)]);
      differences[n] = static_cast<double>(grid.values[rows[n] + static_cast<size_t>(x.next)]) - values[n];
    }
  }
  double at(double share, double share_y, double share_z) const {
    const auto row = [&](size_t n) { return values[n] + share * differences[n]; };
    return blend(blend(row(0), row(1), share_y), blend(row(2), row(3), share_y), share_z);
  }
};

// Interpolates like interpolated(), for the points from number n on that lie in one row along x, and returns the number
// of the first other point. Corners of a cell are looked up once, because many points of a fine lattice lie in the same
// cell.
template <class T>
size_t interpolate_row(const Grid<T>& grid, std::span<const Vec3> points, size_t n, std::span<double> values) {
  const Vec3 p = points[n];
  const VoxelPair y = pair_at(p.y, grid.count[1]), z = pair_at(p.z, grid.count[2]);
  const std::array<size_t, 4> rows{grid.row(y.first, z.first), grid.row(y.next, z.first), grid.row(y.first, z.next),
                                   grid.row(y.next, z.next)};
  size_t row_end = n + 1;
  while (row_end < points.size() && points[row_end].y == p.y && points[row_end].z == p.z &&
         !std::isnan(points[row_end].x))
    ++row_end;
  const double last = static_cast<double>(grid.count[0] - 1);
  while (n < row_end) {
    const VoxelPair x = pair_at(points[n].x, grid.count[0]);
    const CellCorners corners(grid, rows, x);
    const double begin = static_cast<double>(x.first), end = begin + 1;
    const auto place = [&](size_t m) { return std::min(std::max(points[m].x, 0.0), last); };
    size_t cell_end = n + 1;
    while (cell_end < row_end && place(cell_end) >= begin && place(cell_end) < end) ++cell_end;
    for (; n < cell_end; ++n) values[n] = corners.at(place(n) - begin, y.share, z.share);
  }
  return n;
}

// Four voxels around a place along an axis, with their weights and the derivatives of the weights.
struct VoxelFour {
  std::array<int64_t, 4> voxels{};
  std::array<double, 4> weights{}, slopes{};
};

VoxelFour four_at(double at, int64_t count) {
  // From two voxels beyond the grid on, all values are equal.
  const double place = std::clamp(at, -2.0, static_cast<double>(count + 1)), floor = std::floor(place),
               t = place - floor;
  VoxelFour four;
  for (size_t n = 0; n < 4; ++n)
    four.voxels[n] = std::clamp(static_cast<int64_t>(floor) + static_cast<int64_t>(n) - 1, int64_t{0}, count - 1);
  four.weights = {((-0.5 * t + 1) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1, ((-1.5 * t + 2) * t + 0.5) * t,
                  (0.5 * t - 0.5) * t * t};
  four.slopes = {(-1.5 * t + 2) * t - 0.5, (4.5 * t - 5) * t, (-4.5 * t + 4) * t + 0.5, (1.5 * t - 1) * t};
  return four;
}

// Interpolates 4 x 4 x 4 voxels; the axis of a derivative uses slopes instead of weights.
template <class T>
double cubic_at(const Grid<T>& grid, Vec3 p, int channel) {
  const VoxelFour x = four_at(p.x, grid.count[0]), y = four_at(p.y, grid.count[1]), z = four_at(p.z, grid.count[2]);
  const auto& by_x = channel == cubic_x ? x.slopes : x.weights;
  const auto& by_y = channel == cubic_y ? y.slopes : y.weights;
  const auto& by_z = channel == cubic_z ? z.slopes : z.weights;
  double sum = 0;
  for (size_t k = 0; k < 4; ++k) {
    double layer = 0;
    for (size_t j = 0; j < 4; ++j) {
      double row = 0;
      for (size_t i = 0; i < 4; ++i) row += by_x[i] * grid.at(x.voxels[i], y.voxels[j], z.voxels[k]);
      layer += by_y[j] * row;
    }
    sum += by_z[k] * layer;
  }
  return sum;
}

// Rows whose points are centres of voxels: the map's coefficients are integers.
template <class T>
class GridRows final : public program::ValueSampler {
 public:
  GridRows(std::shared_ptr<const Grid<T>> grid, std::shared_ptr<const ValueBlocks> blocks,
           std::array<VoxelCorner, 3> steps, VoxelCorner offset)
      : grid_(std::move(grid)), blocks_(std::move(blocks)), steps_(steps), offset_(offset) {}

  void values(int64_t i, int64_t j, int64_t k, std::span<float> values) const override {
    VoxelCorner at = place(i, j, k);
    if (steps_[0][0] == 1 && steps_[1][0] == 0 && steps_[2][0] == 0) return copy_row(at, values);
    for (float& value : values) {
      value = static_cast<float>(grid_->at(clamped(at[0], 0), clamped(at[1], 1), clamped(at[2], 2)));
      for (size_t axis = 0; axis < 3; ++axis) at[axis] += steps_[axis][0];
    }
  }

  Interval range(const IndexBox& box) const override {
    VoxelCorner lo = place(box.lo[0], box.lo[1], box.lo[2]), hi = lo;
    for (size_t axis = 0; axis < 3; ++axis) {
      for (size_t n = 0; n < 3; ++n) {
        const int64_t way = steps_[axis][n] * (box.hi[n] - 1 - box.lo[n]);
        (way < 0 ? lo : hi)[axis] += way;
      }
      lo[axis] = clamped(lo[axis], axis);
      hi[axis] = clamped(hi[axis], axis);
    }
    return blocks_->over(lo, hi);
  }

 private:
  VoxelCorner place(int64_t i, int64_t j, int64_t k) const {
    VoxelCorner at = offset_;
    for (size_t axis = 0; axis < 3; ++axis) at[axis] += steps_[axis][0] * i + steps_[axis][1] * j + steps_[axis][2] * k;
    return at;
  }
  // Copies a piece of a row of the grid, and repeats the outermost voxels beyond its ends.
  void copy_row(const VoxelCorner& at, std::span<float> values) const {
    const auto count = static_cast<int64_t>(values.size()), length = grid_->count[0];
    const formats::Numbers<T>& all = grid_->values;
    const size_t row = grid_->row(clamped(at[1], 1), clamped(at[2], 2));
    const int64_t begin = std::clamp<int64_t>(-at[0], 0, count),
                  end = std::clamp<int64_t>(length - at[0], begin, count);
    float* to = std::fill_n(values.data(), begin, static_cast<float>(all[row]));
    const size_t from = row + static_cast<size_t>(at[0] + begin);
    for (int64_t n = 0; n < end - begin; ++n) to[n] = static_cast<float>(all[from + static_cast<size_t>(n)]);
    std::fill_n(to + (end - begin), count - end, static_cast<float>(all[row + static_cast<size_t>(length) - 1]));
  }

  int64_t clamped(int64_t at, size_t axis) const { return std::clamp<int64_t>(at, 0, grid_->count[axis] - 1); }

  std::shared_ptr<const Grid<T>> grid_;
  std::shared_ptr<const ValueBlocks> blocks_;
  std::array<VoxelCorner, 3> steps_;  // for each axis of the grid, the step per step along x, y and z
  VoxelCorner offset_;
};

// Returns the integer nearest to a coefficient, or null if it is farther than the tolerance.
std::optional<int64_t> whole_number(double value, double tolerance) {
  constexpr double most = 1e9;
  const double whole = std::round(value);
  if (!(std::abs(value) <= most) || std::abs(value - whole) > tolerance) return std::nullopt;
  return static_cast<int64_t>(whole);
}

template <class T>
class GridSource final : public program::NamedSource {
 public:
  GridSource(std::string name, Hash content, formats::VoxelVolume volume)
      : NamedSource(std::move(name), content),
        grid_(std::make_shared<Grid<T>>(std::move(volume))),
        blocks_(std::make_shared<ValueBlocks>(grid_->count, [&](int64_t j, int64_t k, int64_t first, int64_t end) {
          return grid_->range_of_row(j, k, first, end);
        })) {}

  Box bounds() const override {
    const auto& [nx, ny, nz] = grid_->count;
    return {{-0.5, -0.5, -0.5},
            {static_cast<double>(nx) - 0.5, static_cast<double>(ny) - 0.5, static_cast<double>(nz) - 0.5}};
  }
  int channel(std::string_view channel_name) const override {
    const auto found = std::ranges::find(channel_names, channel_name);
    return found == channel_names.end() ? -1 : static_cast<int>(found - channel_names.begin());
  }
  const ValueBlocks& blocks() const { return *blocks_; }
  // Returns the size in memory; numbers that stay in a file need none.
  size_t bytes() const {
    return (grid_->volume.stays_in_file ? 0 : grid_->values.size() * sizeof(T)) + blocks_->bytes();
  }

  double sample(int channel, Vec3 p) const override {
    if (std::isnan(p.x + p.y + p.z)) return std::numeric_limits<double>::quiet_NaN();
    if (channel == value_channel) return interpolated(*grid_, p);
    if (channel >= cubic_channel) return cubic_at(*grid_, p, channel);
    return grid_->at(nearest_to(p.x, grid_->count[0]), nearest_to(p.y, grid_->count[1]),
                     nearest_to(p.z, grid_->count[2]));
  }

  void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const override {
    if (channel != value_channel) return FieldSource::sample_all(channel, points, values);
    for (size_t n = 0; n < points.size();) {
      const Vec3& p = points[n];
      if (std::isnan(p.x + p.y + p.z))
        values[n++] = std::numeric_limits<double>::quiet_NaN();
      else
        n = interpolate_row(*grid_, points, n, values);
    }
  }

  Interval range(int channel, const Box& box) const override {
    if (channel >= cubic_channel) return cubic_range(channel, box);
    VoxelCorner lo, hi;
    for (int axis = 0; axis < 3; ++axis) {
      const Interval along = box.axis(axis);
      if (!(along.lo <= along.hi)) return blocks_->whole();
      const auto a = static_cast<size_t>(axis);
      lo[a] =
          channel == value_channel ? pair_at(along.lo, grid_->count[a]).first : nearest_to(along.lo, grid_->count[a]);
      hi[a] =
          channel == value_channel ? pair_at(along.hi, grid_->count[a]).next : nearest_to(along.hi, grid_->count[a]);
    }
    const Interval found = blocks_->over(lo, hi);
    if (channel == nearest_channel) return found;
    constexpr double rounding = 1e-12;
    const double room = rounding * std::max(std::abs(found.lo), std::abs(found.hi));
    return {found.lo - room, found.hi + room};
  }

  std::unique_ptr<program::RowSampler> rows(int channel, const Affine& source_from_index) const override {
    constexpr double step_tolerance = 1e-8, offset_tolerance = 1e-4;
    if (!has_exact_floats() || channel > cubic_channel) return nullptr;
    std::array<VoxelCorner, 3> steps;
    VoxelCorner offset;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto start = whole_number(source_from_index.offset[static_cast<int>(axis)], offset_tolerance);
      if (!start) return nullptr;
      offset[axis] = *start;
      for (size_t n = 0; n < 3; ++n) {
        const auto step = whole_number(source_from_index.rows[axis][static_cast<int>(n)], step_tolerance);
        if (!step) return nullptr;
        steps[axis][n] = *step;
      }
    }
    return std::make_unique<GridRows<T>>(grid_, blocks_, steps, offset);
  }

 private:
  // The weights of an axis sum to 1 and their magnitudes to at most 5/4, half way between voxels; those of a derivative
  // sum to 0, and their magnitudes to at most 3.
  Interval cubic_range(int channel, const Box& box) const {
    VoxelCorner lo, hi;
    for (int axis = 0; axis < 3; ++axis) {
      const Interval along = box.axis(axis);
      const auto a = static_cast<size_t>(axis);
      const bool is_known = along.lo <= along.hi;
      lo[a] = is_known ? four_at(along.lo, grid_->count[a]).voxels.front() : 0;
      hi[a] = is_known ? four_at(along.hi, grid_->count[a]).voxels.back() : grid_->count[a] - 1;
    }
    const Interval found = blocks_->over(lo, hi);
    constexpr double rounding = 1e-12, along_axis = 1.25, of_slope = 3;
    const double middle = 0.5 * (found.lo + found.hi), half = 0.5 * (found.hi - found.lo),
                 room = rounding * std::max(std::abs(found.lo), std::abs(found.hi));
    const bool is_slope = channel != cubic_channel;
    const double reach = half * along_axis * along_axis * (is_slope ? of_slope : along_axis) + 2 * room;
    return is_slope ? Interval(-reach, reach) : Interval(middle - reach, middle + reach);
  }

  bool has_exact_floats() const {
    if constexpr (std::is_same_v<T, double>) return false;
    if constexpr (std::is_same_v<T, float> || sizeof(T) <= 2) return true;
    constexpr double most = 0x1p24;
    return blocks_->whole().lo >= -most && blocks_->whole().hi <= most;
  }

  std::shared_ptr<const Grid<T>> grid_;
  std::shared_ptr<const ValueBlocks> blocks_;
};

// A voxel's value has influence up to the centre of the next voxel, with "nearest" half as far. Cubic values overshoot
// by an eighth of the difference between voxels along each axis.
Box places_with(const ValueBlocks& blocks, const Box& grid, int channel, Interval values) {
  if (channel == cubic_channel) {
    constexpr double overshoot = 0.5 * (1.25 * 1.25 * 1.25 - 1);
    const double more = overshoot * (blocks.whole().hi - blocks.whole().lo);
    values = {values.lo - more, values.hi + more};
  }
  const double reach = channel == nearest_channel ? 0.5
                       : channel == value_channel ? 1
                                                  : 2,
               block = static_cast<double>(blocks.edge() - 1);
  Box box = Box::empty();
  blocks.each_with(values, [&](const VoxelCorner& at) {
    const Vec3 first{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
    box = hull(box, Box{first, first + Vec3{block, block, block}});
  });
  return box.is_empty() ? box : intersect(box.expanded(reach), grid);
}

}  // namespace

VolumeSource make_volume_source(std::string name, formats::VoxelVolume volume, Hash content) {
  return std::visit(
      [&]<class T>(const std::vector<T>&) {
        const auto source = std::make_shared<const GridSource<T>>(std::move(name), content, std::move(volume));
        const auto places = [source](int channel, Interval wanted) {
          return places_with(source->blocks(), source->bounds(), channel, wanted);
        };
        return VolumeSource{source, source->blocks().whole(), places, source->bytes()};
      },
      volume.values);
}

}  // namespace ombre::importing
