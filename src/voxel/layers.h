// Evaluates a program on a voxel lattice, slab by slab, to runs of materials.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/run.h"
#include "program/program.h"
#include "voxel/lattice.h"

namespace ombre::voxel {

// How a composition becomes one material. Both are pure functions of (seed, i, j, k, composition).
enum class Dither { stochastic, threshold };

// What the outputs of a program are. Output 0 is the truth value "inside".
struct MaterialProgram {
  program::Program program;           // without calls
  std::vector<MaterialId> materials;  // outputs 1 .. materials.size() are their fractions, which sum to one
  size_t check_count = 0;             // the outputs after them are 1 where a check fails
};

struct CheckHits {
  uint64_t count = 0;
  std::array<int64_t, 3> first{};  // the least voxel in the order k, j, i; meaningless when count is 0
};

struct LayerResult {
  RunLayer runs;                                // of the whole width and height of the lattice
  std::array<uint64_t, 256> material_counts{};  // by MaterialId
  std::vector<CheckHits> checks;
};

// Thread-safe; the result for a layer does not depend on how layers are grouped.
class LayerEvaluator {
 public:
  LayerEvaluator(MaterialProgram program, const Lattice& lattice, Dither dither, uint64_t seed);
  ~LayerEvaluator();

  // Layers [begin, end) of the lattice, lowest first. Works best on 4 to 16 at a time.
  std::vector<LayerResult> layers(int64_t begin, int64_t end) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ombre::voxel
