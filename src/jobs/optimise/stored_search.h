// A search as a job whose pieces are stored: the designs that it measures, and search.json.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "jobs/optimise/optimise_choices.h"
#include "jobs/optimise/optimise_study.h"
#include "stores/job_key.h"
#include "stores/stored_job.h"

namespace ombre::compile {

inline constexpr const char* search_file = "search.json";

// Returns what a search depends on, whatever number of designs it may measure. `data` is the study's.
stores::JobKey search_key(const OptimiseChoices& choices, const Data& data, const OptimiseStudy& study,
                          const std::string& program);

class StoredSearch : public stores::KeyedJob {
 public:
  StoredSearch(const OptimiseStudy& study, stores::JobKey key) : KeyedJob(std::move(key)), study_(study) {}

  const stores::JobWords& words() const override;
  std::string description(const stores::Entries& finished) const override;
  // A search may always go on, and is complete whenever it ends.
  bool is_complete(const stores::Entries&) const override { return true; }
  void check_same(const std::string& folder, const DataMembers& there) const override;
  bool accepts(const stores::Entry& entry) const override;
  bool owns(std::string_view) const override { return false; }
  std::optional<stores::NameTest> files_of(const Data& description) const override;

 private:
  const OptimiseStudy& study_;
};

}  // namespace ombre::compile
