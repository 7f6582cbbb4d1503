// Names of the files of a job's layers.
#include "jobs/slice/layer_files.h"

#include <algorithm>
#include <set>

#include "base/text/text.h"

namespace ombre::compile {
namespace {

constexpr size_t longest_word = 60;

std::string file_word(const std::string& name) {
  std::string word = name.substr(0, longest_word);
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  std::replace_if(
      word.begin(), word.end(), [&](char c) { return !plain(c); }, '_');
  if (word.starts_with('-')) word[0] = '_';  // commands would take it for an option
  return word;
}

}  // namespace

std::vector<std::string> shown_names(const SliceRequest& request) {
  std::vector<std::string> names;
  for (const SliceMaterial& material : request.materials) names.push_back(material.name);
  for (const voxel::Channel& channel : request.channels)
    if (channel.type != voxel::ChannelType::material) names.push_back(channel.name);
  return names;
}

std::vector<std::string> file_words(const std::vector<std::string>& shown) {
  std::vector<std::string> words;
  std::set<std::string> taken;  // in lower case, since some file systems ignore case
  for (const std::string& name : shown) {
    const std::string word = file_word(name);
    std::string free = word;
    for (int n = 2; !taken.insert(to_lower(free)).second; ++n) free = word + "-" + std::to_string(n);
    words.push_back(free);
  }
  return words;
}

LayerFiles::LayerFiles(const SliceRequest& request)
    : LayerFiles(request.files, shown_names(request), request.first_index, request.lattice.count[2]) {}

LayerFiles::LayerFiles(const voxel::NamePattern& files, const std::vector<std::string>& shown, int64_t first_index,
                       int64_t layer_count)
    : first_index_(first_index), layer_count_(layer_count) {
  if (!files.has_material()) {
    patterns_ = {files};
    return;
  }
  for (const std::string& word : file_words(shown)) patterns_.push_back(files.of_material(word));
}

std::vector<std::string> LayerFiles::names(int64_t layer) const {
  std::vector<std::string> names;
  for (const voxel::NamePattern& pattern : patterns_) names.push_back(pattern.name(first_index_ + layer));
  return names;
}

bool LayerFiles::contains(std::string_view name) const {
  return std::any_of(patterns_.begin(), patterns_.end(), [&](const voxel::NamePattern& pattern) {
    const std::optional<int64_t> index = pattern.index(name);
    return index && *index >= first_index_ && *index - first_index_ < layer_count_;
  });
}

}  // namespace ombre::compile
