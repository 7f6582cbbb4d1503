// Where a closed mesh winds equally often around all points of a neighbourhood.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "base/box.h"
#include "import/surface.h"

namespace ombre::importing {

// Equal boxes over a mesh: around all points of those that no triangle meets, it winds equally often.
class WindingCells {
 public:
  // `winding` is asked in the middles of a few boxes.
  WindingCells(const Surface& surface, const std::function<int64_t(Vec3)>& winding);

  // None beside triangles and beyond the mesh.
  std::optional<int64_t> at(Vec3 p) const;

 private:
  using Place = std::array<int64_t, 3>;

  void cut_into(double boxes);
  double marks(const Surface& surface) const;
  std::pair<Place, Place> around(const std::array<Vec3, 3>& corners) const;
  size_t number(const Place& place) const;
  Vec3 middle(const Place& place) const;
  void mark(const std::array<Vec3, 3>& corners);
  void fill(const std::function<int64_t(Vec3)>& winding);
  int8_t filled(const Place& place, const std::function<int64_t(Vec3)>& winding) const;

  Box bounds_;
  Vec3 size_mm_;  // of a box
  double slack_mm_ = 0;
  Place count_{};
  std::vector<int8_t> windings_;
};

}  // namespace ombre::importing
