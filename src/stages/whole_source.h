// A source for stages that read all cells at once.
#pragma once

#include "stages/prepared_source.h"

namespace ombre::compile {

class WholeSource final : public PreparedSource {
 public:
  WholeSource(LatticeFrame frame, std::shared_ptr<const design::WholeStage> stage, StageInput input,
              std::shared_ptr<SharedStageWork> shared)
      : PreparedSource(std::move(frame), std::move(input), std::move(shared)), stage_(std::move(stage)) {}

  double kept_bytes() const override;

 protected:
  double least_bytes() const override;
  void compute(const StageLoan& loan, const design::StageWork& work) const override;
  void read_made(size_t channel, const CellIndex& first, std::span<float> values) const override;
  Interval range_of_made(size_t channel, const IndexBox& cells) const override;
  std::shared_ptr<const void> made() const override { return made_; }
  void take(std::shared_ptr<const void> made) const override {
    made_ = std::static_pointer_cast<const design::StageValues>(std::move(made));
  }
  std::string pack() const override;
  bool unpack(std::string_view values) const override;

 private:
  double cell_count() const;
  design::StageValues read_all(const StageLoan& loan, const design::StageWork& work) const;

  std::shared_ptr<const design::WholeStage> stage_;
  mutable std::shared_ptr<const design::StageValues> made_;
};

}  // namespace ombre::compile
