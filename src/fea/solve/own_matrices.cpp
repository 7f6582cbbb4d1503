#include "fea/solve/own_matrices.h"

#include <map>

#include "fea/model/walls.h"
#include "fea/solve/cut_brick.h"

namespace ombre::fea {
namespace {

// Calls make(fill, section) once for each pair that is needed.
template <class Wanted, class Make>
OwnMatrices matrices_of(const Bricks& bricks, const std::vector<uint16_t>& section_of, const Wanted& is_wanted,
                        const Make& make) {
  OwnMatrices own;
  if (bricks.fills.empty()) return own;
  own.number.assign(bricks.count(), 0);
  std::map<std::pair<Fill, uint16_t>, uint32_t> known;
  for (size_t n = 0; n < bricks.count(); ++n) {
    if (!is_wanted(n)) continue;
    const auto [place, is_new] =
        known.try_emplace({bricks.fills[n], section_of[n]}, static_cast<uint32_t>(known.size() + 1));
    own.number[n] = place->second;
    if (!is_new) continue;
    const auto matrix = make(bricks.fills[n], section_of[n]);
    own.size = matrix.size();
    own.values.insert(own.values.end(), matrix.begin(), matrix.end());
  }
  if (known.empty()) own.number.clear();
  return own;
}

}  // namespace

std::vector<uint8_t> bricks_with_own_stiffness(const Bricks& bricks) {
  if (bricks.fills.empty()) return std::vector<uint8_t>(bricks.count());
  std::vector<uint8_t> is_own = bricks_of_thin_walls(bricks);
  for (size_t n = 0; n < bricks.count(); ++n)
    if (bricks.fills[n] != full_fill) is_own[n] = 1;
  return is_own;
}

OwnMatrices own_stiffness(const Model& model) {
  const Bricks& bricks = model.bricks;
  const std::vector<uint8_t> is_own = bricks_with_own_stiffness(bricks);
  return matrices_of(
      bricks, model.section_of, [&](size_t n) { return is_own[n] != 0; },
      [&](Fill fill, uint16_t section) {
        const Elastic& elastic = model.sections[section].elastic;
        const Moduli moduli = moduli_of(elastic.modulus_mpa, elastic.poissons_ratio);
        return cut_stiffness(bricks.size_mm, fill, moduli.shear, moduli.bulk);
      });
}

OwnMatrices own_conductance(const Bricks& bricks, const std::vector<Section>& sections,
                            const std::vector<uint16_t>& section_of, double per_mm) {
  return matrices_of(
      bricks, section_of, [&](size_t n) { return bricks.fills[n] != full_fill; },
      [&](Fill fill, uint16_t section) {
        PackedConductance matrix = cut_conductance(bricks.size_mm, fill);
        for (double& value : matrix) value *= per_mm * sections[section].conductivity;
        return matrix;
      });
}

double multigrid_bytes(const Bricks& bricks, size_t unknowns, double node_bytes, double brick_bytes) {
  constexpr double all_levels = 8.0 / 7;  // coarser levels take a seventh of the finest
  double cut = 0;
  for (const Fill fill : bricks.fills) cut += fill != full_fill ? 1 : 0;
  const size_t matrix = unknowns == 1 ? sizeof(PackedConductance) : sizeof(PackedStiffness);
  return cut * static_cast<double>(matrix) +
         static_cast<double>(bricks.fills.size() * (sizeof(Fill) + sizeof(uint32_t))) +
         all_levels * (node_bytes * static_cast<double>(bricks.node_count()) +
                       brick_bytes * static_cast<double>(bricks.count()));
}

}  // namespace ombre::fea
