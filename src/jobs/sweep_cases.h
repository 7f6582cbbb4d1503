// The cases of a sweep: one job with each choice of values for some of its options and of its design's variables.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "jobs/saved_job.h"

namespace ombre::jobs {

// An option or a variable with its values. Empty values are not there.
struct Varied {
  std::string name;  // "cell", or "wall" of a variable
  bool is_variable = false;
  std::vector<std::string> values;
};

// Reads NAME=V1,V2. Commas within brackets belong to a value. Brackets around the value of an option are left out, so
// that [0.1,0.1,0.05] is a voxel. Throws WrongArgument.
Varied parse_varied(const std::string& text, bool is_variable);

class SweepCases {
 public:
  // Throws WrongArgument if the job has no such option, or there are more cases than a sweep may have.
  SweepCases(SavedJob job, std::vector<Varied> varied);

  int64_t count() const { return count_; }
  const SavedJob& job() const { return job_; }
  const std::vector<Varied>& varied() const { return varied_; }
  // Returns the values of a case, in the order of varied(). Those of the last one change first.
  std::vector<std::string> values(int64_t number) const;
  // Returns the job of a case.
  SavedJob job_of(int64_t number) const;
  // Returns "wall = 0.5, cell = 0.1".
  std::string name_of(int64_t number) const;

 private:
  SavedJob job_;
  std::vector<Varied> varied_;
  int64_t count_ = 1;
};

}  // namespace ombre::jobs
