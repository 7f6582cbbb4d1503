// A sweep as a job whose pieces are stored: its cases, sweep.json, and a table for people.
#pragma once

#include <string>
#include <string_view>

#include "jobs/sweep_cases.h"
#include "stores/store.h"
#include "stores/stored_job.h"

namespace ombre::jobs {

const stores::JobWords& sweep_words();

class StoredSweep : public stores::KeyedJob {
 public:
  // The key has all that the cases depend on.
  StoredSweep(const SweepCases& cases, stores::JobKey key) : KeyedJob(std::move(key)), cases_(cases) {}

  // Returns the beginning of the names of a case's files, case_07_, with as many digits as the last case needs.
  std::string file_prefix(int64_t number) const;
  // Returns the table: a row for each case, a column for each number that some case gave.
  std::string table(const stores::Entries& finished) const;

  const stores::JobWords& words() const override { return sweep_words(); }
  std::string description(const stores::Entries& finished) const override;
  bool is_complete(const stores::Entries& finished) const override {
    return static_cast<int64_t>(finished.size()) == cases_.count();
  }
  bool accepts(const stores::Entry& entry) const override;
  bool owns(std::string_view name) const override;
  std::optional<stores::NameTest> files_of(const Data& description) const override;

 private:
  const SweepCases& cases_;
};

}  // namespace ombre::jobs
