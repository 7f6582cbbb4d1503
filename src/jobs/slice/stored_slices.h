// A slice job as a job whose pieces are stored: its layers, job.json and the names of files.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/slice/layer_entry.h"
#include "jobs/slice/layer_files.h"
#include "jobs/slice/slice_request.h"
#include "stores/store.h"
#include "stores/stored_job.h"

namespace ombre::compile {

inline constexpr const char* job_file = "job.json";

const stores::JobWords& slice_words();

class StoredSlices : public stores::StoredJob {
 public:
  explicit StoredSlices(const SliceRequest& request) : request_(request), files_(request) {}

  // Returns the layer as a piece. Without images it has no files.
  stores::Piece piece(const LayerEntry& layer, std::vector<std::string> images) const;
  // Returns the layers that a store has.
  std::map<int64_t, LayerEntry> layers(const stores::Entries& finished) const;

  const stores::JobWords& words() const override { return slice_words(); }
  std::string description(const stores::Entries& finished) const override;
  bool is_complete(const stores::Entries& finished) const override;
  void check_same(const std::string& folder, const DataMembers& there) const override;
  bool accepts(const stores::Entry& entry) const override;
  std::vector<std::pair<std::string, std::string>> further_files(const std::string& ending,
                                                                 const stores::Entries& finished) const override;
  bool owns(std::string_view name) const override { return files_.contains(name); }
  std::optional<stores::NameTest> files_of(const Data& description) const override;

 private:
  std::optional<LayerEntry> layer_of(const stores::Entry& entry) const;

  const SliceRequest& request_;
  LayerFiles files_;
};

}  // namespace ombre::compile
