// Finds the voxels of a row inside of a surface with gaps.
#pragma once

#include <memory>

#include "import/surfaces/generalized_winding.h"
#include "import/surfaces/row_winding.h"

namespace ombre::importing {

// One placement on a voxel lattice. Rows are crossed with the closed surface; voxels where its caps matter are computed
// one by one.
class GeneralizedRows final : public program::RowSampler {
 public:
  // Constructs the rows of a placement; the map must be invertible.
  GeneralizedRows(std::shared_ptr<const GeneralizedWinding> winding, const Affine& source_from_index);

  void layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
             std::vector<std::vector<program::Span>>& rows) const override;

 private:
  class Row;

  std::shared_ptr<const GeneralizedWinding> winding_;
  Affine source_from_index_;
  bool is_mirrored_;  // true if the map mirrors, so that triangles face the other way in the lattice
  RowWinding closed_rows_;
};

}  // namespace ombre::importing
