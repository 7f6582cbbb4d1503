// Decides how a design is cut into regions, and how finely.
#include "questions/region_request.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "questions/part_labels.h"
#include "questions/region_survey.h"

namespace ombre::compile {
namespace {

constexpr double sides_of_tolerance = 1000;
// Distance in cells from the first corner to the box. It is not a round number, so that faces of round coordinates do
// not run through corners.
constexpr double margin_cells = 1.37;
constexpr int64_t most_cells = int64_t{1} << 20;  // limit along an axis

// Rounds to one digit: 0.0234 becomes 0.02.
double one_digit(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)));
  return std::floor(value / unit) * unit;
}

double longest(const Box& box) {
  const Vec3 size = box.size();
  return std::max({size.x, size.y, size.z});
}

// Returns the range that bands of a material's fraction cover.
std::optional<Interval> fraction_range(const design::Design& design, const Box& box, const RegionRule& rule,
                                       const BandRequest& bands, Diagnostics& diagnostics) {
  return bands.within > 0 ? value_range(design, box, rule.of, diagnostics) : Interval(0, 1);
}

std::vector<double> equal_borders(Interval range, int bands) {
  std::vector<double> borders;
  for (int n = 1; n < bands; ++n) borders.push_back(range.lo + (range.hi - range.lo) * n / bands);
  return borders;
}

int count_of(const BandRequest& bands, Interval range) {
  return bands.within > 0 ? fewest_bands(range, bands.within) : bands.count;
}

// Makes the rule for bands of a material's fraction, of an attribute, or of the fraction that varies most. Names of
// materials take precedence over attributes.
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
  if (rule.kind == RegionRule::Kind::fraction) rule.range = Interval(0, 1);
  if (!rule.borders.empty()) return rule;
  if (rule.kind == RegionRule::Kind::fraction) {
    const auto range = fraction_range(design, box, rule, bands, diagnostics);
    if (!range) return std::nullopt;
    rule.range = range;
    rule.borders = equal_borders(*range, count_of(bands, *range));
    return rule;
  }
  const auto whole = build_region_program(design, box, rule, diagnostics);
  const auto range = whole ? score_range(whole->partition, box) : std::nullopt;
  if (range) rule.borders = equal_borders(*range, count_of(bands, *range));
  rule.range = range;
  return whole ? std::optional(rule) : std::nullopt;
}

std::optional<RegionRule> crossed_rule(const design::Design& design, const Box& box, const RegionRequest& request,
                                       Diagnostics& diagnostics) {
  RegionRule rule{RegionRule::Kind::crossed, "", {}};
  std::vector<BandRequest> all{*request.bands};
  all.insert(all.end(), request.crossed.begin(), request.crossed.end());
  for (const BandRequest& bands : all) {
    auto one = band_rule(design, box, bands, diagnostics);
    if (!one) return std::nullopt;
    rule.crossed.push_back(std::move(*one));
  }
  return rule;
}

std::optional<RegionRule> region_rule(const design::Design& design, const Box& box, const RegionRequest& request,
                                      Diagnostics& diagnostics) {
  if (request.bands && !request.crossed.empty()) return crossed_rule(design, box, request, diagnostics);
  if (request.bands) return band_rule(design, box, *request.bands, diagnostics);
  if (request.by_part) return RegionRule{RegionRule::Kind::parts, "", {}};
  return RegionRule{request.by_material ? RegionRule::Kind::materials : RegionRule::Kind::whole, "", {}};
}

}  // namespace

int fewest_bands(Interval range, double within) {
  constexpr double rounding = 1e-9, most = 1000;
  return static_cast<int>(std::clamp(std::ceil((range.hi - range.lo) / (2 * within) - rounding), 1.0, most));
}

std::optional<Fineness> choose_fineness(const design::Design& design, const Box& box, const RegionRequest& request,
                                        Diagnostics& diagnostics) {
  const double tolerance = request.tolerance_mm.value_or(one_digit(longest(box) / sides_of_tolerance));
  const double cell_mm = request.cell_mm.value_or(cells_of_tolerance * tolerance);
  // Rounding removes the error of the multiplication.
  const std::optional<Pitch> cell = Pitch::from_mm(parse_number(format_rounded(cell_mm, 9)).value_or(cell_mm));
  if (cell && longest(box) / cell_mm <= static_cast<double>(most_cells)) return Fineness{tolerance, *cell};
  diagnostics.error(Code::too_large, design.parts[0].solid->where(),
                    "cells of " + format_rounded(cell_mm, 3) + " mm are too small for a part of " +
                        format_rounded(longest(box), 4) + " mm",
                    "choose a larger " + spelled::option("--cell") + " or " + spelled::option("--tolerance"));
  return std::nullopt;
}

design::Design for_tolerance(const design::Design& design, double tolerance_mm) {
  const double voxel = cells_of_tolerance / 2 * tolerance_mm;
  return design::for_job(design, {{voxel, voxel, voxel}, triangles_of_tolerance * tolerance_mm});
}

std::optional<RegionProgram> build_regions(const design::Design& given, const Box& box, const RegionRequest& request,
                                           Diagnostics& diagnostics, const design::NodePtr& shape) {
  const design::Design design = request.by_part ? with_part_nodes(given) : given;
  const auto rule = region_rule(design, box, request, diagnostics);
  return rule ? build_region_program(design, box, *rule, diagnostics, shape) : std::nullopt;
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

bool is_void(const Region& region) { return region.material == void_material; }

std::vector<design::Rgba> region_colours(const design::Design& design, const RegionProgram& program, const Box& box,
                                         Diagnostics& diagnostics) {
  std::vector<design::Rgba> colours = mean_colours(design, program.partition, box, diagnostics);
  for (size_t n = 0; n < colours.size(); ++n)
    if (const auto material = program.regions[n].material) colours[n] = design.materials.all()[*material].colour;
  return colours;
}

}  // namespace ombre::compile
