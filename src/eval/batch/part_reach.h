// Finds the parts that can reach a box with SIMD; each lane tests one part.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "eval/batch/box_intervals.h"
#include "program/parts.h"
#include "program/passes/passes.h"

namespace ombre::eval {

// A filter for the tables of batches, which must outlive it. Not thread-safe.
class PartReach : public program::PartFilter {
 public:
  explicit PartReach(const KernelSet& kernels) : intervals_(kernels) {}
  void keep_reaching(const program::PartTable& table, const Box& where, std::vector<uint32_t>& parts) override;

 private:
  const program::Program& question(const program::PartTable& table, uint32_t body);
  void ask(const program::PartTable& table, uint32_t body, const Box& where);

  BoxIntervals intervals_;
  std::map<std::pair<const program::PartTable*, uint32_t>, program::Program> questions_;  // programs by table and body
  std::vector<uint32_t> bodies_, together_, reaching_;
  std::vector<Box> boxes_;
};

}  // namespace ombre::eval
