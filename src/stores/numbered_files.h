// A job whose pieces are files with numbers in their names.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "stores/stored_job.h"

namespace ombre::stores {

class NumberedFiles final : public KeyedJob {
 public:
  // `words` outlive the job. The key has all that the pieces depend on.
  NumberedFiles(const JobWords& words, int64_t count, JobKey key)
      : KeyedJob(std::move(key)), words_(words), count_(count) {}

  // Returns the name of a piece's file, frame_007.png, with as many digits as the last piece needs.
  std::string file_name(int64_t id) const { return name_of(id, count_); }

  const JobWords& words() const override { return words_; }
  std::string description(const Entries& finished) const override;
  bool is_complete(const Entries& finished) const override { return static_cast<int64_t>(finished.size()) == count_; }
  bool accepts(const Entry& entry) const override;
  bool owns(std::string_view name) const override { return is_piece(name, count_); }
  std::optional<NameTest> files_of(const Data& description) const override;

 private:
  std::string name_of(int64_t id, int64_t count) const;
  bool is_piece(std::string_view name, int64_t count) const;

  const JobWords& words_;
  int64_t count_;
};

}  // namespace ombre::stores
