// Finds the voxels of a row that lie inside of polygons, whatever their z.
#pragma once

#include <memory>

#include "import/fields/polygon_crossings.h"
#include "program/field_source.h"

namespace ombre::importing {

// One placement of polygons on a voxel lattice; the polygons lie in the xy plane of the source's space.
class PolygonRows final : public program::RowSampler {
 public:
  PolygonRows(std::shared_ptr<const Polygons> polygons, const Affine& source_from_index);
  void layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
             std::vector<std::vector<program::Span>>& rows) const override;

 private:
  void row(Vec2 first, int64_t width, std::vector<program::Span>& spans) const;

  std::shared_ptr<const Polygons> polygons_;
  Affine source_from_index_;
  bool stays_in_place_;  // true if all voxels of a row project to one point of the plane
  PolygonCrossings crossings_;
};

}  // namespace ombre::importing
