#include "jobs/printable/print_checks.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "jobs/printable/layer_checks.h"

namespace ombre::compile {
namespace {

// The ball in the corner of a cube leaves out what is at most sqrt(3) - 1 radii away from it.
double corner_mm(double diameter_mm, Vec3 voxel_mm) {
  constexpr double corner = 0.7320508075688772;
  return corner * diameter_mm / 2 + length(voxel_mm);
}

std::string mm(double length_mm) { return format_rounded(length_mm) + " mm"; }

PrintCheck thin_check(const std::string& of, double limit_mm, bool fails, Vec3 voxel_mm,
                      std::function<const BitLayers&(const SolidLayers&)> region) {
  PrintCheck check;
  check.kind = "thin";
  check.text =
      "walls and details " + of + "thinner than " + mm(limit_mm) + (fails ? ", which fail" : ", which distort");
  check.remedy = "make them thicker, or remove them by opening(" + format_rounded(limit_mm / 2) + ")";
  check.is_error = fails;
  check.reach = reach_of_thin_places(limit_mm, voxel_mm);
  check.flags = [=](const SolidLayers& layers, int64_t begin, int64_t end) {
    return thin_places(region(layers), limit_mm, voxel_mm, begin, end);
  };
  return check;
}

PrintCheck gap_check(double limit_mm, bool fails, Vec3 voxel_mm) {
  PrintCheck check;
  check.kind = "gap";
  check.text = "gaps and holes narrower than " + mm(limit_mm) + (fails ? ", which close" : ", which distort");
  check.remedy = "make them wider, or fill them by closing(" + format_rounded(limit_mm / 2) + ")";
  check.is_error = fails;
  check.reach = reach_of_thin_places(limit_mm, voxel_mm);
  check.flags = [=](const SolidLayers& layers, int64_t begin, int64_t end) {
    return thin_places(inverted(layers.solid), limit_mm, voxel_mm, begin, end);
  };
  return check;
}

PrintCheck neighbour_check(const voxel::ForbiddenNeighbour& rule, MaterialId material, MaterialId near, Vec3 voxel_mm) {
  const Offsets offsets = offsets_nearer(rule.within_mm, voxel_mm);
  PrintCheck check;
  check.kind = "neighbour";
  check.text = rule.material + " nearer than " + mm(rule.within_mm) + " to " + (near == 0 ? "the surface" : rule.near);
  check.remedy = "keep a wall of another material between them";
  check.is_error = true;
  check.reach = offsets.reach();
  check.materials = {material};
  if (near != 0) check.materials.push_back(near);
  check.flags = [=](const SolidLayers& layers, int64_t begin, int64_t end) {
    const BitLayers other = near == 0 ? inverted(layers.solid) : layers.of_material.at(near);
    BitLayers flags = dilated(other, offsets, begin, end);
    for (int64_t k = begin; k < end; ++k)
      flags.layers[static_cast<size_t>(k - begin)] &= layers.of_material.at(material).at(k);
    return flags;
  };
  return check;
}

BitLayers part(const BitLayers& region, int64_t begin, int64_t end) {
  return {begin, {region.layers.begin() + (begin - region.first), region.layers.begin() + (end - region.first)}};
}

std::vector<MaterialId> if_any(MaterialId id) { return id == 0 ? std::vector<MaterialId>() : std::vector{id}; }

// Adds to a check that it looks at the solid without support, or at what is not that solid.
PrintCheck of_solid(PrintCheck check, MaterialId support, bool is_inverted) {
  check.materials = if_any(support);
  check.flags = [support, is_inverted](const SolidLayers& layers, int64_t begin, int64_t end) {
    BitLayers solid = solid_without(layers, support, begin, end);
    return is_inverted ? inverted(std::move(solid)) : solid;
  };
  return check;
}

PrintCheck bodies_check(MaterialId support) {
  return of_solid({.kind = "bodies",
                   .text = "bodies that do not touch the largest one",
                   .remedy = "join them to it, or remove them, if they are not meant",
                   .found = FoundPieces::but_largest},
                  support, false);
}

PrintCheck hollow_check(MaterialId support) {
  return of_solid({.kind = "hollow",
                   .text = "closed hollows, in which support, resin or powder stays",
                   .remedy = "fill them, or give them a drain",
                   .found = FoundPieces::enclosed},
                  support, true);
}

}  // namespace

int64_t reach_of_thin_places(double diameter_mm, Vec3 voxel_mm) {
  return 2 * ball_offsets(diameter_mm, voxel_mm).reach() +
         offsets_within(corner_mm(diameter_mm, voxel_mm), voxel_mm).reach();
}

BitLayers thin_places(const BitLayers& region, double diameter_mm, Vec3 voxel_mm, int64_t begin, int64_t end) {
  const Offsets ball = ball_offsets(diameter_mm, voxel_mm);
  const Offsets around = offsets_within(corner_mm(diameter_mm, voxel_mm), voxel_mm);
  const int64_t near = around.reach(), far = near + ball.reach();
  const BitLayers middles = eroded(region, ball, begin - far, end + far);
  const BitLayers reached = dilated(middles, ball, begin - near, end + near);
  const BitLayers excused = dilated(reached, around, begin, end);
  BitLayers thin = part(region, begin, end);
  for (int64_t k = begin; k < end; ++k) thin.layers[static_cast<size_t>(k - begin)].remove(excused.at(k));
  return thin;
}

BitLayers solid_without(const SolidLayers& layers, MaterialId support, int64_t begin, int64_t end) {
  BitLayers solid = part(layers.solid, begin, end);
  if (support != 0)
    for (int64_t k = begin; k < end; ++k)
      solid.layers[static_cast<size_t>(k - begin)].remove(layers.of_material.at(support).at(k));
  return solid;
}

MaterialId id_of(const Sampling& sampling, const std::string& name) {
  const auto found = std::ranges::find(sampling.materials, name, &SliceMaterial::name);
  return found == sampling.materials.end() ? MaterialId{0} : found->id;
}

std::vector<PrintCheck> print_checks(const CheckLimits& limits, const Sampling& sampling) {
  const Vec3 voxel_mm = sampling.lattice.voxel_mm();
  const auto whole = [](const SolidLayers& layers) -> const BitLayers& { return layers.solid; };
  std::vector<PrintCheck> checks;
  for (const bool fails : {true, false}) {
    const double limit = !limits.details ? 0 : fails ? limits.details->fails_mm : limits.details->distorts_mm;
    if (!(limit > 0)) continue;
    checks.push_back(thin_check("", limit, fails, voxel_mm, whole));
    checks.push_back(gap_check(limit, fails, voxel_mm));
    for (const SliceMaterial& material : sampling.materials) {
      if (!limits.each_material || sampling.materials.size() < 2) continue;
      const auto its = [id = material.id](const SolidLayers& layers) -> const BitLayers& {
        return layers.of_material.at(id);
      };
      checks.push_back(thin_check("of " + material.name + ' ', limit, fails, voxel_mm, its));
      checks.back().materials = {material.id};
    }
  }
  for (const voxel::ForbiddenNeighbour& rule : limits.neighbours) {
    const MaterialId material = id_of(sampling, rule.material), near = id_of(sampling, rule.near);
    if (material == 0 || (near == 0 && rule.near != "surface")) continue;
    checks.push_back(neighbour_check(rule, material, near, voxel_mm));
  }
  const MaterialId support = id_of(sampling, limits.support);
  if (limits.overhang_degrees) {
    checks.push_back(island_check(*limits.overhang_degrees, voxel_mm));
    checks.push_back(overhang_check(*limits.overhang_degrees, voxel_mm));
  }
  if (limits.is_vat) checks.push_back(cup_check());
  checks.push_back(hollow_check(support));
  checks.push_back(bodies_check(support));
  return checks;
}

}  // namespace ombre::compile
