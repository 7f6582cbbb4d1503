// The designs that a search has measured: pieces of its store, and a table for people.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "jobs/optimise/optimise_job.h"
#include "stores/store.h"

namespace ombre::compile {

class History {
 public:
  struct Row {
    int64_t number = 0;  // in the order of the search, from 1
    std::vector<double> values;
    Measured measured;
  };

  explicit History(const OptimiseStudy& study) : study_(study) {}

  // Adds the designs that a store has.
  void read(const stores::Entries& finished);
  const Row* find(const std::vector<double>& values) const;
  // Adds a design with the least free number, so that a repeated search fills gaps with what was there.
  const Row& add(std::vector<double> values, Measured measured);
  size_t size() const { return rows_.size(); }
  // Returns the designs by their numbers. The pointers are valid as long as the history.
  std::vector<const Row*> rows() const;

  // Returns the design as a piece without files.
  static stores::Piece piece(const Row& row);

  // Return lines of comma-separated values.
  std::string header() const;
  std::string line(const Row& row) const;
  std::string table() const;

 private:
  const OptimiseStudy& study_;
  std::map<int64_t, Row> rows_;
  int64_t free_ = 1;  // all lesser numbers are taken
  std::map<std::vector<double>, int64_t> numbers_;
};

// Returns the design of an entry; nothing if it is not one of the study.
std::optional<History::Row> measured_design(const stores::Entry& entry, const OptimiseStudy& study);

}  // namespace ombre::compile
