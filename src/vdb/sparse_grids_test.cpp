// Tests of grids that OpenVDB and NanoVDB read back.
#include "vdb/sparse_grids.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/text/error.h"
#include "base/text/test_errors.h"

#ifdef OMBRE_OPENVDB
#include <nanovdb/util/IO.h>
#include <openvdb/openvdb.h>
#endif

namespace ombre::vdb {
namespace {

#ifdef OMBRE_OPENVDB

constexpr Vec3 spacing{0.25, 0.25, 0.25}, origin{-3.875, -3.875, 1.125};
constexpr float band = 0.75;

std::string temporary(const std::string& name) { return testing::TempDir() + std::to_string(getpid()) + "_" + name; }

std::string bytes_of(const std::string& path) {
  std::stringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

float distance(int64_t i, int64_t j, int64_t k) {
  const double x = origin.x + 0.25 * static_cast<double>(i), y = origin.y + 0.25 * static_cast<double>(j),
               z = origin.z + 0.25 * static_cast<double>(k);
  return static_cast<float>(std::clamp(std::hypot(x, y, z - 5) - 3, -0.75, 0.75));
}

// Returns a ball of radius 3 about (0, 0, 5) in tiles of this size, and a fog in half of it.
SparseGrids ball(int64_t tile) {
  SparseGrids grids(spacing, origin);
  const size_t far = grids.add("distance", GridClass::level_set, band, {{"unit", "mm"}});
  const size_t fog = grids.add("red", GridClass::fog, 0, {});
  const size_t ids = grids.add("material", GridClass::labels, 0, {});
  for (int64_t k = 0; k < 32; k += tile)
    for (int64_t j = 0; j < 32; j += tile)
      for (int64_t i = 0; i < 32; i += tile) {
        std::vector<float> values;
        for (int64_t n = 0; n < tile * tile * tile; ++n)
          values.push_back(distance(i + n % tile, j + n / tile % tile, k + n / tile / tile));
        const IndexBox box{{i, j, k}, {i + tile, j + tile, k + tile}};
        if (std::all_of(values.begin(), values.end(), [&](float v) { return v == values[0]; }))
          grids.fill(far, box, values[0]);
        else
          grids.set(far, box, values.data());
        if (i < 16) grids.fill(fog, box, 0.5f);
        if (j >= 16) grids.fill(ids, box, 7);
      }
  return grids;
}

template <class Grid = openvdb::FloatGrid>
typename Grid::Ptr read_vdb(const std::string& path, const std::string& name) {
  openvdb::io::File file(path);
  file.open(false);
  return openvdb::gridPtrCast<Grid>(file.readGrid(name));
}

#endif

}  // namespace

#ifdef OMBRE_OPENVDB

TEST(SparseGrids, OpenVdbReadsThemBack) {
  const std::string path = temporary("ball.vdb");
  ball(8).write(path, FileFormat::vdb);
  const auto far = read_vdb(path, "distance");
  EXPECT_EQ(far->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_EQ(far->background(), band);
  EXPECT_EQ(far->metaValue<std::string>("unit"), "mm");
  EXPECT_EQ(far->indexToWorld(openvdb::Coord(0, 0, 0)), openvdb::Vec3d(origin.x, origin.y, origin.z));
  EXPECT_EQ(far->voxelSize(), openvdb::Vec3d(0.25, 0.25, 0.25));
  const auto values = far->getConstAccessor();
  for (int n = 0; n < 32 * 32 * 32; ++n) {
    const openvdb::Coord at(n % 32, n / 32 % 32, n / 1024);
    ASSERT_EQ(values.getValue(at), distance(at.x(), at.y(), at.z()));
    ASSERT_EQ(values.isValueOn(at), std::abs(values.getValue(at)) < band);
  }
  EXPECT_EQ(values.getValue(openvdb::Coord(-5, 0, 0)), band);

  const auto fog = read_vdb(path, "red");
  EXPECT_EQ(fog->getGridClass(), openvdb::GRID_FOG_VOLUME);
  EXPECT_EQ(fog->activeVoxelCount(), 16u * 32 * 32);
  EXPECT_EQ(fog->tree().leafCount(), 0u);  // tiles of at least 8 voxels, no separate voxel
  const auto ids = read_vdb<openvdb::Int32Grid>(path, "material");
  EXPECT_EQ(ids->getConstAccessor().getValue(openvdb::Coord(3, 20, 9)), 7);
  EXPECT_EQ(ids->activeVoxelCount(), 16u * 32 * 32);
  std::remove(path.c_str());
}

TEST(SparseGrids, NanoVdbReadsThemBack) {
  const std::string path = temporary("ball.nvdb");
  ball(8).write(path, FileFormat::nvdb);
  const auto handles = nanovdb::io::readGrids(path);
  ASSERT_EQ(handles.size(), 3u);
  const nanovdb::NanoGrid<float>* far = handles[0].grid<float>();
  ASSERT_TRUE(far);
  EXPECT_TRUE(far->isLevelSet());
  EXPECT_EQ(std::string(far->gridName()), "distance");
  EXPECT_EQ(far->indexToWorld(nanovdb::Vec3d(0, 0, 0)), nanovdb::Vec3d(origin.x, origin.y, origin.z));
  const auto values = far->getAccessor();
  for (int n = 0; n < 32 * 32 * 32; ++n)
    ASSERT_EQ(values.getValue(nanovdb::Coord(n % 32, n / 32 % 32, n / 1024)), distance(n % 32, n / 32 % 32, n / 1024));
  EXPECT_TRUE(handles[1].grid<float>()->isFogVolume());
  EXPECT_EQ(handles[2].grid<int32_t>()->getAccessor().getValue(nanovdb::Coord(3, 20, 9)), 7);
  std::remove(path.c_str());
}

TEST(SparseGrids, EqualGridsGiveEqualBytes) {
  for (const auto format : {FileFormat::vdb, FileFormat::nvdb}) {
    const std::string path = temporary("equal.grid");
    std::vector<std::string> files;
    for (const int64_t tile : {8, 8, 4, 16}) {
      ball(tile).write(path, format);
      files.push_back(bytes_of(path));
      EXPECT_TRUE(files.back() == files.front()) << tile;
    }
    std::remove(path.c_str());
  }
}

TEST(SparseGrids, VoxelsThatAreNotCubicAreNoLevelSet) {
  SparseGrids grids({0.1, 0.1, 0.027}, {});
  grids.add("distance", GridClass::level_set, band, {});
  const std::string path = temporary("flat.vdb");
  grids.write(path, FileFormat::vdb);
  const auto far = read_vdb(path, "distance");
  EXPECT_EQ(far->getGridClass(), openvdb::GRID_UNKNOWN);
  EXPECT_EQ(far->voxelSize(), openvdb::Vec3d(0.1, 0.1, 0.027));
  std::remove(path.c_str());
}

TEST(SparseGrids, WhatIsNoNumberIsBackground) {
  SparseGrids grids(spacing, origin);
  const float values[] = {std::nanf(""), 0.5f};
  grids.set(grids.add("distance", GridClass::level_set, band, {}), {{0, 0, 0}, {2, 1, 1}}, values);
  const std::string path = temporary("nan.vdb");
  grids.write(path, FileFormat::vdb);
  const auto far = read_vdb(path, "distance");
  EXPECT_EQ(far->activeVoxelCount(), 1u);
  EXPECT_EQ(far->getConstAccessor().getValue(openvdb::Coord(0, 0, 0)), band);
  std::remove(path.c_str());
}

TEST(SparseGrids, FilesThatCannotBeWrittenAreErrors) {
  for (const auto format : {FileFormat::vdb, FileFormat::nvdb})
    for (const char* path : {"/nowhere/at/all.vdb", "/dev/full"})
      EXPECT_THROW(ball(8).write(path, format), Error) << path;
}

#else

TEST(SparseGrids, SayHowToGetThem) {
  expect_error([] { SparseGrids({1, 1, 1}, {}); }, "libopenvdb-dev");
}

#endif

}  // namespace ombre::vdb
