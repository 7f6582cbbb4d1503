#include "jobs/quick/quick_checks.h"

#include "base/text/text.h"

namespace ombre::jobs {
namespace {

// Patterns get finer than any voxel where they run into a point, such as angles on their axis.
constexpr double ignored_share = 0.01;

std::string place(const Vec3& p) {
  return '(' + format_rounded(p.x) + ", " + format_rounded(p.y) + ", " + format_rounded(p.z) + ") mm";
}

}  // namespace

void warn_of_short_periods(const Events& events, const compile::ShortPeriods& found, const voxel::Lattice& lattice) {
  if (static_cast<double>(found.found) <= ignored_share * static_cast<double>(found.places)) return;
  const std::string axis(1, "xyz"[found.axis]);
  events.warn("formulas repeat faster than voxels show, at " + format_count(found.found) + " of " +
              format_count(found.places) + " places inside: at " + place(found.first_mm) + " every " +
              format_rounded(found.period_mm) + " mm along " + axis + ", where two voxels are " +
              format_rounded(2 * lattice.voxel_mm()[found.axis]) +
              " mm; the layers show another pattern. Choose longer periods or smaller voxels");
}

void warn_of_neighbours(const Events& events, const voxel::Printer& printer,
                        const std::map<std::string, MaterialId>& materials, const voxel::Lattice& lattice,
                        const compile::BoxOfVoxels& voxels, const StopFlag* stop) {
  for (const voxel::ForbiddenNeighbour& rule : printer.forbidden_neighbours) {
    const auto material = materials.find(rule.material), near = materials.find(rule.near);
    const bool is_surface = near == materials.end() && rule.near == "surface";
    if (material == materials.end() || (near == materials.end() && !is_surface)) continue;
    const auto found = compile::find_near_materials(
        voxels, lattice, {material->second, is_surface ? MaterialId{0} : near->second, rule.within_mm}, stop);
    if (found.found == 0) continue;
    events.warn(rule.material + " lies nearer than " + format_rounded(rule.within_mm) + " mm to " +
                (is_surface ? "the surface" : rule.near) + ", which " + printer.title + " does not allow, in " +
                format_count(found.found) + " of " + format_count(found.voxels) + " voxels of a sample, the first at " +
                place(found.first_mm) + "; ombre check looks at all of them");
  }
}

}  // namespace ombre::jobs
