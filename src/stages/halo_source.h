// A source for stages that read a few cells around each; blocks are computed when something asks for their values.
#pragma once

#include <memory>

#include "stages/lattice_source.h"
#include "stages/stage_input.h"
#include "stages/stage_work.h"

namespace ombre::compile {

class HaloSource final : public LatticeSource {
 public:
  HaloSource(LatticeFrame frame, std::shared_ptr<const design::HaloStage> stage, StageInput input,
             std::shared_ptr<SharedStageWork> shared);

  void read_cells(size_t channel, const CellIndex& first, std::span<float> values) const override;
  std::unique_ptr<CellReader> reader() const override;
  Interval range_of_cells(size_t channel, const IndexBox& cells) const override;

 protected:
  // While the job is being planned, ranges do not depend on values.
  bool has_values() const override { return shared_->is_under_way; }

 private:
  class Reader;
  ValueBlockPtr block_with(const CellIndex& cell) const;
  ValueBlock known_or_computed(const CellIndex& number) const;
  ValueBlock compute(const IndexBox& box) const;
  design::StageValues made_of(const design::StageValues& read, const IndexBox& box) const;
  // The cells that a box of cells reads, with their values.
  struct Around {
    std::optional<design::StageValues> values;
    std::vector<float> same;  // without `values`: the value of each channel, which is the same everywhere
  };
  Around around_cells(const IndexBox& box) const;
  ValueBlockPtr input_block(const CellIndex& number) const;
  IndexBox grown(const IndexBox& box) const;

  std::shared_ptr<const design::HaloStage> stage_;
  StageInput input_;
  std::shared_ptr<SharedStageWork> shared_;
  design::HaloStage::Reach reach_;
  std::array<int64_t, 3> block_;  // size of a block in cells along each axis
  IndexBox filled_;               // beyond these cells the values read are 0, if there are such cells
  uint64_t own_blocks_, input_blocks_;
};

// Returns the most memory in bytes that a thread takes to compute one block.
double bytes_of_halo_block(const design::HaloStage::Reach& reach, size_t channels_read, size_t channels_made);

}  // namespace ombre::compile
