// A slice stack as it lies in a folder: its description, its journals and the names of its files.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "jobs/slice/job_reader.h"
#include "jobs/slice/layer_files.h"
#include "jobs/stacks/findings.h"
#include "stores/journal.h"

namespace ombre::compile {

struct Stack {
  std::string folder;
  DescribedJob job;
  LayerFiles files;
  std::set<std::string> names;  // of all files in the folder
  bool has_journal = false;
  stores::Entries entries;  // of the layers that the journals name

  const SliceRequest& request() const { return job.request; }
  int64_t layer_count() const { return job.request.lattice.count[2]; }
  std::string path(const std::string& name) const;
};

// Opens the stack in a folder, and adds what is wrong with its journals. Throws Error if the folder or its job.json
// cannot be read.
Stack open_stack(const std::string& folder, Findings& findings);

}  // namespace ombre::compile
