// Finds the voxels of a row that lie in beams.
#pragma once

#include <memory>
#include <vector>

#include "base/math/box_tree.h"
#include "import/fields/beam_shape.h"
#include "program/field_source.h"

namespace ombre::importing {

using BeamShapes = std::shared_ptr<const std::vector<BeamShape>>;

// One placement of beams on a voxel lattice, or on the rays of a picture. Rows are straight lines; a row contains the
// voxels whose centres lie in a piece of a beam.
class BeamRows final : public program::RowSampler {
 public:
  // Constructs the rows of a placement; the map must be invertible.
  BeamRows(BeamShapes shapes, const Affine& source_from_index);
  BeamRows(BeamShapes shapes, const program::RayLattice& rays, const Affine& source_from_view);

  void layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
             std::vector<std::vector<program::Span>>& rows) const override;

 private:
  // A line of voxels: voxel i is the point origin + i * step of the source's space, for i from `first` on.
  struct Line {
    Vec3 origin, step;
    int64_t first = 0;
  };
  // The lattice of voxels: a regular grid in some space, or the rays of a perspective.
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
  std::vector<uint32_t> numbers_;  // numbers of the beams that may be visible
  std::vector<Box> boxes_;         // boxes around these beams, in voxels
  BoxTree tree_;
};

}  // namespace ombre::importing
