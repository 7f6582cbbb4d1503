// The questions that a store of files has for the job whose pieces it keeps.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/data.h"
#include "stores/job_key.h"
#include "stores/journal.h"

namespace ombre::stores {

// The names of a kind of job, for files and for messages.
struct JobWords {
  std::string kind;              // "slice job"
  std::string format;            // "ombre slice job", the beginning of the description's member of that name
  std::string pieces;            // "layers"
  std::string description_file;  // "job.json"
  std::string id_name;           // "layer", the member of a journal's line that has the number of the piece
  std::string file_ending;       // ".png", of the files of all pieces; may be empty
};

// True for names of files of pieces.
using NameTest = std::function<bool(std::string_view name)>;

class StoredJob {
 public:
  virtual ~StoredJob() = default;

  virtual const JobWords& words() const = 0;
  // Returns the text of the description: everything that decides the job's pieces, and what is known of them all once
  // none is missing.
  virtual std::string description(const Entries& finished) const = 0;
  virtual bool is_complete(const Entries& finished) const = 0;
  // Throws if the description that lies in the folder is of another job.
  virtual void check_same(const std::string& folder, const DataMembers& there) const = 0;
  // True if the entry can be of this job: its number, the names of its files, its record.
  virtual bool accepts(const Entry& entry) const = 0;
  // True if a piece of this job may have a file with this name.
  virtual bool owns(std::string_view name) const = 0;

  // Returns names and bytes of files that an archive with this ending has besides those of pieces and the description.
  virtual std::vector<std::pair<std::string, std::string>> further_files(const std::string& ending,
                                                                         const Entries& finished) const {
    (void)ending, (void)finished;
    return {};
  }

  // True if the description was written by a job of this kind.
  bool is_kind(const Data& description) const;
  // Returns the names of the files of the job that is described; nothing if the description does not tell.
  virtual std::optional<NameTest> files_of(const Data& description) const = 0;
};

// A job whose description has the key of all that its pieces depend on.
class KeyedJob : public StoredJob {
 public:
  explicit KeyedJob(JobKey key) : key_(std::move(key)) {}

  void check_same(const std::string& folder, const DataMembers& there) const override;

 protected:
  // Returns in which parts of the key a description differs, as JobKey::difference does.
  std::string difference(const DataMembers& there) const { return key_.difference(Data(there).find("key")); }
  // Returns the text of a description: the format, the members, and the key.
  std::string described(DataMembers members) const;

 private:
  JobKey key_;
};

// Returns the number of a piece with as many digits as that of the last one of so many.
std::string piece_number(int64_t number, int64_t count);

}  // namespace ombre::stores
