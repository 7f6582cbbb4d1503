#include "fea/model/repeat.h"

#include <cmath>
#include <map>

namespace ombre::fea {

Vec3 Repeat::displacement_mm(int axis) const {
  const auto& e = mean_strain;
  const std::array<Vec3, 3> columns{
      {{e[0], e[3] / 2, e[5] / 2}, {e[3] / 2, e[1], e[4] / 2}, {e[5] / 2, e[4] / 2, e[2]}}};
  return period_mm[axis] * columns[static_cast<size_t>(axis)];
}

std::array<double, 6> mean_stress(const MeshView& mesh, const std::vector<std::array<double, 6>>& stress_mpa,
                                  Vec3 period_mm) {
  std::array<double, 6> mean{};
  const double volume = period_mm.x * period_mm.y * period_mm.z;
  for (size_t element = 0; element < mesh.count(); ++element)
    for (size_t n = 0; n < 6; ++n) mean[n] += mesh.volume_mm3(element) / volume * stress_mpa[element][n];
  return mean;
}

std::vector<Tie> ties_of(const MeshView& mesh, Vec3 period_mm) {
  constexpr double parts = 1 << 20;  // parts of a period; places in the same part count as equal
  std::map<std::array<int64_t, 3>, uint32_t> first;
  std::vector<Tie> ties;
  for (uint32_t node = 0; node < mesh.node_count(); ++node) {
    std::array<int64_t, 3> place{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto part = std::llround(mesh.node(node)[axis] / period_mm[axis] * parts);
      place[static_cast<size_t>(axis)] = ((part % (1 << 20)) + (1 << 20)) % (1 << 20);
    }
    const auto [found, is_first] = first.emplace(place, node);
    if (is_first) continue;
    Tie tie{node, found->second, {}};
    const Vec3 away = mesh.node(node) - mesh.node(tie.of);
    for (int axis = 0; axis < 3; ++axis)
      tie.periods[static_cast<size_t>(axis)] = static_cast<int>(std::lround(away[axis] / period_mm[axis]));
    ties.push_back(tie);
  }
  return ties;
}

}  // namespace ombre::fea
