// Which voxels of a row lie in a beam.
#pragma once

#include <memory>
#include <vector>

#include "base/math/box_tree.h"
#include "import/fields/beam_shape.h"
#include "program/field_source.h"

namespace ombre::importing {

using BeamShapes = std::shared_ptr<const std::vector<BeamShape>>;

// One placement of beams on a voxel lattice, or on the rays of a picture. Rows are straight lines; a row holds those of
// its voxels' centres that lie in a piece of a beam.
class BeamRows final : public program::RowSampler {
 public:
  // The map must be invertible.
  BeamRows(BeamShapes shapes, const Affine& source_from_index);
  BeamRows(BeamShapes shapes, const program::RayLattice& rays, const Affine& source_from_view);

  void layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
             std::vector<std::vector<program::Span>>& rows) const override;

 private:
  // A row's voxel i is the point origin + i * step of the source's space, from `first` on.
  struct Line {
    Vec3 origin, step;
    int64_t first = 0;
  };
  // Voxels are a grid in some space, but for the perspective of rays.
  struct Grid {
    Affine source_from_grid;
    bool is_perspective = false;
    program::RayLattice rays;

    Line line(int64_t j, int64_t k) const;
    Box index_box(const Box& grid_box) const;
  };

  void build();
  void add(const BeamShape& shape, const Line& line, int64_t width, std::vector<program::Span>& row) const;

  BeamShapes shapes_;
  Grid grid_;
  std::vector<uint32_t> numbers_;  // of the beams that may be seen
  std::vector<Box> boxes_;         // around them, in voxels
  BoxTree tree_;
};

}  // namespace ombre::importing
