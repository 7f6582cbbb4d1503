#include "import/surfaces/row_winding.h"

#include <gtest/gtest.h>

#include <map>

#include "import/surfaces/mesh_source.h"
#include "import/surfaces/solid_angle.h"
#include "import/surfaces/test_meshes.h"

namespace ombre::importing {
namespace {

using namespace test;
using program::Span;

struct Lattice {
  int64_t x, y, z;
};

// Returns one flag per voxel, x fastest.
std::vector<char> voxels(const Mesh& mesh, const Affine& source_from_index, Lattice size,
                         InsideRule rule = InsideRule::nonzero) {
  const RowWinding winding(surface_of(mesh), source_from_index, rule);
  std::vector<char> inside(size.x * size.y * size.z, 0);
  std::vector<std::vector<Span>> rows;
  for (int64_t k = 0; k < size.z; ++k) {
    winding.layer(k, 0, size.y, size.x, rows);
    for (int64_t j = 0; j < size.y; ++j) {
      int64_t end = -1;
      for (const Span& span : rows[j]) {
        EXPECT_LT(end, span.begin);
        EXPECT_LT(span.begin, span.end);
        EXPECT_LE(span.end, size.x);
        end = span.end;
        for (int64_t i = span.begin; i < span.end; ++i) inside[(k * size.y + j) * size.x + i] = 1;
      }
    }
  }
  return inside;
}

int64_t count(const std::vector<char>& inside) { return std::count(inside.begin(), inside.end(), char{1}); }

TEST(RowWinding, CubeHasTheAnalyticCount) {
  const Mesh cube = cuboid({0.5, 1.25, 2.75}, {7.25, 9.5, 6.1});
  EXPECT_EQ(count(voxels(cube, {}, {12, 12, 12})), 7 * 8 * 4);
  EXPECT_EQ(count(voxels(turned_inward(cube), {}, {12, 12, 12})), 7 * 8 * 4);
}

TEST(RowWinding, RowsAreClippedToTheLattice) {
  const Mesh cube = cuboid({-5.5, -5.5, -5.5}, {50.5, 50.5, 50.5});
  EXPECT_EQ(count(voxels(cube, {}, {12, 10, 9})), 12 * 10 * 9);
  const RowWinding winding(surface_of(cube), {}, InsideRule::nonzero);
  std::vector<std::vector<Span>> rows{{{1, 2}}, {{3, 4}}, {{5, 6}}};
  winding.layer(3, 40, 60, 20, rows);
  ASSERT_EQ(rows.size(), 20u);
  EXPECT_EQ(rows[10], (std::vector<Span>{{0, 20}}));
  EXPECT_TRUE(rows[11].empty());
  winding.layer(-6, 0, 10, 20, rows);
  for (const auto& row : rows) EXPECT_TRUE(row.empty());
}

TEST(RowWinding, CubesThatShareAFaceOnVoxelCentresShareTheVoxelsOut) {
  const Lattice size{12, 12, 12};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 middle_lo{1, 1, 1}, middle_hi{9, 9, 9};
    middle_lo[axis] = middle_hi[axis] = 5;
    const auto a = voxels(cuboid({1, 1, 1}, middle_hi), {}, size);
    const auto b = voxels(cuboid(middle_lo, {9, 9, 9}), {}, size);
    const auto both = voxels(cuboid({1, 1, 1}, {9, 9, 9}), {}, size);
    for (size_t i = 0; i < both.size(); ++i) ASSERT_EQ(a[i] + b[i], both[i]);
    EXPECT_EQ(count(both), 8 * 8 * 8);
  }
}

TEST(RowWinding, TetrahedraThatFillACubeShareItOut) {
  // Kuhn's six tetrahedra meet in the cube's diagonals, which pass through voxel centres.
  const Lattice size{12, 12, 12};
  const Affine map = Affine::scaling({0.1, 0.1, 0.1});
  std::vector<char> sum(size.x * size.y * size.z, 0);
  std::array<int, 3> order{0, 1, 2};
  do {
    Mesh tetrahedron;
    Vec3 corner{};
    tetrahedron.vertices.push_back(corner);
    for (const int axis : order) {
      corner[axis] = 1;
      tetrahedron.vertices.push_back(corner);
    }
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    ASSERT_TRUE(inspect(tetrahedron).is_closed());
    const auto inside = voxels(tetrahedron, map, size);
    for (size_t i = 0; i < sum.size(); ++i) sum[i] = static_cast<char>(sum[i] + inside[i]);
  } while (std::next_permutation(order.begin(), order.end()));
  const auto cube = voxels(cuboid({0, 0, 0}, {1, 1, 1}), map, size);
  EXPECT_EQ(sum, cube);
  EXPECT_EQ(count(cube), 1000);
}

TEST(RowWinding, VolumesConverge) {
  for (const Mesh& mesh : {sphere(10, 3), torus(7, 2.5, 40, 24)}) {
    const double volume = inspect(mesh).volume;
    double error = 0;
    for (const double pitch : {0.8, 0.4, 0.2, 0.1}) {
      const auto side = static_cast<int64_t>(22 / pitch);
      const Affine map = Affine::translation({-10.9, -10.93, -10.97}) * Affine::scaling({pitch, pitch, pitch});
      const double voxel_volume =
          static_cast<double>(count(voxels(mesh, map, {side, side, side}))) * pitch * pitch * pitch;
      error = std::abs(voxel_volume - volume) / volume;
      EXPECT_LT(error, 0.02 * pitch) << pitch;
    }
    EXPECT_LT(error, 5e-4);
  }
}

TEST(RowWinding, InwardShellsAreCavities) {
  const Mesh mesh =
      together(cuboid({0.5, 0.5, 0.5}, {9.5, 9.5, 9.5}), turned_inward(cuboid({3.5, 3.5, 3.5}, {6.5, 6.5, 6.5})));
  EXPECT_EQ(count(voxels(mesh, {}, {12, 12, 12})), 9 * 9 * 9 - 3 * 3 * 3);
}

TEST(RowWinding, ShellsThatOverlapUniteUnlessParityIsRequested) {
  const Mesh mesh = together(cuboid({0.5, 0.5, 0.5}, {6.5, 6.5, 6.5}), cuboid({3.5, 3.5, 3.5}, {9.5, 9.5, 9.5}));
  const int64_t one = 216, shared = 27;
  EXPECT_EQ(count(voxels(mesh, {}, {12, 12, 12})), 2 * one - shared);
  EXPECT_EQ(count(voxels(mesh, {}, {12, 12, 12}, InsideRule::parity)), 2 * one - 2 * shared);
}

TEST(RowWinding, AnyAffineMapAgreesWithSamples) {
  std::mt19937 random(1);
  const Lattice size{30, 30, 30};
  for (int turn = 0; turn < 20; ++turn) {
    Affine map = random_affine(random) * Affine::translation({-15, -15, -15});
    if (turn % 2 == 1) map = map * Affine::scaling({-1, 1, 1}) * Affine::translation({-30, 0, 0});
    const Mesh mesh = turn % 3 == 0 ? cuboid({-5, -6, -7}, {6, 5, 4}) : torus(5, 2, 24, 12);
    const auto source = make_mesh_source("m", mesh, {});
    const auto inside = voxels(mesh, map, size);
    for (int64_t k = 0; k < size.z; ++k)
      for (int64_t j = 0; j < size.y; ++j)
        for (int64_t i = 0; i < size.x; ++i) {
          const Vec3 p = map({double(i), double(j), double(k)});
          const double expected = source->sample(0, p);
          if (inside[(k * size.y + j) * size.x + i] == (expected == 1)) continue;
          ASSERT_LT(std::abs(source->sample(1, p)), 1e-9) << turn;
        }
  }
}

// Rays from an eye, some of which begin inside of the mesh, agree with its samples at each of their points.
TEST(RowWinding, RaysAgreeWithSamples) {
  std::mt19937 random(5);
  const Lattice size{60, 20, 20};
  size_t inside_at_all = 0;
  for (int turn = 0; turn < 20; ++turn) {
    const Affine map = random_affine(random);
    const double eye = turn % 2 == 0 ? 20 : 4;
    const program::RayLattice rays{eye, {-0.95 * eye, -5.1, -4.9}, {0.4, 0.5, 0.5}};
    const Mesh mesh = turn % 3 == 0 ? cuboid({-5, -6, -7}, {6, 5, 4}) : torus(5, 2, 24, 12);
    const auto source = make_mesh_source("m", mesh, {});
    const auto sampler = source->rays(0, rays, map);
    ASSERT_TRUE(sampler);
    std::vector<std::vector<Span>> rows;
    for (int64_t k = 0; k < size.z; ++k) {
      sampler->layer(k, 0, size.y, size.x, rows);
      for (int64_t j = 0; j < size.y; ++j)
        for (int64_t i = 0; i < size.x; ++i) {
          const double depth = rays.first.x + rays.step.x * double(i), grow = (eye + depth) / eye;
          const Vec3 p = map({depth, grow * (rays.first.y + rays.step.y * double(j)),
                              grow * (rays.first.z + rays.step.z * double(k))});
          const bool found =
              std::any_of(rows[j].begin(), rows[j].end(), [&](Span s) { return s.begin <= i && i < s.end; });
          inside_at_all += found;
          if (found == (source->sample(0, p) == 1)) continue;
          ASSERT_LT(std::abs(source->sample(1, p)), 1e-9) << turn << ": " << i << " " << j << " " << k;
        }
    }
  }
  EXPECT_GT(inside_at_all, 1000U);
}

TEST(RowWinding, AgreesWithSamplesExactlyWhereTheMapIsTheIdentity) {
  std::mt19937 random(2);
  const Lattice size{9, 9, 9};
#ifdef OMBRE_SANITIZED
  constexpr int turns = 30;  // each takes as long as 20 elsewhere
#else
  constexpr int turns = 100;
#endif
  for (int turn = 0; turn < turns; ++turn) {
    const Mesh mesh = random_on_lattice(random, 8);
    const auto source = make_mesh_source("m", mesh, {});
    const auto inside = voxels(mesh, {}, size);
    size_t at = 0;
    for (int64_t k = 0; k < size.z; ++k)
      for (int64_t j = 0; j < size.y; ++j)
        for (int64_t i = 0; i < size.x; ++i)
          ASSERT_EQ(inside[at++], source->sample(0, {double(i), double(j), double(k)})) << turn;
  }
}

TEST(RowWinding, RowsOfClosedMeshesNeverLeak) {
  std::mt19937 random(3);
  for (int turn = 0; turn < 2000; ++turn) {
    Mesh mesh = random_on_lattice(random, turn % 7 + 2);
    ASSERT_TRUE(inspect(mesh).is_closed());
    // Half of the meshes lie exactly on the lattice, the others slightly off it.
    const Affine map = turn % 2 == 0 ? Affine{} : random_affine(random);
    const RowWinding winding(surface_of(mesh), map, InsideRule::nonzero);
    for (int64_t k = -10; k <= 10; ++k) {
      std::vector<RowWinding::Crossing> found;
      winding.find_crossings(k, -12, 12, 1000, found);
      std::map<int64_t, int64_t> sums;
      for (const auto& crossing : found) sums[crossing.row] += crossing.winding;
      for (const auto& [row, sum] : sums) ASSERT_EQ(sum, 0) << "turn " << turn << " layer " << k << " row " << row;
    }
  }
}

TEST(RowWinding, RaysOfClosedMeshesNeverLeak) {
  std::mt19937 random(6);
  for (int turn = 0; turn < 500; ++turn) {
    const Mesh mesh = random_on_lattice(random, turn % 7 + 2);
    const program::RayLattice rays{30, {-20, -12, -12}, {0.1, 1, 1}};
    const RowWinding winding(*surface_of(mesh), rays, {}, InsideRule::nonzero);
    for (int64_t k = 0; k <= 24; ++k) {
      std::vector<RowWinding::Crossing> found;
      winding.find_crossings(k, 0, 24, 1000, found);
      std::map<int64_t, int64_t> sums;
      for (const auto& crossing : found) sums[crossing.row] += crossing.winding;
      for (const auto& [row, sum] : sums) ASSERT_EQ(sum, 0) << "turn " << turn << " layer " << k << " row " << row;
    }
  }
}

TEST(RowWinding, AgreesWithSolidAnglesOffTheSurface) {
  std::mt19937 random(4);
  const Lattice size{9, 9, 9};
  for (int turn = 0; turn < 60; ++turn) {
    const Mesh mesh = random_on_lattice(random, 8);
    const SolidAngle angle(surface_of(mesh));
    const Affine map = Affine::translation({0.3717, 0.2941, 0.4389});
    const auto inside = voxels(mesh, map, size);
    size_t at = 0;
    for (int64_t k = 0; k < size.z; ++k)
      for (int64_t j = 0; j < size.y; ++j)
        for (int64_t i = 0; i < size.x; ++i)
          ASSERT_EQ(inside[at++], std::abs(angle.winding(map({double(i), double(j), double(k)}))) > 0.5) << turn;
  }
}

TEST(RowWinding, OpenMeshesAndStrangeMapsAreSafe) {
  Mesh open = cuboid({0.5, 0.5, 0.5}, {6.5, 6.5, 6.5});
  open.triangles.resize(10);  // without its face at +x
  EXPECT_EQ(count(voxels(open, {}, {12, 12, 12})), 0);
  Mesh huge = cuboid({-1e15, -1e15, -1e15}, {1e15, 1e15, 1e15});
  EXPECT_EQ(count(voxels(huge, {}, {3, 3, 3})), 27);
  EXPECT_EQ(count(voxels(huge, Affine::scaling({1e-9, 1e-9, 1e-9}), {3, 3, 3})), 0);
  const auto source = make_mesh_source("m", huge, {});
  EXPECT_EQ(source->rows(0, Affine::scaling({0, 1, 1})), nullptr);
  EXPECT_EQ(source->rows(0, Affine::scaling({std::nan(""), 1, 1})), nullptr);
  EXPECT_EQ(source->rows(1, {}), nullptr);
}

}  // namespace
}  // namespace ombre::importing
