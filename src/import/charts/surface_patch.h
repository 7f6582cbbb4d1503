// Patches of surfaces with coordinates on them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/math/box.h"
#include "base/math/interval.h"

namespace ombre::importing {

using Corners = std::array<uint32_t, 3>;

struct SurfacePatch {
  std::vector<Vec3> points;
  std::vector<Corners> triangles;  // counter-clockwise seen from outside
  std::vector<Vec3> normals;       // by point: outward, of length 1
  std::vector<Vec2> places;        // by point: u and v in mm
};

// The space between two copies of a patch, of which each point is moved along its own way: `heights` multiply the ways.
// The place of a point is interpolated between the corners of a triangle that holds it and whose own corners have moved
// equally far (S. Porumbescu, B. Budge, L. Feng and K. Joy, "Shell maps", ACM Transactions on Graphics 24, 2005). So
// the map is continuous, its inverse is exact, and u, v and height are that of the surface on the surface.
struct Shell {
  SurfacePatch patch;
  std::vector<Vec3> ways;  // by point
  Interval heights{0, 1};  // from the lower border to the upper one

  Vec3 at(uint32_t point, double height) const { return patch.points[point] + height * ways[point]; }
};

// Selects triangles of a surface. Conditions are combined.
struct PatchChoice {
  std::optional<Vec3> at;      // triangles that are linked to the nearest one, ...
  double angle_deg = 180;      // ... over edges where the surface bends by at most this angle
  std::optional<Box> box;      // triangles whose centres lie in the box
  std::optional<Vec3> normal;  // triangles that face this direction, ...
  double within_deg = 60;      // ... up to this angle
};

// A list of triangles that form one patch, or what is wrong.
struct ChosenPatch {
  SurfacePatch patch;  // without places
  std::string problem, hint;
};

// Returns the chosen triangles with smooth normals. They must be in one piece with an open border, without edges of
// three triangles or points where two pieces touch.
ChosenPatch choose_patch(const std::vector<Vec3>& points, const std::vector<Corners>& triangles,
                         const PatchChoice& choice);

// Sets normals to the mean of those of the triangles, weighted by their angles.
void make_normals(SurfacePatch& patch);

// Scales places so that the patch keeps its area, turns them so that u runs along a direction as far as possible, and
// moves the least u and v to 0. Returns the extents.
Vec2 align_places(SurfacePatch& patch, Vec3 toward);
// Moves the least u and v to 0. Returns the extents.
Vec2 moved_to_zero(SurfacePatch& patch);
// Returns a triangle whose places are turned over or have no area, or nothing.
std::optional<uint32_t> turned_over(const SurfacePatch& patch);

// Divides each triangle into four.
SurfacePatch divided(const SurfacePatch& patch);

// Returns by triangle the ones beyond the edges opposite to its corners, or `no_triangle`. No edge has three triangles.
inline constexpr uint32_t no_triangle = ~uint32_t{0};
std::vector<std::array<uint32_t, 3>> neighbours_of(const std::vector<Corners>& triangles);

// Returns the border's edges, each as in its triangle.
std::vector<std::array<uint32_t, 2>> border_of(const std::vector<Corners>& triangles);

// Returns a point as text for messages; rounding errors of coordinates do not show.
std::string place_text(Vec3 p);

// Removes pairs of edges at the same place, which are a seam where a patch meets itself.
void remove_seams(const std::vector<Vec3>& points, std::vector<std::array<uint32_t, 2>>& border);

}  // namespace ombre::importing
