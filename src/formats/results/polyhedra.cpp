#include "formats/results/polyhedra.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ombre::formats {

uint32_t PolyhedronCutter::add_mean(std::vector<uint32_t> corners) {
  Vec3 sum{};
  for (const uint32_t corner : corners) sum = sum + results_.points[corner];
  const auto point = static_cast<uint32_t>(results_.points.size());
  results_.points.push_back((1.0 / static_cast<double>(corners.size())) * sum);
  means_.push_back({point, std::move(corners)});
  return point;
}

uint32_t PolyhedronCutter::centre_of(const Face& face) {
  Face sorted(face);
  std::ranges::sort(sorted);
  const auto known = centres_.find(sorted);
  if (known != centres_.end()) return known->second;
  return centres_[std::move(sorted)] = add_mean(face);
}

// Adds a tetrahedron, whose corners are reordered where its volume is negative; returns six times that volume.
double PolyhedronCutter::add_tetrahedron(uint32_t a, uint32_t b, uint32_t c, uint32_t top) {
  const Vec3 from = results_.points[a];
  const double volume = dot(cross(results_.points[b] - from, results_.points[c] - from), results_.points[top] - from);
  const std::array<uint32_t, 4> nodes{a, volume < 0 ? c : b, volume < 0 ? b : c, top};
  results_.add_element(ElementKind::tetrahedron4, nodes.data());
  return volume;
}

size_t PolyhedronCutter::add(std::span<const Face> faces) {
  std::vector<uint32_t> corners;
  for (const Face& face : faces) corners.insert(corners.end(), face.begin(), face.end());
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const uint32_t middle = add_mean(std::move(corners));
  const size_t before = results_.kinds.size();
  double all = 0, signed_all = 0;
  const auto add_one = [&](uint32_t a, uint32_t b, uint32_t c) {
    const double volume = add_tetrahedron(a, b, c, middle);
    all += std::abs(volume);
    signed_all += volume;
  };
  for (const Face& face : faces) {
    if (face.size() == 3) {
      add_one(face[0], face[1], face[2]);
      continue;
    }
    const uint32_t centre = centre_of(face);
    for (size_t n = 0; n < face.size(); ++n) add_one(face[n], face[(n + 1) % face.size()], centre);
  }
  constexpr double rounding = 1e-9;
  if (all - std::abs(signed_all) > rounding * all) ++folded_;
  return results_.kinds.size() - before;
}

void PolyhedronCutter::fill(ResultField& field) const {
  for (const Mean& mean : means_) {
    for (size_t c = 0; c < field.components; ++c) {
      double sum = 0;
      for (const uint32_t corner : mean.corners) sum += field.values[corner * field.components + c];
      field.values[mean.point * field.components + c] = sum / static_cast<double>(mean.corners.size());
    }
  }
}

}  // namespace ombre::formats
