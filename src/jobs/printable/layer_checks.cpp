#include "jobs/printable/layer_checks.h"

#include <cmath>
#include <numbers>

#include "base/text/text.h"
#include "jobs/printable/flag_pieces.h"

namespace ombre::compile {
namespace {

// Returns the offsets from a voxel to those of the next layer that it supports.
Offsets supported_offsets(double overhang_degrees, Vec3 voxel_mm) {
  const double reach_mm = voxel_mm.z * std::tan(overhang_degrees * std::numbers::pi / 180);
  Offsets offsets = offsets_nearer(reach_mm, {voxel_mm.x, voxel_mm.y, 2 * reach_mm});
  std::erase_if(offsets.spans, [](const OffsetSpan& span) { return span.k != 1; });
  return offsets;
}

// Calls `found(layer, supported)` with each layer of [begin, end) that stands on another one, and keeps what it
// returns.
template <class Found>
BitLayers each_upper_layer(const SolidLayers& layers, const Offsets& offsets, int64_t begin, int64_t end,
                           const Found& found) {
  BitLayers result = dilated(layers.solid, offsets, begin, end);
  for (int64_t k = begin; k < end; ++k) {
    BitLayer& layer = result.layers[static_cast<size_t>(k - begin)];
    const BitLayer& solid = layers.solid.at(k);
    layer = k > 0 ? found(solid, layer &= solid) : BitLayer(solid.width(), solid.height());
  }
  return result;
}

BitLayer islands_of(const BitLayer& solid, const BitLayer& supported) {
  FlagPieceFinder regions;
  regions.add(0, solid, &supported);
  return regions.last_where([](const FlagPiece& region) { return !region.is_pinned; });
}

PrintCheck layer_check(double overhang_degrees, Vec3 voxel_mm,
                       BitLayer (*found)(const BitLayer& solid, const BitLayer& supported)) {
  const Offsets offsets = supported_offsets(overhang_degrees, voxel_mm);
  PrintCheck check;
  check.reach = offsets.reach();
  check.flags = [=](const SolidLayers& layers, int64_t begin, int64_t end) {
    return each_upper_layer(layers, offsets, begin, end, found);
  };
  return check;
}

}  // namespace

PrintCheck island_check(double overhang_degrees, Vec3 voxel_mm) {
  PrintCheck check = layer_check(overhang_degrees, voxel_mm, islands_of);
  check.kind = "island";
  check.text = "islands, which begin in a layer with nothing below them";
  check.remedy = "turn the part, or put support(" + format_rounded(overhang_degrees) + ") under it";
  check.is_error = true;
  return check;
}

PrintCheck overhang_check(double overhang_degrees, Vec3 voxel_mm) {
  PrintCheck check = layer_check(overhang_degrees, voxel_mm, [](const BitLayer& solid, const BitLayer& supported) {
    BitLayer hanging = solid;
    return hanging.remove(supported).remove(islands_of(solid, supported));
  });
  check.kind = "overhang";
  check.text = "overhangs of more than " + format_rounded(overhang_degrees) + " degrees from the vertical";
  check.remedy = "turn the part, or put support(" + format_rounded(overhang_degrees) + ") under it";
  return check;
}

PrintCheck cup_check() {
  PrintCheck check;
  check.kind = "cup";
  check.text = "cups that open upwards, which hold resin while layers are built";
  check.remedy = "turn the part, or give them a drain";
  check.found = FoundPieces::held;
  check.flags = [](const SolidLayers& layers, int64_t begin, int64_t end) {
    BitLayers open{begin, {}};
    for (int64_t k = begin; k < end; ++k) open.layers.push_back(layers.solid.at(k));
    return inverted(std::move(open));
  };
  return check;
}

}  // namespace ombre::compile
