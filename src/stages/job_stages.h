// The stages of a job: their sources, their shared state, and the order in which they are computed.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <vector>

#include "stages/prepared_source.h"

namespace ombre::compile {

// True if a sweep over cells of this size is feasible.
bool is_sensible_sweep(const Box& bounds, Vec3 cell);
std::string too_many_cells(Vec3 cell);

// The thread-safe host of a job's stages.
class JobStages final : public design::StageHost {
 public:
  explicit JobStages(MakeStageInput make_input);

  program::SourceField source(const design::StagePtr& stage, const design::StagePlace& place) override;

  // Sets the threads, memory and stop flag that halo stages use from now on. The place where values are kept stays the
  // same if the loan has none.
  void lend(const StageLoan& loan);
  // Throws Error when a stage needs more memory than the job may take.
  void check_memory(const StageLoan& loan) const;
  // Calls lend(), and computes the stages that are computed as a whole, in the order in which they read each other.
  // Does nothing if that has been done. Throws Error if memory does not suffice, and Cancelled.
  void prepare(const StageLoan& loan);
  bool is_prepared() const;
  // True if a stage is computed as a whole, which prepare() does.
  bool has_whole_stages() const { return !prepared().empty(); }
  // Makes stages that are not prepared 0 everywhere, for estimates.
  void leave_out_unprepared();
  // Returns the most memory that stages hold while the job goes through its layers on the loan's threads.
  size_t memory_bytes(const StageLoan& loan) const;
  BlockCache::Counts block_counts() const { return shared_->blocks.counts(); }

 private:
  using Key = std::tuple<const design::Stage*, std::array<double, 3>, std::array<double, 3>>;
  struct Made {
    design::StagePtr stage;  // keeps alive the stage whose address is in the key
    std::weak_ptr<const program::FieldSource> source;
  };
  program::SourceField make(const design::StagePtr& stage, const design::StagePlace& place,
                            const design::StageLattice& lattice);
  std::vector<std::shared_ptr<const PreparedSource>> prepared() const;
  void keep(const program::SourceField& source);
  double block_bytes(const StageLoan& loan) const;
  double kept_bytes() const;

  MakeStageInput make_input_;
  std::shared_ptr<SharedStageWork> shared_;
  mutable std::mutex mutex_;
  std::map<Key, Made> sources_;
  // Stages that are computed as a whole; a stage comes after those that it reads. A job may ask for one and never use
  // it.
  std::vector<std::weak_ptr<const PreparedSource>> prepared_;
  std::vector<program::SourceField> kept_;  // sources whose values are kept
  double halo_bytes_ = 0;                   // memory of one thread that computes a block
  bool has_halos_ = false;
};
using JobStagesPtr = std::shared_ptr<JobStages>;

}  // namespace ombre::compile
