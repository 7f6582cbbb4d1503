#include "compile/mesh_job.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "compile/build.h"
#include "compile/region_survey.h"
#include "surface/contour.h"

namespace ombre::compile {
namespace {

constexpr double sides_of_tolerance = 2000;
// Corners begin so many cells before the box; an odd part, so that faces of round coordinates do not run through them.
constexpr double margin_cells = 1.37;
constexpr MaterialId void_material = 0;
constexpr int64_t most_cells = int64_t{1} << 20;  // along an axis

// 0.0234 becomes 0.02.
double one_digit(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)));
  return std::floor(value / unit) * unit;
}

double longest(const Box& box) {
  const Vec3 size = box.size();
  return std::max({size.x, size.y, size.z});
}

voxel::Lattice corners_over(const Box& box, Pitch cell) {
  voxel::Lattice lattice;
  lattice.pitch = {cell, cell, cell};
  const double h = cell.mm(), first = margin_cells + 0.5;  // the first corner is the centre of the first voxel
  lattice.origin = box.lo - Vec3{first * h, first * h, first * h};
  for (int axis = 0; axis < 3; ++axis)
    lattice.count[static_cast<size_t>(axis)] =
        static_cast<int64_t>(std::ceil(box.size()[axis] / h + 2 * margin_cells)) + 1;
  return lattice;
}

bool set_sizes(const Box& box, const MeshRequest& request, const SourceRange& where, MeshedDesign& made,
               voxel::Lattice& corners, Diagnostics& diagnostics) {
  made.tolerance_mm = request.tolerance_mm.value_or(one_digit(longest(box) / sides_of_tolerance));
  made.cell_mm = request.cell_mm.value_or(cells_of_tolerance * made.tolerance_mm);
  const std::optional<Pitch> cell = Pitch::from_mm(made.cell_mm);
  if (!cell || longest(box) / made.cell_mm > static_cast<double>(most_cells)) {
    diagnostics.error(where, "cells of " + format_rounded(made.cell_mm, 3) + " mm are too small for a part of " +
                                 format_rounded(longest(box), 4) + " mm; choose a larger --cell or --tolerance");
    return false;
  }
  corners = corners_over(box, *cell);
  for (size_t axis = 0; axis < 3; ++axis) made.cells[axis] = corners.count[axis] - 1;
  return true;
}

std::vector<double> equal_borders(Interval range, int bands) {
  std::vector<double> borders;
  for (int n = 1; n < bands; ++n) borders.push_back(range.lo + (range.hi - range.lo) * n / bands);
  return borders;
}

// A material's fraction, an attribute, or the fraction that varies most. Names of materials go first.
std::optional<RegionRule> band_rule(const design::Design& design, const Box& box, const BandRequest& bands,
                                    Diagnostics& diagnostics) {
  RegionRule rule{RegionRule::Kind::fraction, bands.of, bands.borders};
  if (bands.of.empty()) {
    const auto most = most_varying_material(design, box, diagnostics);
    if (!most) return std::nullopt;
    rule.of = design.materials.all()[*most].name;
  } else if (!design.materials.find(bands.of)) {
    rule.kind = RegionRule::Kind::attribute;
  }
  if (!rule.borders.empty()) return rule;
  if (rule.kind == RegionRule::Kind::fraction) {
    rule.borders = equal_borders({0, 1}, bands.count);
    return rule;
  }
  const auto whole = build_region_program(design, box, rule, diagnostics);
  const auto range = whole ? score_range(whole->partition, box) : std::nullopt;
  if (range) rule.borders = equal_borders(*range, bands.count);
  return whole ? std::optional(rule) : std::nullopt;
}

std::optional<RegionRule> region_rule(const design::Design& design, const Box& box, const MeshRequest& request,
                                      Diagnostics& diagnostics) {
  if (request.bands) return band_rule(design, box, *request.bands, diagnostics);
  return RegionRule{request.by_material ? RegionRule::Kind::materials : RegionRule::Kind::whole, "", {}};
}

void add_bodies(const Loaded& loaded, const RegionProgram& program, const Box& box,
                const surface::RegionSurface& surface, MeshedDesign& made, Diagnostics& diagnostics) {
  const std::vector<design::Rgba> colours = mean_colours(loaded.design, program.partition, box, diagnostics);
  const size_t count = program.regions.size();
  for (size_t n = 0; n < count; ++n) {
    surface::Body body = surface::body_of(surface, static_cast<surface::Label>(n + 1));
    const Region& region = program.regions[n];
    if (body.triangles.empty() || region.material == void_material) continue;
    const double share = count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) : 0;
    const double volume = surface::volume_mm3(body), area = surface::area_mm2(body);
    const design::Rgba colour = region.material ? loaded.design.materials.all()[*region.material].colour : colours[n];
    made.bodies.push_back({region, share, colour, std::move(body), volume, area});
  }
}

}  // namespace

std::optional<MeshedDesign> mesh_design(const Loaded& loaded, const MeshRequest& request, Diagnostics& diagnostics,
                                        Progress* progress, const StopFlag* stop) {
  const std::optional<Box> box = design_box(loaded.design, diagnostics);
  if (!box) return std::nullopt;
  const SourceRange where = loaded.design.parts[0].solid->where();
  MeshedDesign made;
  surface::ContourOptions options;
  if (!set_sizes(*box, request, where, made, options.corners, diagnostics)) return std::nullopt;
  const auto rule = region_rule(loaded.design, *box, request, diagnostics);
  if (!rule) return std::nullopt;
  const auto program = build_region_program(loaded.design, *box, *rule, diagnostics);
  if (!program) return std::nullopt;
  options.tolerance_mm = request.join_flat ? made.tolerance_mm : 0;
  options.threads = request.threads;
  const surface::RegionSurface surface = surface::contour(program->partition, options, progress, stop);
  made.report = surface.report;
  add_bodies(loaded, *program, *box, surface, made, diagnostics);
  return made;
}

}  // namespace ombre::compile
