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
  // `materials` are the names of the job's materials, without void.
  LayerFiles(const voxel::NamePattern& files, const std::vector<std::string>& materials, int64_t first_index,
             int64_t layer_count);

  // Returns the names of one layer's files: one name, or one for each material, in their order.
  std::vector<std::string> names(int64_t layer) const;
  // True if a file of some layer has this name.
  bool contains(std::string_view name) const;

 private:
  std::vector<voxel::NamePattern> patterns_;
  int64_t first_index_ = 0, layer_count_ = 0;
};

// Returns the names of the job's materials, without void.
std::vector<std::string> material_names(const SliceRequest& request);

// Returns the words that stand for materials in the names of files: letters, digits, '-' and '_', each word once.
std::vector<std::string> file_words(const std::vector<std::string>& materials);

}  // namespace ombre::compile
