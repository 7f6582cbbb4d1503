#include "base/math/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ombre {
namespace {

using Voxels = std::vector<MaterialId>;

// Returns stretches of random materials and lengths.
Voxels random_row(uint32_t width, uint32_t materials, uint32_t longest, std::mt19937& random) {
  Voxels row;
  while (row.size() < width) {
    const auto length = std::min<size_t>(width - row.size(), 1 + random() % longest);
    row.insert(row.end(), length, static_cast<MaterialId>(random() % materials));
  }
  return row;
}

Voxels unpack(const RunLayer& layer) {
  Voxels all(size_t{layer.width()} * layer.height());
  for (uint32_t j = 0; j < layer.height(); ++j) layer.row(j).unpack(all.data() + size_t{j} * layer.width());
  return all;
}

// Appends the row in pieces of random size. Pieces of one material are appended by either function.
void append_in_pieces(RunLayer& layer, const Voxels& row, std::mt19937& random) {
  for (size_t begin = 0; begin < row.size();) {
    const auto count = static_cast<uint32_t>(std::min<size_t>(row.size() - begin, random() % 50));
    const MaterialId* const piece = row.data() + begin;
    const bool uniform = std::all_of(piece, piece + count, [&](MaterialId id) { return id == *piece; });
    if (uniform && random() % 2)
      layer.add_uniform(*piece, count);
    else
      layer.add(piece, count);
    begin += count;
  }
  layer.end_row();
}

class RunLayers : public testing::TestWithParam<std::pair<uint32_t, uint32_t>> {  // width, longest stretch
 protected:
  uint32_t width() const { return GetParam().first; }
  uint32_t longest() const { return GetParam().second; }
};

}  // namespace

TEST_P(RunLayers, KeepEveryVoxelHoweverAppended) {
  std::mt19937 random(width() + longest());
  RunLayer whole(width()), pieces(width());
  Voxels all;
  for (int j = 0; j < 40; ++j) {
    const Voxels row = random_row(width(), 3, longest(), random);
    all.insert(all.end(), row.begin(), row.end());
    whole.append_row(row.data());
    append_in_pieces(pieces, row, random);
  }
  EXPECT_EQ(whole.height(), 40U);
  EXPECT_EQ(unpack(whole), all);
  EXPECT_EQ(pieces, whole);
}

TEST_P(RunLayers, AreRunsExactlyWhereAStretchIsLongEnough) {
  std::mt19937 random(width() * 7 + longest());
  const Voxels row = random_row(width(), 2, longest(), random);
  RunLayer layer(width());
  layer.append_row(row.data());

  // Compares voxel by voxel.
  std::vector<ombre::Run> expected;
  for (size_t begin = 0; begin < row.size();) {
    const auto end = std::find_if(row.begin() + static_cast<std::ptrdiff_t>(begin), row.end(),
                                  [&](MaterialId id) { return id != row[begin]; });
    const auto length = static_cast<uint32_t>(end - row.begin()) - static_cast<uint32_t>(begin);
    if (length >= RunLayer::shortest_run)
      expected.push_back({row[begin], false, length});
    else if (!expected.empty() && expected.back().is_dense)
      expected.back().length += length;
    else
      expected.push_back({0, true, length});
    begin += length;
  }
  const RowView view = layer.row(0);
  EXPECT_EQ(std::vector<ombre::Run>(view.runs.begin(), view.runs.end()), expected);
}

TEST_P(RunLayers, CountTheirMaterials) {
  std::mt19937 random(width() * 3 + longest());
  RunLayer layer(width());
  std::array<uint64_t, 256> expected{};
  // Successive rows have different numbers of materials.
  for (const uint32_t materials : {1U, 2U, 3U, 6U, 7U, 8U, 256U, 2U}) {
    const Voxels row = random_row(width(), materials, longest(), random);
    for (const MaterialId id : row) ++expected[id];
    layer.append_row(row.data());
    std::array<int, 256> found{};
    find_materials(layer, [&](MaterialId id) { return ++found[id] > 0; });
    for (size_t id = 0; id < found.size(); ++id) ASSERT_EQ(found[id], expected[id] > 0) << id;
    int calls = 0;
    find_materials(layer, [&](MaterialId) { return ++calls < 2; });
    ASSERT_EQ(calls, std::min<ptrdiff_t>(2, std::ranges::count(found, 1)));
  }
  EXPECT_EQ(count_materials(layer), expected);
}

INSTANTIATE_TEST_SUITE_P(Widths, RunLayers,
                         testing::Values(std::pair{1U, 1U}, std::pair{31U, 40U}, std::pair{32U, 40U},
                                         std::pair{33U, 60U}, std::pair{500U, 2U}, std::pair{500U, 33U},
                                         std::pair{500U, 64U}, std::pair{1000U, 300U}, std::pair{4097U, 5000U}));

TEST(RunLayers, RowsAreEqualWhereTheirVoxelsAre) {
  RunLayer layer(100);
  Voxels row(100, 5);
  layer.append_row(row.data());
  layer.append_uniform_row(5);
  row[40] = 6;
  layer.append_row(row.data());
  layer.append_row(row.data());
  EXPECT_EQ(layer.row(0), layer.row(1));
  EXPECT_FALSE(layer.row(1) == layer.row(2));
  EXPECT_EQ(layer.row(2), layer.row(3));
}

}  // namespace ombre
