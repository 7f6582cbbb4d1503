// Stages: what a node computes from values of solids on a lattice, and how a job places and makes it.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/math/index_box.h"
#include "base/math/interval.h"
#include "base/math/pitch.h"
#include "base/math/run.h"
#include "base/system/progress.h"
#include "base/text/error.h"
#include "design/node.h"
#include "program/field_source.h"

namespace ombre::design {

// A lattice in a node's space. Cell (i, j, k) has its centre at origin + (index + 0.5) * pitch, and there is no end.
struct StageLattice {
  Vec3 origin;
  std::array<Pitch, 3> pitch;
};

// Which lattice a stage gets.
struct LatticeChoice {
  // Cells of this size, else as large as the job's voxels.
  std::optional<Vec3> cell_mm;
  // Whether cell (0, 0, 0) begins at the corner of the stage's bounds. Else the cells are the job's own voxels, if only
  // shifts by whole voxels stand above the node, or cell (0, 0, 0) begins at the origin of the node's space.
  bool from_corner = false;
};

// What a stage reads of one solid. Outside of the solid fractions are 0, and attributes have their default.
struct StageRead {
  NodePtr solid;
  bool inside = false;     // 1 or 0
  bool distance = false;   // mm, negative inside
  bool fractions = false;  // of each of its materials
  std::vector<std::string> attributes;
};

// A number for each cell, read or computed by a stage.
struct StageChannel {
  std::string name;                    // "inside", "distance", or the name of a material or attribute
  std::optional<MaterialId> material;  // of a fraction
  size_t solid = 0;                    // number of the read that it belongs to
  bool is_flag = false;                // 0 or 1: between centres the nearest counts; other channels are linear there
  Interval range = Interval::everything();  // encloses all its values
};

// Throws Cancelled once it is asked to stop; the flag may be null.
inline void check_stop(const StopFlag* stop) {
  if (stop && stop->requested()) throw Cancelled();
}

// The values of some channels in a box of cells.
class StageValues {
 public:
  StageValues() = default;
  // All 0. Many take some time to get: throws Cancelled when `stop`, which may be null, asks for it meanwhile.
  StageValues(const IndexBox& box, size_t channels, const StopFlag* stop = nullptr) : box_(box), values_(channels) {
    for (std::vector<float>& values : values_) {
      check_stop(stop);
      values.resize(static_cast<size_t>(box.voxels()));
    }
  }

  const IndexBox& box() const { return box_; }
  size_t channels() const { return values_.size(); }
  // x fastest, then y, then z.
  std::vector<float>& channel(size_t n) { return values_[n]; }
  const std::vector<float>& channel(size_t n) const { return values_[n]; }
  size_t offset(int64_t i, int64_t j, int64_t k) const {
    return static_cast<size_t>(((k - box_.lo[2]) * box_.size(1) + (j - box_.lo[1])) * box_.size(0) + (i - box_.lo[0]));
  }

 private:
  IndexBox box_;
  std::vector<std::vector<float>> values_;
};

// What a job lends to a stage that is computed as a whole.
struct StageWork {
  int threads = 1;  // 0: all cores
  const StopFlag* stop = nullptr;
  std::function<void(double share)> tell = [](double) {};  // how much is done, 0 ... 1
};

// A stage belongs to one node, and is one of the three kinds below. Its values are a pure function of the values that
// it reads: neither pieces of a job nor threads show.
class Stage {
 public:
  virtual ~Stage() = default;
  virtual std::string name() const = 0;  // for messages: "supports"
  virtual Hash content() const = 0;      // of what it does, and with what
  virtual Box bounds() const = 0;        // of its solids: beyond them nothing is inside
  virtual LatticeChoice lattice() const { return {}; }
  virtual std::vector<StageRead> reads() const = 0;
  // The channels that it gives, of those that it reads.
  virtual std::vector<StageChannel> channels(const std::vector<StageChannel>& read) const = 0;
};
using StagePtr = std::shared_ptr<const Stage>;

// A halo stage reads so many cells around each cell.
class HaloStage : public Stage {
 public:
  struct Reach {
    std::array<int64_t, 3> below{}, above{};
  };
  // In cells of that size.
  virtual Reach reach(Vec3 cell_mm) const = 0;
  // `read` has all cells that those of `made` read. Every cell is computed in the same way, wherever it lies. Throws
  // Cancelled within a tenth of a second or so once `stop`, which may be null, asks for it.
  virtual void compute(const StageValues& read, StageValues& made, Vec3 cell_mm, const StopFlag* stop) const = 0;
};

// Values along columns of cells, as runs of equal ones.
class ColumnRuns {
 public:
  virtual ~ColumnRuns() = default;
  // Cells [bottom, top) of column (i, j). Runs of a column do not meet; what is in none is 0.
  virtual void add(size_t channel, int64_t i, int64_t j, int64_t bottom, int64_t top, float value) = 0;
};

// A sweep stage reads the layers from the top down, and keeps a state.
class SweepStage : public Stage {
 public:
  class Sweep {
   public:
    virtual ~Sweep() = default;
    // One layer of all cells.
    virtual void take(const StageValues& layer, ColumnRuns& made) = 0;
    virtual void finish(ColumnRuns& /*made*/) {}
  };
  virtual double bytes_of_column() const = 0;  // of the state
  virtual std::unique_ptr<Sweep> begin(const StageLattice& lattice, const IndexBox& cells,
                                       const StageWork& work) const = 0;
};

// A whole stage reads all cells at once.
class WholeStage : public Stage {
 public:
  virtual double bytes_of_cell() const = 0;  // that it takes besides the values
  virtual void compute(const StageValues& read, StageValues& made, const StageLattice& lattice,
                       const StageWork& work) const = 0;
};

// Where a node stands in a job, in its own space.
struct StagePlace {
  const MaterialTable& materials;
  std::optional<JobScale> scale;
  std::optional<Vec3> voxel_mm;         // of the job's lattice, or else of its scale
  std::optional<StageLattice> lattice;  // the job's, if only shifts by whole voxels stand above the node
};

// Makes the field sources of a job's stages. Thread-safe.
class StageHost {
 public:
  virtual ~StageHost() = default;
  // The same source for the same stage in the same place. Its values are computed when they are needed.
  virtual program::SourceField source(const StagePtr& stage, const StagePlace& place) = 0;
};

}  // namespace ombre::design
