// Runs of equal values along the columns of a lattice.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "design/stage.h"

namespace ombre::compile {

class ColumnTable final : public design::ColumnRuns {
 public:
  ColumnTable() = default;
  ColumnTable(const IndexBox& cells, size_t channels) : cells_(cells), channels_(channels) {}

  // Limits the bytes that runs may take. Beyond the limit add() throws Error, whose message begins with `what`.
  void set_limit(double bytes, std::string what);
  void add(size_t channel, int64_t i, int64_t j, int64_t bottom, int64_t top, float value) override;
  // Puts the runs in order; after that values can be read.
  void finish();

  // Returns the runs, which must be in order, as bytes.
  std::string pack() const;
  // Sets the runs by the bytes of a table with the same cells and channels. Returns false if they are of another one.
  bool unpack(std::string_view bytes);

  double bytes() const;
  float at(size_t channel, int64_t i, int64_t j, int64_t k) const;
  // Returns `otherwise` if the search would take too long.
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
    std::vector<uint32_t> first;  // index of the first run of each column; the last entry is the count of runs
    std::vector<Run> runs;        // runs of each column from below
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
