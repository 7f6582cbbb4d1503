// Keeps the values of a slice job's stages beside its layers until the job is complete, so that a resumed run, or
// processes that share the job, do not compute them again.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "stages/stage_keeper.h"
#include "stores/folder_store.h"
#include "stores/journal_folder.h"

namespace ombre::compile {

class StoredStages : public StageKeeper {
 public:
  // `job_folder` is the folder of the layers. Nothing is read or written before the first find() or keep().
  StoredStages(const std::string& job_folder, stores::FolderUse use, stores::Checking checking);
  ~StoredStages() override;

  // Both throw Error if the folder cannot be used.
  std::optional<std::string> find(const Hash& made_from) override;
  void keep(const Hash& made_from, std::string values) override;
  // Removes the files, whose job is complete.
  void remove();

 private:
  class Job;

  stores::FolderStore& store();

  std::string folder_;
  stores::FolderUse use_;
  stores::Checking checking_;
  std::unique_ptr<const Job> job_;
  std::unique_ptr<stores::FolderStore> store_;
};

// Finds what a StoredStages has kept, also while other processes do. It keeps nothing.
class SharedStages : public StageKeeper {
 public:
  SharedStages(const std::string& job_folder, stores::Checking checking);

  std::optional<std::string> find(const Hash& made_from) override;
  void keep(const Hash&, std::string) override {}

 private:
  std::string folder_;
  stores::Checking checking_;
  std::optional<stores::Entries> kept_;  // once they are read
};

}  // namespace ombre::compile
