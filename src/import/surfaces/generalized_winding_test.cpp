#include "import/surfaces/generalized_winding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "import/surfaces/generalized_rows.h"
#include "import/surfaces/test_meshes.h"

namespace ombre::importing {
namespace {

using namespace test;

// Returns the mesh without the triangles that lie wholly above a height.
Mesh cut_off(Mesh mesh, double above) {
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](uint32_t corner) { return mesh.vertices[corner].z > above; });
  });
  return mesh;
}

Mesh without_triangles(Mesh mesh, std::mt19937& random, double share) {
  std::bernoulli_distribution goes(share);
  std::erase_if(mesh.triangles, [&](const auto&) { return goes(random); });
  return mesh;
}

std::vector<Mesh> open_meshes() {
  std::mt19937 random(11);
  Mesh box = cuboid({-1, -2, -3}, {1, 2, 3});
  box.triangles.resize(10);
  Mesh flipped = sphere(3, 2);
  std::swap(flipped.triangles[5][0], flipped.triangles[5][1]);
  const Mesh two =
      together(cut_off(sphere(3, 3), 1), moved(cut_off(sphere(2, 3), 1), Affine::translation({2, 1, 0.5})));
  return {box,
          flipped,
          two,
          cut_off(sphere(3, 3), 1.5),
          cut_off(sphere(3, 4), -2),
          without_triangles(torus(3, 1, 20, 10), random, 0.1),
          without_triangles(torus(3, 1, 20, 10), random, 0.5),
          apart(sphere(3, 2), random, 1e-4),
          apart(cut_off(sphere(3, 3), 1), random, 1e-2),
          Mesh{}};
}

// Computes the winding number by its definition, as the sum of all triangles' solid angles (van Oosterom and Strackee
// 1983).
double winding_by_definition(const Mesh& mesh, Vec3 p) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

TEST(GeneralizedWinding, CapsCloseWhatIsOpen) {
  for (const Mesh& mesh : open_meshes()) {
    const CappedSurface capped = close_by_caps(*surface_of(mesh));
    std::vector<std::array<uint32_t, 2>> forth, back;
    for (const auto& t : capped.closed->triangles)
      for (size_t i = 0; i < 3; ++i) {
        forth.push_back({t[i], t[(i + 1) % 3]});
        back.push_back({t[(i + 1) % 3], t[i]});
      }
    std::sort(forth.begin(), forth.end());
    std::sort(back.begin(), back.end());
    EXPECT_EQ(forth, back);
  }
  EXPECT_TRUE(close_by_caps(*surface_of(torus(3, 1, 20, 10))).caps.empty());
}

TEST(GeneralizedWinding, ContainsWhatFillsMoreThanHalfOfTheView) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> coordinate(-4.5, 4.5);
  for (const Mesh& mesh : open_meshes()) {
    const GeneralizedWinding winding(*surface_of(mesh));
    const Box box = bounds(*surface_of(mesh));
    size_t inside = 0;
    for (int n = 0; n < 1000; ++n) {
      const Vec3 p{coordinate(random), coordinate(random), coordinate(random)};
      const double turns = std::abs(winding_by_definition(mesh, p));
      if (std::abs(turns - 0.5) < 0.01) continue;  // inside a crack or almost on the border
      ASSERT_EQ(winding.contains(p), box.contains(p) && turns > 0.5) << turns;
      inside += winding.contains(p);
    }
    EXPECT_EQ(inside > 0, !mesh.triangles.empty());
  }
}

TEST(GeneralizedWinding, RowsAgreeWithPoints) {
  std::mt19937 random(13);
  for (const Mesh& mesh : open_meshes()) {
    const auto winding = std::make_shared<const GeneralizedWinding>(*surface_of(mesh));
    for (int n = 0; n < 4; ++n) {
      const Affine map =
          Affine::translation({-4.01, -4.02, -4.03}) *
          (n == 0 ? Affine::scaling({0.31, 0.37, 0.43}) : random_affine(random) * Affine::scaling({0.5, 0.5, 0.5}));
      const GeneralizedRows rows(winding, map);
      std::vector<std::vector<program::Span>> spans;
      for (int64_t k = 0; k < 24; k += 3) {
        rows.layer(k, 0, 24, 24, spans);
        for (int64_t j = 0; j < 24; ++j)
          for (int64_t i = 0; i < 24; ++i) {
            const bool found = std::any_of(spans[size_t(j)].begin(), spans[size_t(j)].end(),
                                           [&](const program::Span& s) { return s.begin <= i && i < s.end; });
            const Vec3 p = map({double(i), double(j), double(k)});
            ASSERT_EQ(found, winding->contains(p)) << i << " " << j << " " << k;
          }
      }
    }
  }
}

// From the plane of its rim, a hemisphere has half of the solid angle, so that plane is the border.
TEST(GeneralizedWinding, APlaneClosesABowl) {
  Mesh mesh = sphere(3, 4);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](uint32_t corner) { return mesh.vertices[corner].z > 1e-9; });
  });
  const GeneralizedWinding winding(*surface_of(mesh));
  for (const double x : {0.0, 1.0, 2.5}) {
    EXPECT_TRUE(winding.contains({x, 0.2, -1e-6}));
    EXPECT_FALSE(winding.contains({x, 0.2, 0}));
    EXPECT_FALSE(winding.contains({x, 0.2, 1e-6}));
  }
}

}  // namespace
}  // namespace ombre::importing
