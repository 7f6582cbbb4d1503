// Names of the files of a job's layers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/slice/slice_request.h"

namespace ombre::compile {

class LayerFiles {
 public:
  explicit LayerFiles(const SliceRequest& request);
  // `shown` are the names of what has images: of the job's materials, without void, and of its other channels.
  LayerFiles(const voxel::NamePattern& files, const std::vector<std::string>& shown, int64_t first_index,
             int64_t layer_count);

  // Returns the names of one layer's files: one name, or one for each of what is shown, in their order.
  std::vector<std::string> names(int64_t layer) const;
  // True if a file of some layer has this name.
  bool contains(std::string_view name) const;

 private:
  std::vector<voxel::NamePattern> patterns_;
  int64_t first_index_ = 0, layer_count_ = 0;
};

// Returns the names of the job's materials, without void, and of its other channels.
std::vector<std::string> shown_names(const SliceRequest& request);

// Returns the words that stand for these names in the names of files: letters, digits, '-' and '_', each word once.
std::vector<std::string> file_words(const std::vector<std::string>& shown);

}  // namespace ombre::compile
