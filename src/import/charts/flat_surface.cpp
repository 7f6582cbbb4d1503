// Loads the module that lays out surfaces on first use.
#include "import/charts/flat_surface.h"

#include <algorithm>
#include <cmath>

#include "base/system/module_loader.h"
#include "base/text/error.h"

namespace ombre::importing {
namespace {

constexpr Module flat_by_cgal{"ombre_flat_surfaces", "CGAL",         "maps of cells on meshes",
                              "libcgal-dev",         "OMBRE_SOLIDS", "use a face of a CAD file, or cylinder_cells"};

// Solvers round differently on different processors and versions of the library; places are rounded to this share of
// the surface's size, so that results agree.
constexpr double rounding = 0x1p-30;

}  // namespace

std::vector<Vec2> flatten(const std::vector<Vec3>& points, const std::vector<std::array<uint32_t, 3>>& triangles,
                          Flattening method) {
  static const auto lay_out = load_function<decltype(ombre_flatten)>(flat_by_cgal, "ombre_flatten");
  std::vector<Vec2> places;
  lay_out(points, triangles, method, places);
  double size = 0;
  for (const Vec2 place : places) size = std::max({size, std::abs(place.x), std::abs(place.y)});
  if (!(size > 0) || !std::isfinite(size))
    throw Error(Code::file_content, "the surface cannot be laid out in a plane: its triangles are too thin");
  const double step = std::ldexp(1, std::ilogb(size) + 1) * rounding;
  for (Vec2& place : places) place = {std::round(place.x / step) * step, std::round(place.y / step) * step};
  return places;
}

bool has_flattening() { return has_module(flat_by_cgal); }

}  // namespace ombre::importing
