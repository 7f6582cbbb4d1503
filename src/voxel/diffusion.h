// Error diffusion: mixtures within one layer that keep their fractions over a few voxels.
//
// Each voxel gets the material that is most wanting, and passes its error on to the voxels after it, with the weights
// of R. W. Floyd and L. Steinberg ("An adaptive algorithm for spatial grayscale", Proc. SID 17, 1976). Every other row
// runs backwards. With several materials the error is a vector that sums to zero. A little noise is added to each
// choice, so that layers of one composition do not repeat each other voxel by voxel, and no regular pattern arises.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "voxel/quantise.h"

namespace ombre::voxel {

// Diffuses the errors of one layer, row by row. The result is a pure function of seed, layer and composition, since all
// sums are of integers.
//
// Errors are passed only between mixed voxels, which have a choice, so none are lost at edges, holes or regions of one
// material. An error without a mixed voxel ahead or below waits, and each of the next mixed voxels takes a share. Over
// a whole layer, a material's number of voxels differs from the sum of its fractions only by the errors carried at the
// end.
class LayerDiffuser {
 public:
  // Materials are numbered from 0; there are at most 256. `k` is the number of the layer in the job.
  LayerDiffuser(int64_t width, size_t materials, uint64_t seed, int64_t k);

  // Chooses the materials of row j. Must be called for every row in order, including empty ones. `inside_next` tells
  // what is inside in the next row, and is empty for the last row. fractions[material][i] must sum to one where
  // inside[i] is not 0; they are rounded to 1/65536. There, chosen[i] is set to the index of a material with a positive
  // fraction; elsewhere it is not changed.
  void row(int64_t j, std::span<const uint8_t> inside, std::span<const uint8_t> inside_next,
           std::span<const float* const> fractions, std::span<uint8_t> chosen);

  // Returns the sum of fractions minus the number of voxels of each material, in 1/65536 of a voxel.
  std::vector<int64_t> carried() const;

 private:
  using Fixed = int64_t;  // 48.16 fixed point, since waiting errors may come from a whole row

  Fixed* at(std::vector<Fixed>& values, int64_t i) { return values.data() + static_cast<size_t>(i) * materials_; }
  bool is_mixed(int64_t i) const { return mixed_[static_cast<size_t>(i + 1)] != 0; }
  void read(std::span<const uint8_t> inside, std::span<const float* const> fractions, std::span<uint8_t> chosen);
  size_t read_voxel(int64_t i, std::span<const float* const> fractions);
  void receive();
  void hand_down(int64_t i);
  void take_waiting(Fixed* error);
  size_t most_wanting(int64_t i, const Fixed* errors) const;
  bool goes_down(int64_t i, std::span<const uint8_t> inside_next) const;
  void diffuse(int64_t i, bool down, uint8_t& chosen);

  int64_t width_, k_;
  size_t materials_;
  uint64_t seed_;
  int direction_ = 1;             // along x, in the last row
  std::vector<uint8_t> mixed_;    // one flag per voxel of the row, with one more at either end
  std::vector<Fixed> fractions_;  // [voxel][material], as are the next two
  std::vector<Fixed> errors_;     // errors that reach the row
  std::vector<Fixed> below_;      // errors that the row passes down
  std::vector<Fixed> waiting_;    // [material]
  std::vector<uint32_t> noise_;   // [material], for the current row
};

}  // namespace ombre::voxel
