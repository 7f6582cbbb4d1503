// A source for stages that read layers from the top down.
#pragma once

#include "stages/column_runs.h"
#include "stages/prepared_source.h"

namespace ombre::compile {

class SweepSource final : public PreparedSource {
 public:
  SweepSource(LatticeFrame frame, std::shared_ptr<const design::SweepStage> stage, StageInput input,
              std::shared_ptr<SharedStageWork> shared);

  double kept_bytes() const override { return table_->bytes(); }

 protected:
  double least_bytes() const override { return bytes(1, 1, 1); }
  void compute(const StageLoan& loan, const design::StageWork& work) const override;
  void read_made(size_t channel, const CellIndex& first, std::span<float> values) const override;
  Interval range_of_made(size_t channel, const IndexBox& cells) const override;
  std::shared_ptr<const void> made() const override { return table_; }
  void take(std::shared_ptr<const void> made) const override {
    table_ = std::static_pointer_cast<const ColumnTable>(std::move(made));
  }
  std::string pack() const override { return table_->pack(); }
  bool unpack(std::string_view values) const override;

 private:
  // Number of layers read at once, and of threads that read them.
  struct Slabs {
    int64_t layers = 8;
    size_t window = 1, threads = 1;
  };
  Slabs slabs_for(const StageLoan& loan) const;
  double bytes_of_slab(int64_t layers) const;
  double bytes(int64_t layers, size_t window, size_t threads) const;

  std::shared_ptr<const design::SweepStage> stage_;
  mutable std::shared_ptr<const ColumnTable> table_;
};

}  // namespace ombre::compile
