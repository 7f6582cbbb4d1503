// Which voxels of a row are inside of a surface with gaps.
#pragma once

#include <memory>

#include "import/surfaces/generalized_winding.h"
#include "import/surfaces/row_winding.h"

namespace ombre::importing {

// One placement on a voxel lattice. Rows cross the closed surface; where its caps matter, voxels are computed.
class GeneralizedRows final : public program::RowSampler {
 public:
  // The map must be invertible.
  GeneralizedRows(std::shared_ptr<const GeneralizedWinding> winding, const Affine& source_from_index);

  void layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
             std::vector<std::vector<program::Span>>& rows) const override;

 private:
  class Row;

  std::shared_ptr<const GeneralizedWinding> winding_;
  Affine source_from_index_;
  bool is_mirrored_;  // seen from the lattice, triangles face the other way
  RowWinding closed_rows_;
};

}  // namespace ombre::importing
