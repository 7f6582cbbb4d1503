// A source for stages that are computed as a whole, before a job's first layer.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "stages/lattice_source.h"
#include "stages/stage_input.h"
#include "stages/stage_work.h"

namespace ombre::compile {

// A source that is computed as a whole. If no job prepares it, it does so itself when its first value is read.
class PreparedSource : public LatticeSource {
 public:
  PreparedSource(LatticeFrame frame, StageInput input, std::shared_ptr<SharedStageWork> shared)
      : LatticeSource(std::move(frame)), input_(std::move(input)), shared_(std::move(shared)) {}

  bool is_prepared() const { return is_prepared_; }
  // Throws Error if it takes more memory than the loan has.
  void check_memory(const StageLoan& loan) const;
  // Computes the values. Throws Error if memory does not suffice, and Cancelled.
  void prepare(const StageLoan& loan) const;
  virtual double kept_bytes() const = 0;  // size of the values; before preparation a lower bound
  // Makes all values 0 if they are not prepared.
  void leave_out() const { is_left_out_ = true; }

  void read_cells(size_t channel, const CellIndex& first, std::span<float> values) const final;
  Interval range_of_cells(size_t channel, const IndexBox& cells) const final;

 protected:
  bool has_values() const final { return is_prepared_; }
  const StageInput& input() const { return input_; }

  // Returns the least memory that computing takes, with the values that are kept.
  virtual double least_bytes() const = 0;
  virtual void compute(const StageLoan& loan, const design::StageWork& work) const = 0;
  virtual void read_made(size_t channel, const CellIndex& first, std::span<float> values) const = 0;
  virtual Interval range_of_made(size_t channel, const IndexBox& cells) const = 0;
  // made() returns the values so that they can be kept; take() sets values that another source of the same class made.
  virtual std::shared_ptr<const void> made() const = 0;
  virtual void take(std::shared_ptr<const void> made) const = 0;
  // pack() returns the values as bytes; unpack() sets values that another source of the same class packed. It returns
  // false if they are not as many as this source has.
  virtual std::string pack() const = 0;
  virtual bool unpack(std::string_view values) const = 0;

 private:
  design::SubDesignMemory* memory() const { return frame().made_from ? shared_->memory.load() : nullptr; }
  bool is_remembered() const;
  bool is_kept(StageKeeper& keeper) const;
  void keep(const StageLoan& loan) const;

  StageInput input_;
  std::shared_ptr<SharedStageWork> shared_;
  mutable std::mutex mutex_;
  mutable std::atomic<bool> is_prepared_{false}, is_left_out_{false};
};

}  // namespace ombre::compile
