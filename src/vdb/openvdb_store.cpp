// The module for sparse grids of OpenVDB.
#ifdef OMBRE_OPENVDB

#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <cmath>
#include <variant>

#include "base/text/error.h"
#include "vdb/grid_files.h"
#include "vdb/grid_store.h"

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
  // Only grids with cubic voxels are marked as level sets.
  return grid_class == GridClass::level_set && is_cubic ? openvdb::GRID_LEVEL_SET : openvdb::GRID_UNKNOWN;
}

// A voxel: its value, and whether it is active.
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

// Calls f, and converts exceptions of the library to Error.
template <class F>
auto guarded(const std::string& what, F f) {
  try {
    return f();
  } catch (const std::bad_alloc&) {
    throw Error(Code::memory, what + ": not enough memory; choose larger voxels with " + spelled::option("--voxel") +
                                  ", or a part with " + spelled::option("--box"));
  } catch (const std::exception& error) {
    throw Error(Code::cannot_write, what + ": " + error.what());
  }
}

class OpenVdbStore : public GridStore {
 public:
  OpenVdbStore(Vec3 spacing, Vec3 origin) : spacing_(spacing), origin_(origin) { openvdb::initialize(); }

  size_t add(const std::string& name, GridClass grid_class, float background, const Notes& notes) override {
    Member member;
    member.grid_class = grid_class;
    if (grid_class == GridClass::labels)
      member.grid = Int32Grid::create(static_cast<int32_t>(background));
    else
      member.grid = FloatGrid::create(background);
    const openvdb::GridBase::Ptr base = member.base();
    base->setName(name);
    base->setTransform(placed(spacing_, origin_));
    base->setGridClass(class_of(grid_class, spacing_.x == spacing_.y && spacing_.y == spacing_.z));
    for (const auto& [key, value] : notes) base->insertMeta(key, openvdb::StringMetadata(value));
    members_.push_back(std::move(member));
    return members_.size() - 1;
  }

  void fill(size_t grid, const IndexBox& box, float value) override {
    with(grid, [&](auto filling) { filling.fill(box, value); });
  }

  void set(size_t grid, const IndexBox& box, const float* values) override {
    with(grid, [&](auto filling) { filling.set(box, values); });
  }

  void write(const std::string& path, FileFormat format) override {
    guarded("cannot write " + path, [&] {
      openvdb::GridPtrVec grids;
      for (const Member& member : members_) {
        std::visit([](const auto& grid) { openvdb::tools::prune(grid->tree()); }, member.grid);
        grids.push_back(member.base());
      }
      if (format == FileFormat::vdb)
        write_vdb(path, grids);
      else
        write_nvdb(path, grids);
    });
  }

 private:
  struct Member {
    GridClass grid_class = GridClass::fog;
    std::variant<FloatGrid::Ptr, Int32Grid::Ptr> grid;
    openvdb::GridBase::Ptr base() const {
      return std::visit([](const auto& g) -> openvdb::GridBase::Ptr { return g; }, grid);
    }
  };

  template <class F>
  void with(size_t number, F f) {
    const Member& member = members_[number];
    guarded("the sparse grid cannot be made",
            [&] { std::visit([&](const auto& grid) { f(Filling(*grid, member.grid_class)); }, member.grid); });
  }

  Vec3 spacing_, origin_;
  std::vector<Member> members_;
};

}  // namespace
}  // namespace ombre::vdb

ombre::vdb::GridStore* ombre_make_grid_store(const ombre::Vec3* spacing, const ombre::Vec3* origin) {
  return new ombre::vdb::OpenVdbStore(*spacing, *origin);
}

#endif
