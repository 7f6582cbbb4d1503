// Error diffusion: mixtures in one layer whose fractions hold over a few voxels already.
//
// Each voxel takes the material that is most wanting, and hands on what it took too much or too little
// of to the voxels after it, with the weights of R. W. Floyd and L. Steinberg ("An adaptive algorithm for
// spatial grayscale", Proc. SID 17, 1976), every other row backwards. With several materials the error is
// a vector that sums to zero. A little noise moves the choice, so that layers of one composition do not
// repeat each other, voxel above voxel, and no pattern sets in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "voxel/quantise.h"

namespace ombre::voxel {

// The rows of one layer, one after the other. The result is a pure function of seed, layer and
// composition, and all sums are of whole numbers.
//
// Errors stay among the mixed voxels, those that have a choice, so that neither edges nor holes nor regions
// of one material lose any. What finds no mixed voxel ahead or below waits, and the next mixed voxels take
// a share each. In a whole layer, then, a material's voxels differ from the sum of its fractions only by
// what is carried at the end.
class LayerDiffuser {
 public:
  // Materials are indices from 0, at most 256 of them. `k` is the layer's number in the job.
  LayerDiffuser(int64_t width, size_t materials, uint64_t seed, int64_t k);

  // Voxels of row j; each call is for the row after the last, and rows without voxels count. `inside_next` is
  // what is inside in the row to come, empty for the last row. fractions[material][i] sum to one where
  // inside[i] is not 0; they are rounded to 1/65536. There, chosen[i] becomes the index of a material with a
  // positive fraction; elsewhere it is left alone.
  void row(int64_t j, std::span<const uint8_t> inside, std::span<const uint8_t> inside_next,
           std::span<const float* const> fractions, std::span<uint8_t> chosen);

  // Fractions minus voxels so far, of each material, in 1/65536 of a voxel.
  std::vector<int64_t> carried() const;

 private:
  using Fixed = int64_t;  // 48.16; wide, since errors that wait may come from a whole row

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
  int direction_ = 1;             // along x, in the row last taken
  std::vector<uint8_t> mixed_;    // by voxel of the row, with one more at either end
  std::vector<Fixed> fractions_;  // [voxel][material], as are the next two
  std::vector<Fixed> errors_;     // that reach the row
  std::vector<Fixed> below_;      // that the row hands down
  std::vector<Fixed> waiting_;    // [material]
  std::vector<uint32_t> noise_;   // [material], of the row
};

}  // namespace ombre::voxel
