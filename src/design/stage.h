// Stages: values that a node computes from values of solids on a lattice, and their execution in a job.
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

// An unbounded lattice in a node's space. Cell (i, j, k) has its centre at origin + (index + 0.5) * pitch.
struct StageLattice {
  Vec3 origin;
  std::array<Pitch, 3> pitch;
};

// How a stage chooses its lattice.
struct LatticeChoice {
  // Size of the cells; the job's voxel size if not set.
  std::optional<Vec3> cell_mm;
  // If true, cell (0, 0, 0) begins at the corner of the stage's bounds. If false, the cells are the job's voxels
  // provided that the nodes above only translate by whole voxels; else cell (0, 0, 0) begins at the origin of the
  // node's space.
  bool from_corner = false;
};

// The values of one solid that a stage reads. Outside the solid fractions are 0 and attributes have their defaults.
struct StageRead {
  NodePtr solid;
  bool inside = false;     // 1 or 0
  bool distance = false;   // distance in mm, negative inside
  bool fractions = false;  // fractions of all its materials
  std::vector<std::string> attributes = {};
};

// A number for each cell, which a stage reads or computes.
struct StageChannel {
  std::string name;                    // "inside", "distance", or the name of a material or attribute
  std::optional<MaterialId> material;  // set if it is a fraction
  size_t solid = 0;                    // number of the StageRead to which it belongs
  bool is_flag = false;  // 0 or 1; uses the nearest centre, while other channels are interpolated linearly
  Interval range = Interval::everything();  // encloses all its values
};

// Throws Cancelled if a stop is requested. The flag may be null.
inline void check_stop(const StopFlag* stop) {
  if (stop && stop->requested()) throw Cancelled();
}

// The values of several channels in a box of cells.
class StageValues {
 public:
  StageValues() = default;
  // Sets all values to 0. Throws Cancelled if `stop`, which may be null, is set meanwhile, since large allocations take
  // time.
  StageValues(const IndexBox& box, size_t channels, const StopFlag* stop = nullptr) : box_(box), values_(channels) {
    for (std::vector<float>& values : values_) {
      check_stop(stop);
      values.resize(static_cast<size_t>(box.voxels()));
    }
  }

  const IndexBox& box() const { return box_; }
  size_t channels() const { return values_.size(); }
  // Returns the values with x varying fastest, then y, then z.
  std::vector<float>& channel(size_t n) { return values_[n]; }
  const std::vector<float>& channel(size_t n) const { return values_[n]; }
  size_t offset(int64_t i, int64_t j, int64_t k) const {
    return static_cast<size_t>(((k - box_.lo[2]) * box_.size(1) + (j - box_.lo[1])) * box_.size(0) + (i - box_.lo[0]));
  }

 private:
  IndexBox box_;
  std::vector<std::vector<float>> values_;
};

// Resources that a job gives to a stage that is computed as a whole.
struct StageWork {
  int threads = 1;  // 0 means all cores
  const StopFlag* stop = nullptr;
  std::function<void(double share)> tell = [](double) {};  // called with the share of the work that is done, 0 to 1
};

// A stage belongs to one node and is of one of the three kinds below. Its values are a pure function of the values that
// it reads, independent of how a job is divided and of threads.
class Stage {
 public:
  virtual ~Stage() = default;
  virtual std::string name() const = 0;  // name for messages: "supports"
  virtual Hash content() const = 0;      // hash of what it computes and of its parameters
  virtual Box bounds() const = 0;        // bounds of its solids; nothing is inside beyond them
  virtual LatticeChoice lattice() const { return {}; }
  virtual std::vector<StageRead> reads() const = 0;
  // Returns the channels that it computes from the channels that it reads.
  virtual std::vector<StageChannel> channels(const std::vector<StageChannel>& read) const = 0;
};
using StagePtr = std::shared_ptr<const Stage>;

// A stage that reads a fixed number of cells around each cell.
class HaloStage : public Stage {
 public:
  struct Reach {
    std::array<int64_t, 3> below{}, above{};
  };
  // Returns the number of cells around a cell of this size.
  virtual Reach reach(Vec3 cell_mm) const = 0;
  // Computes values. `read` contains all cells that the cells of `made` need. The result for a cell does not depend on
  // its position. Throws Cancelled within about a tenth of a second after `stop`, which may be null, is set.
  virtual void compute(const StageValues& read, StageValues& made, Vec3 cell_mm, const StopFlag* stop) const = 0;
};

// Values along columns of cells, as runs of equal values.
class ColumnRuns {
 public:
  virtual ~ColumnRuns() = default;
  // Adds cells [bottom, top) of column (i, j). The runs of a column do not overlap, and other cells are 0.
  virtual void add(size_t channel, int64_t i, int64_t j, int64_t bottom, int64_t top, float value) = 0;
};

// A stage that reads layers from the top down and keeps a state.
class SweepStage : public Stage {
 public:
  class Sweep {
   public:
    virtual ~Sweep() = default;
    // Processes one layer of all cells.
    virtual void take(const StageValues& layer, ColumnRuns& made) = 0;
    virtual void finish(ColumnRuns& /*made*/) {}
  };
  virtual double bytes_of_column() const = 0;  // size of the state
  virtual std::unique_ptr<Sweep> begin(const StageLattice& lattice, const IndexBox& cells,
                                       const StageWork& work) const = 0;
};

// A stage that reads all cells at once.
class WholeStage : public Stage {
 public:
  virtual double bytes_of_cell() const = 0;  // memory that it needs besides the values
  virtual void compute(const StageValues& read, StageValues& made, const StageLattice& lattice,
                       const StageWork& work) const = 0;
};

// The placement of a node in a job, in the node's own space.
struct StagePlace {
  const MaterialTable& materials;
  std::optional<JobScale> scale;
  std::optional<Vec3> voxel_mm;         // voxel size of the job's lattice, or else of its scale
  std::optional<StageLattice> lattice;  // the job's lattice, if the nodes above only translate by whole voxels
};

// Makes the field sources of a job's stages. Thread-safe.
class StageHost {
 public:
  virtual ~StageHost() = default;
  // Returns the source of a stage, the same one for the same stage and placement. Its values are computed when needed.
  virtual program::SourceField source(const StagePtr& stage, const StagePlace& place) = 0;
};

}  // namespace ombre::design
