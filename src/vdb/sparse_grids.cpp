// Sparse grids of OpenVDB.
#include "vdb/sparse_grids.h"

#include "base/error.h"

#ifndef OMBRE_OPENVDB

namespace ombre::vdb {

struct SparseGrids::Parts {};

SparseGrids::SparseGrids(Vec3, Vec3) {
  throw Error(
      "this ombre was built without OpenVDB; install libopenvdb-dev and libnanovdb-dev, configure with "
      "-DOMBRE_OPENVDB=ON and build again, or write a .nrrd file");
}
SparseGrids::~SparseGrids() = default;
SparseGrids::SparseGrids(SparseGrids&&) noexcept = default;
size_t SparseGrids::add(const std::string&, GridClass, float, const Notes&) { return 0; }
void SparseGrids::fill(size_t, const IndexBox&, float) {}
void SparseGrids::set(size_t, const IndexBox&, const float*) {}
void SparseGrids::write(const std::string&, FileFormat) {}

}  // namespace ombre::vdb

#else

#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <cmath>
#include <variant>

#include "vdb/grid_files.h"

namespace ombre::vdb {
namespace {

using openvdb::FloatGrid;
using openvdb::Int32Grid;

openvdb::Coord coord(int64_t i, int64_t j, int64_t k) {
  return {static_cast<int32_t>(i), static_cast<int32_t>(j), static_cast<int32_t>(k)};
}

openvdb::CoordBBox box_of(const IndexBox& box) {
  return {coord(box.lo[0], box.lo[1], box.lo[2]), coord(box.hi[0] - 1, box.hi[1] - 1, box.hi[2] - 1)};
}

openvdb::math::Transform::Ptr placed(Vec3 spacing, Vec3 origin) {
  const auto transform = openvdb::math::Transform::createLinearTransform();
  transform->postScale(openvdb::Vec3d(spacing.x, spacing.y, spacing.z));
  transform->postTranslate(openvdb::Vec3d(origin.x, origin.y, origin.z));
  return transform;
}

openvdb::GridClass class_of(GridClass grid_class, bool is_cubic) {
  if (grid_class == GridClass::fog) return openvdb::GRID_FOG_VOLUME;
  // Level sets have cubic voxels.
  return grid_class == GridClass::level_set && is_cubic ? openvdb::GRID_LEVEL_SET : openvdb::GRID_UNKNOWN;
}

// What a value is in a grid: a number, and whether it counts as part of the grid.
template <class T>
struct Voxel {
  T value{};
  bool is_active = false;
};

template <class Grid>
class Filling {
 public:
  using Value = typename Grid::ValueType;
  Filling(Grid& grid, GridClass grid_class)
      : grid_(grid), is_level_set_(grid_class == GridClass::level_set), background_(grid.background()) {}

  void fill(const IndexBox& box, float value) {
    const Voxel<Value> voxel = voxel_of(value);
    if (!is_background(voxel)) grid_.sparseFill(box_of(box), voxel.value, voxel.is_active);
  }

  void set(const IndexBox& box, const float* values) {
    auto voxels = grid_.getAccessor();
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j)
        for (int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
          const Voxel<Value> voxel = voxel_of(*values++);
          if (is_background(voxel)) continue;
          if (voxel.is_active)
            voxels.setValueOn(coord(i, j, k), voxel.value);
          else
            voxels.setValueOff(coord(i, j, k), voxel.value);
        }
  }

 private:
  bool is_background(const Voxel<Value>& voxel) const { return !voxel.is_active && voxel.value == background_; }

  Voxel<Value> voxel_of(float value) const {
    if (std::isnan(value)) return {background_, false};
    const auto number = static_cast<Value>(value);
    if (is_level_set_) return {number, std::abs(number) < background_};
    return {number, number != background_};
  }

  Grid& grid_;
  bool is_level_set_;
  Value background_;
};

// Calls f, and turns what the library throws into an Error.
template <class F>
auto guarded(const std::string& what, F f) {
  try {
    return f();
  } catch (const std::bad_alloc&) {
    throw Error(what + ": not enough memory; choose larger voxels with --voxel, or a part with --box");
  } catch (const std::exception& error) {
    throw Error(what + ": " + error.what());
  }
}

}  // namespace

struct SparseGrids::Parts {
  struct Member {
    GridClass grid_class = GridClass::fog;
    std::variant<FloatGrid::Ptr, Int32Grid::Ptr> grid;
    openvdb::GridBase::Ptr base() const {
      return std::visit([](const auto& g) -> openvdb::GridBase::Ptr { return g; }, grid);
    }
  };

  Vec3 spacing, origin;
  std::vector<Member> members;

  template <class F>
  void with(size_t number, F f) {
    const Member& member = members[number];
    guarded("the sparse grid cannot be made",
            [&] { std::visit([&](const auto& grid) { f(Filling(*grid, member.grid_class)); }, member.grid); });
  }
};

SparseGrids::SparseGrids(Vec3 spacing_mm, Vec3 origin_mm)
    : parts_(std::make_unique<Parts>(Parts{spacing_mm, origin_mm, {}})) {
  openvdb::initialize();
}

SparseGrids::~SparseGrids() = default;
SparseGrids::SparseGrids(SparseGrids&&) noexcept = default;

size_t SparseGrids::add(const std::string& name, GridClass grid_class, float background, const Notes& notes) {
  Parts::Member member;
  member.grid_class = grid_class;
  if (grid_class == GridClass::labels)
    member.grid = Int32Grid::create(static_cast<int32_t>(background));
  else
    member.grid = FloatGrid::create(background);
  const openvdb::GridBase::Ptr base = member.base();
  const Vec3 spacing = parts_->spacing;
  base->setName(name);
  base->setTransform(placed(spacing, parts_->origin));
  base->setGridClass(class_of(grid_class, spacing.x == spacing.y && spacing.y == spacing.z));
  for (const auto& [key, value] : notes) base->insertMeta(key, openvdb::StringMetadata(value));
  parts_->members.push_back(std::move(member));
  return parts_->members.size() - 1;
}

void SparseGrids::fill(size_t grid, const IndexBox& box, float value) {
  parts_->with(grid, [&](auto filling) { filling.fill(box, value); });
}

void SparseGrids::set(size_t grid, const IndexBox& box, const float* values) {
  parts_->with(grid, [&](auto filling) { filling.set(box, values); });
}

void SparseGrids::write(const std::string& path, FileFormat format) {
  guarded("cannot write " + path, [&] {
    openvdb::GridPtrVec grids;
    for (const Parts::Member& member : parts_->members) {
      std::visit([](const auto& grid) { openvdb::tools::prune(grid->tree()); }, member.grid);
      grids.push_back(member.base());
    }
    if (format == FileFormat::vdb)
      write_vdb(path, grids);
    else
      write_nvdb(path, grids);
  });
}

}  // namespace ombre::vdb

#endif
