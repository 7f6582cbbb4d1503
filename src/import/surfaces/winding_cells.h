// Winding numbers of a closed mesh around points, from the few triangles near them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/math/box.h"
#include "import/surfaces/point_winding.h"

namespace ombre::importing {

// A grid of equal boxes over a mesh. In a box that no triangle meets, the winding number is constant; other boxes list
// their triangles. A ray along -x counts its crossings box by box, up to the next box without triangles.
class WindingCells {
 public:
  // Builds the grid; `winding` is queried at the middles of a few boxes and for triangles, and must outlive this
  // object.
  explicit WindingCells(const PointWinding& winding);

  // Returns the same number as `winding`, or null beyond the mesh and where too many triangles or boxes with triangles
  // lie in a row.
  std::optional<int64_t> at(Vec3 p) const;

 private:
  using Place = std::array<int64_t, 3>;

  void cut_into(double boxes);
  double flags() const;
  std::pair<Place, Place> around(const std::array<Vec3, 3>& corners) const;
  size_t number(const Place& place) const;
  Vec3 middle(const Place& place) const;
  int64_t along(int axis, double at) const;
  template <class Visit>
  void for_boxes(const std::array<Vec3, 3>& corners, const Visit& visit) const;
  void list_triangles();
  void fill();
  int8_t filled(const Place& place) const;

  const PointWinding& winding_;
  Box bounds_;
  Vec3 size_mm_;  // size of a box
  double slack_mm_ = 0;
  Place count_{};
  std::vector<int8_t> windings_;
  std::vector<uint32_t> begins_;  // by box: index of its first triangle; one entry more than there are boxes
  std::vector<uint32_t> triangles_;
};

}  // namespace ombre::importing
