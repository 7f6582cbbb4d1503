// Runs of equal values along the columns of a lattice.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/stage.h"

namespace ombre::compile {

class ColumnTable final : public design::ColumnRuns {
 public:
  ColumnTable() = default;
  ColumnTable(const IndexBox& cells, size_t channels) : cells_(cells), channels_(channels) {}

  // Bytes that runs may take; beyond them add() throws Error, in whose message `what` they are.
  void set_limit(double bytes, std::string what);
  void add(size_t channel, int64_t i, int64_t j, int64_t bottom, int64_t top, float value) override;
  // Puts the runs in order; from then on values can be read.
  void finish();

  double bytes() const;
  float at(size_t channel, int64_t i, int64_t j, int64_t k) const;
  // `otherwise` where looking takes too long.
  Interval range(size_t channel, const IndexBox& cells, Interval otherwise) const;

 private:
  struct Run {
    int32_t bottom = 0, top = 0;
    float value = 0;
  };
  struct Added {
    uint32_t column = 0;
    Run run;
  };
  struct Channel {
    std::vector<Added> added;
    std::vector<uint32_t> first;  // of each column's runs, and their end
    std::vector<Run> runs;        // of a column from below
  };
  size_t columns() const { return static_cast<size_t>(cells_.size(0) * cells_.size(1)); }
  void put_in_order(Channel& channel) const;
  std::span<const Run> column(size_t channel, int64_t i, int64_t j) const;

  IndexBox cells_;
  std::vector<Channel> channels_;
  std::optional<double> limit_;
  double added_bytes_ = 0;
  std::string what_;
};

}  // namespace ombre::compile
