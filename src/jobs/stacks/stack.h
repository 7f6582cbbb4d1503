// A slice stack as it lies in a folder or an archive: its description, its journals and the names of its files.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "jobs/slice/job_reader.h"
#include "jobs/slice/layer_files.h"
#include "jobs/stacks/findings.h"
#include "stores/journal.h"
#include "stores/stored_files.h"

namespace ombre::compile {

struct Stack {
  std::string folder;  // or the archive
  stores::StoredFilesPtr stored;
  DescribedJob job;
  LayerFiles files;
  std::set<std::string> names;  // of all files in it
  bool has_journal = false;
  stores::Entries entries;  // of the layers that the journals name

  const SliceRequest& request() const { return job.request; }
  int64_t layer_count() const { return job.request.lattice.count[2]; }
  std::string read(const std::string& name) const { return stored->read(name); }
};

// Opens the stack in a folder or an archive, and adds what is wrong with its journals. Throws Error if that or its
// job.json cannot be read.
Stack open_stack(const std::string& folder, Findings& findings);

}  // namespace ombre::compile
