#include "import/volume_source.h"

#include <cmath>
#include <limits>
#include <optional>

#include "import/value_blocks.h"

namespace ombre::importing {
namespace {

enum VolumeChannel : int { value_channel = 0, nearest_channel = 1 };

template <class T>
struct Grid {
  VoxelCorner count;
  std::vector<T> values;

  const T* row(int64_t j, int64_t k) const {
    return values.data() + static_cast<size_t>((k * count[1] + j) * count[0]);
  }
  double at(int64_t i, int64_t j, int64_t k) const { return static_cast<double>(row(j, k)[i]); }
};

// A place between voxels along an axis: one of them, the next, and how far it is from the first to that.
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

// Centres of voxels under a map of whole numbers.
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
  // A piece of a row of the grid, between what goes on beyond its ends.
  void copy_row(const VoxelCorner& at, std::span<float> values) const {
    const auto count = static_cast<int64_t>(values.size()), length = grid_->count[0];
    const T* const row = grid_->row(clamped(at[1], 1), clamped(at[2], 2));
    const int64_t begin = std::clamp<int64_t>(-at[0], 0, count),
                  end = std::clamp<int64_t>(length - at[0], begin, count);
    float* to = std::fill_n(values.data(), begin, static_cast<float>(row[0]));
    for (int64_t n = begin; n < end; ++n) *to++ = static_cast<float>(row[at[0] + n]);
    std::fill_n(to, count - end, static_cast<float>(row[length - 1]));
  }

  int64_t clamped(int64_t at, size_t axis) const { return std::clamp<int64_t>(at, 0, grid_->count[axis] - 1); }

  std::shared_ptr<const Grid<T>> grid_;
  std::shared_ptr<const ValueBlocks> blocks_;
  std::array<VoxelCorner, 3> steps_;  // of each axis of the grid, for one along x, y and z
  VoxelCorner offset_;
};

// The whole number that a coefficient is meant to be.
std::optional<int64_t> whole_number(double value, double tolerance) {
  constexpr double most = 1e9;
  const double whole = std::round(value);
  if (!(std::abs(value) <= most) || std::abs(value - whole) > tolerance) return std::nullopt;
  return static_cast<int64_t>(whole);
}

template <class T>
class GridSource final : public program::FieldSource {
 public:
  GridSource(std::string name, Hash content, VoxelCorner count, std::vector<T> values)
      : name_(std::move(name)),
        content_(content),
        grid_(std::make_shared<Grid<T>>(Grid<T>{count, std::move(values)})),
        blocks_(std::make_shared<ValueBlocks>(
            count, [&](int64_t i, int64_t j, int64_t k) { return Interval(grid_->at(i, j, k)); })) {}

  std::string name() const override { return name_; }
  Hash content() const override { return content_; }
  Box bounds() const override {
    const auto& [nx, ny, nz] = grid_->count;
    return {{-0.5, -0.5, -0.5},
            {static_cast<double>(nx) - 0.5, static_cast<double>(ny) - 0.5, static_cast<double>(nz) - 0.5}};
  }
  int channel(std::string_view channel_name) const override {
    return channel_name == "value" ? value_channel : channel_name == "nearest" ? nearest_channel : -1;
  }
  const ValueBlocks& blocks() const { return *blocks_; }
  size_t bytes() const { return grid_->values.size() * sizeof(T) + blocks_->bytes(); }

  double sample(int channel, Vec3 p) const override {
    if (std::isnan(p.x + p.y + p.z)) return std::numeric_limits<double>::quiet_NaN();
    if (channel == value_channel) return interpolated(*grid_, p);
    return grid_->at(nearest_to(p.x, grid_->count[0]), nearest_to(p.y, grid_->count[1]),
                     nearest_to(p.z, grid_->count[2]));
  }

  Interval range(int channel, const Box& box) const override {
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

  std::unique_ptr<program::RowSampler> rows(int, const Affine& source_from_index) const override {
    constexpr double step_tolerance = 1e-8, offset_tolerance = 1e-4;
    if (!has_exact_floats()) return nullptr;
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
  bool has_exact_floats() const {
    if constexpr (std::is_same_v<T, double>) return false;
    if constexpr (std::is_same_v<T, float> || sizeof(T) <= 2) return true;
    constexpr double most = 0x1p24;
    return blocks_->whole().lo >= -most && blocks_->whole().hi <= most;
  }

  std::string name_;
  Hash content_;
  std::shared_ptr<const Grid<T>> grid_;
  std::shared_ptr<const ValueBlocks> blocks_;
};

// A value reaches as far as the next voxel's centre, of the nearest voxel half as far.
Box places_with(const ValueBlocks& blocks, const Box& grid, int channel, Interval values) {
  const double reach = channel == value_channel ? 1 : 0.5, block = static_cast<double>(ValueBlocks::edge - 1);
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
      [&]<class T>(std::vector<T>& values) {
        const auto source =
            std::make_shared<const GridSource<T>>(std::move(name), content, volume.count, std::move(values));
        const auto places = [source](int channel, Interval wanted) {
          return places_with(source->blocks(), source->bounds(), channel, wanted);
        };
        return VolumeSource{source, source->blocks().whole(), places, source->bytes()};
      },
      volume.values);
}

}  // namespace ombre::importing
