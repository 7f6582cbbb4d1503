// Frames of a design that turns, as a job whose pieces are stored.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "stores/job_key.h"
#include "stores/stored_job.h"

namespace ombre::compile {

const stores::JobWords& frame_words();

class StoredFrames : public stores::StoredJob {
 public:
  // The key has all that the pictures depend on.
  StoredFrames(int count, stores::JobKey key) : count_(count), key_(std::move(key)) {}

  // Returns the name of a frame's file, frame_007.png, with as many digits as the last frame needs.
  std::string file_name(int64_t frame) const;

  const stores::JobWords& words() const override { return frame_words(); }
  std::string description(const stores::Entries& finished) const override;
  bool is_complete(const stores::Entries& finished) const override {
    return finished.size() == static_cast<size_t>(count_);
  }
  void check_same(const std::string& folder, const DataMembers& there) const override;
  bool accepts(const stores::Entry& entry) const override;
  bool owns(std::string_view name) const override;
  bool is_kind(const Data& description) const override;
  std::optional<stores::NameTest> files_of(const Data& description) const override;

 private:
  int count_;
  stores::JobKey key_;
};

// Returns the frame's number with as many digits as that of the last one of so many.
std::string frame_number(int64_t frame, int count);

}  // namespace ombre::compile
