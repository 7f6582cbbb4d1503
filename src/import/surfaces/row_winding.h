// Finds the voxels of a row inside of a mesh, by winding numbers.
#pragma once

#include "import/fields/dyadic_bins.h"
#include "import/fields/ray_crossings.h"
#include "import/surfaces/perspective.h"
#include "import/surfaces/surface.h"
#include "program/field_source.h"

namespace ombre::importing {

enum class InsideRule {
  nonzero,     // the winding number is not 0: overlapping shells unite, inverted shells are cavities
  parity,      // the winding number is odd: overlaps of shells are holes
  generalized  // the winding number is more than one half: for meshes with gaps
};

inline bool is_inside(int64_t winding, InsideRule rule) {
  return rule == InsideRule::parity ? (winding & 1) != 0 : winding != 0;
}

// One placement of a surface on a voxel lattice; voxel (i, j, k) is the point (i, j, k) of index space.
class RowWinding final : public program::RowSampler {
 public:
  // Constructs the rows of a placement; the map must be invertible, and the rule nonzero or parity.
  RowWinding(SurfacePtr surface, const Affine& source_from_index, InsideRule rule);
  // Constructs the rows along the rays of a picture; source_from_view must be invertible.
  RowWinding(const Surface& surface, const program::RayLattice& rays, const Affine& source_from_view, InsideRule rule);

  // A change along row j of a layer: from this voxel on, the winding number is greater by `winding`.
  struct Crossing {
    int64_t row = 0;  // its j
    int64_t voxel = 0;
    int64_t winding = 0;
  };

  void layer(int64_t k, int64_t j_begin, int64_t j_end, int64_t width,
             std::vector<std::vector<program::Span>>& rows) const override;
  // Returns crossings in no particular order, with voxels clamped to [0, width]. For a closed mesh each row adds up to
  // 0.
  void find_crossings(int64_t k, int64_t j_begin, int64_t j_end, int64_t width, std::vector<Crossing>& found) const;

 private:
  struct Outline;
  const std::vector<Segment>& outline(int64_t k) const;
  void cross_rows(const Segment& segment, int64_t j_begin, int64_t j_end, int64_t width,
                  std::vector<Crossing>& found) const;

  uint64_t id_;  // unique
  SurfacePtr surface_;
  std::vector<Vec3> vertices_;  // in index space; for rays, x is a perspective depth
  std::optional<PerspectiveDepth> depth_;
  InsideRule rule_;
  DyadicBins by_layer_;
};

}  // namespace ombre::importing
