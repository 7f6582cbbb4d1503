// Evaluates a program on a voxel lattice, slab by slab, to runs of materials.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/run.h"
#include "program/program.h"
#include "voxel/lattice.h"

namespace ombre::voxel {

// How a composition becomes one material. All are pure functions of (seed, i, j, k, composition).
enum class Dither {
  stochastic,  // white noise
  blue_noise,  // a mask whose neighbours differ (blue_noise.h)
  diffusion,   // of errors within a layer (diffusion.h); a pure function of the whole layer
  threshold,   // the greatest fraction takes the voxel
};

const std::vector<std::string>& dither_names();
std::string_view name(Dither dither);
std::optional<Dither> dither(std::string_view name);

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
  RunLayer runs;                                // of the whole width and height of the lattice, or of a region's
  std::optional<RunLayer> lower_bytes;          // of shades of 16 bits, whose upper bytes are the runs
  std::array<uint64_t, 256> material_counts{};  // by MaterialId
  std::vector<CheckHits> checks;
};

// Who computes values. Batches are floats, the reference is in double precision; voxels within rounding
// of a boundary may differ.
enum class Evaluator { batch, reference };
// In the order of the values.
const std::vector<std::string>& evaluator_names();

struct EvaluatorOptions {
  Evaluator evaluator = Evaluator::batch;
  // These decide no voxel, only speed:
  std::string instruction_set;   // one of instruction_sets(); empty: the best
  bool prune = true;             // ask intervals about tiles
  bool write_parts_out = false;  // many parts op by op, as the reference has them
  int64_t leaf_width = 0;        // of tiles that are not cut further; 0: what suits
};

// The names of what batches can run on here, best first; none without hardware multiply-add.
std::vector<std::string> instruction_sets();

// Thread-safe; the result for a layer does not depend on how layers are grouped.
class LayerEvaluator {
 public:
  LayerEvaluator(const MaterialProgram& program, const Lattice& lattice, Dither dither, uint64_t seed,
                 const EvaluatorOptions& options = {});
  ~LayerEvaluator();

  // Layers [begin, end) of the lattice, lowest first. Works best on 4 to 16 at a time. Throws Cancelled soon
  // after it is asked to stop.
  std::vector<LayerResult> layers(int64_t begin, int64_t end, const StopFlag* stop = nullptr) const;
  // The same voxels as far as they lie in a box of the lattice, whose size decides the work (but for error diffusion,
  // which goes through whole layers). Counts and checks are those of the box; checks then of whole layers.
  std::vector<LayerResult> region(const TileBox& box, const StopFlag* stop = nullptr) const;

  struct Parts;

 private:
  std::unique_ptr<Parts> parts_;
};

// The most that working on a slab takes beside its results.
size_t working_bytes(const Lattice& lattice, int64_t slab_layers, Dither dither, size_t material_count);

// Batches, unless this machine has no hardware multiply-add or floats cannot tell the lattice's voxels apart.
Evaluator best_evaluator(const Lattice& lattice);

}  // namespace ombre::voxel
