// Tests that read every kind of grid that OpenVDB writes.
#include "vdb/dense_grid.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/text/error.h"

#ifdef OMBRE_OPENVDB
#include <openvdb/openvdb.h>
#endif

namespace ombre::vdb {

#ifdef OMBRE_OPENVDB

namespace {

openvdb::GridBase::Ptr empty_of(const std::string& type, const std::string& name) {
  const openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(type);
  grid->setName(name);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  return grid;
}

// Returns a grid in which voxels (2, 3, 4) and (3, 3, 4) have these values. The library makes it: a constructor here
// would compile the whole tree again, which takes 10 s for each kind of value.
template <class Grid>
openvdb::GridBase::Ptr pair_of(const std::string& name, const typename Grid::ValueType& a,
                               const typename Grid::ValueType& b) {
  const openvdb::GridBase::Ptr grid = empty_of(Grid::gridType(), name);
  auto& root = static_cast<Grid&>(*grid).tree().root();
  root.setValueOn({2, 3, 4}, a);
  root.setValueOn({3, 3, 4}, b);
  return grid;
}

// Returns the values of these two voxels in the dense grid.
std::array<float, 2> pair_in(const std::string& path, const std::string& name, int channel = -1) {
  const DenseGrid grid = read_grid(path, name, channel, nullptr);
  EXPECT_EQ(grid.count, (std::array<int64_t, 3>{4, 3, 3}));
  EXPECT_EQ(grid.space_from_index({1, 1, 1}), (Vec3{1, 1.5, 2}));
  return {grid.values[(3 + 1) * 4 + 1], grid.values[(3 + 1) * 4 + 2]};
}

}  // namespace

TEST(DenseGrid, NumbersFlagsAndVectorsAreRead) {
  openvdb::initialize();
  const std::string path = testing::TempDir() + std::to_string(getpid()) + "_kinds.vdb";
  using namespace openvdb;
  io::File(path).write(
      GridPtrVec{pair_of<FloatGrid>("float", 1.5f, -2), pair_of<DoubleGrid>("double", 0.25, 8),
                 pair_of<Int32Grid>("int32", 7, -9), pair_of<BoolGrid>("bool", true, false),
                 pair_of<Vec3SGrid>("vec3s", {3, 4, 0}, {0, -2, 1}), pair_of<Vec3DGrid>("vec3d", {1, 2, 2}, {0, 0, -5}),
                 pair_of<Vec3IGrid>("vec3i", {6, 0, 8}, {1, 2, 3}), empty_of("Tree_ptdataidx32_5_4_3", "points")});
  using Pair = std::array<float, 2>;
  EXPECT_EQ(pair_in(path, "float"), (Pair{1.5f, -2}));
  EXPECT_EQ(pair_in(path, "double"), (Pair{0.25f, 8}));
  EXPECT_EQ(pair_in(path, "int32"), (Pair{7, -9}));
  EXPECT_EQ(pair_in(path, "bool"), (Pair{1, 0}));
  EXPECT_EQ(pair_in(path, "vec3s"), (Pair{5, std::sqrt(5.0f)}));
  EXPECT_EQ(pair_in(path, "vec3s", 1), (Pair{4, -2}));
  EXPECT_EQ(pair_in(path, "vec3d", 2), (Pair{2, -5}));
  EXPECT_EQ(pair_in(path, "vec3i"), (Pair{10, std::sqrt(14.0f)}));
  for (const auto& [name, channel] : {std::pair("points", -1), std::pair("vec3s", 3), std::pair("float", 1)})
    EXPECT_THROW(read_grid(path, name, channel, nullptr), Error) << name;
  std::remove(path.c_str());
}

#endif

}  // namespace ombre::vdb
