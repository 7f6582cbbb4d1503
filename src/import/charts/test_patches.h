// Patches of surfaces whose coordinates are known.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "import/charts/shell.h"

namespace ombre::importing {

// Returns a patch of columns x rows rectangles, each cut in two, with points at the places (i/columns, j/rows).
inline SurfacePatch grid_patch(uint32_t columns, uint32_t rows, const std::function<Vec3(double, double)>& at,
                               const std::function<Vec2(double, double)>& place = {}) {
  SurfacePatch patch;
  for (uint32_t j = 0; j <= rows; ++j)
    for (uint32_t i = 0; i <= columns; ++i) {
      const double a = static_cast<double>(i) / columns, b = static_cast<double>(j) / rows;
      patch.points.push_back(at(a, b));
      if (place) patch.places.push_back(place(a, b));
    }
  const uint32_t row = columns + 1;
  for (uint32_t j = 0; j < rows; ++j)
    for (uint32_t i = 0; i < columns; ++i) {
      const uint32_t n = j * row + i;
      patch.triangles.push_back({n, n + 1, n + row + 1});
      patch.triangles.push_back({n, n + row + 1, n + row});
    }
  make_normals(patch);
  return patch;
}

// A sector of a cylinder about z, 0 to `angle` (radians), with its developed lengths as places.
inline SurfacePatch cylinder_patch(double radius, double angle, double height, uint32_t columns, uint32_t rows) {
  SurfacePatch patch = grid_patch(
      columns, rows,
      [=](double a, double b) {
        return Vec3{radius * std::cos(a * angle), radius * std::sin(a * angle), b * height};
      },
      [=](double a, double b) {
        return Vec2{a * angle * radius, b * height};
      });
  for (size_t n = 0; n < patch.points.size(); ++n)
    patch.normals[n] = {patch.points[n].x / radius, patch.points[n].y / radius, 0};
  return patch;
}

// A part of a sphere between two latitudes (radians), a quarter turn around.
inline SurfacePatch sphere_patch(double radius, double south, double north, uint32_t columns, uint32_t rows) {
  SurfacePatch patch = grid_patch(columns, rows, [=](double a, double b) {
    const double longitude = a * std::numbers::pi / 2, latitude = south + b * (north - south);
    return radius *
           Vec3{std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude)};
  });
  for (size_t n = 0; n < patch.points.size(); ++n) patch.normals[n] = (1 / radius) * patch.points[n];
  return patch;
}

inline Shell shell_above(SurfacePatch patch, Interval heights, double sign = 1) {
  Shell shell{std::move(patch), {}, heights};
  if (sign < 0)
    for (auto& [a, b, c] : shell.patch.triangles) std::swap(b, c);
  for (const Vec3& normal : shell.patch.normals) shell.ways.push_back(sign * normal);
  return shell;
}

}  // namespace ombre::importing
