// How often a closed mesh winds around a point, from the few triangles near to it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/math/box.h"
#include "import/surfaces/point_winding.h"

namespace ombre::importing {

// Equal boxes over a mesh. Around all points of a box that no triangle meets, the mesh winds equally often; the others
// know their triangles. A ray along -x counts its crossings box by box, as far as the next box without triangles.
class WindingCells {
 public:
  // `winding` is queried in the middles of a few boxes, and about triangles. It must live as long.
  explicit WindingCells(const PointWinding& winding);

  // The same number as `winding` gives. None beyond the mesh, and where many triangles or boxes with triangles lie in a
  // row.
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
  Vec3 size_mm_;  // of a box
  double slack_mm_ = 0;
  Place count_{};
  std::vector<int8_t> windings_;
  std::vector<uint32_t> begins_;  // box -> the first of its triangles; one more than boxes
  std::vector<uint32_t> triangles_;
};

}  // namespace ombre::importing
