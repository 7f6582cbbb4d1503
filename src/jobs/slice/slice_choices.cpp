#include "jobs/slice/slice_choices.h"

#include <charconv>
#include <filesystem>

#include "base/text/text.h"
#include "jobs/slice/plan.h"

namespace ombre::compile {

stores::Shard parse_shard(const std::string& text, const std::string& option) {
  const size_t slash = text.find('/');
  stores::Shard shard{0, 0};
  if (slash != std::string::npos) {
    const char *begin = text.data(), *middle = begin + slash, *end = begin + text.size();
    const bool is_read = std::from_chars(begin, middle, shard.number).ptr == middle &&
                         std::from_chars(middle + 1, end, shard.count).ptr == end;
    if (is_read && shard.number >= 1 && shard.number <= shard.count && shard.count <= stores::most_shards) return shard;
  }
  throw options::WrongValue(spelled::option(option, text) + " is no share of a job; write for example " +
                            spelled::option(option, "3/40") + ", the third of forty");
}

std::string SliceChoices::output_folder() const {
  return folder.empty() ? std::filesystem::path(design.design).stem().string() + "_slices" : folder;
}

FolderUse SliceChoices::folder_use() const {
  if (force) return FolderUse::replace;
  return resume ? FolderUse::resume : FolderUse::fresh;
}

namespace {

// Returns nothing where all layers are wanted.
std::optional<LayerRange> chosen_layers(const SliceChoices& choices, int64_t count) {
  if (choices.layers.empty()) return std::nullopt;
  if (const auto layers = parse_layer_range(choices.layers, count)) return layers;
  throw options::WrongValue(spelled::option("--layers", choices.layers) + " selects none of the " +
                            format_count(static_cast<unsigned long long>(count)) + " layers, which are 0:" +
                            std::to_string(count) + "; write for example " + spelled::option("--layers", "0:10"));
}

}  // namespace

SliceOptions slice_options(const SliceChoices& choices, const Plan& plan) {
  SliceOptions options;
  options.folder = choices.output_folder();
  options.use = choices.folder_use();
  options.threads = choices.work.threads;
  options.memory_bytes = choices.work.memory_bytes;
  options.strict = choices.strict;
  options.stages = plan.stages;
  options.shard = choices.shard;
  const int64_t count = plan.request.lattice.count[2];
  options.layers = chosen_layers(choices, count);
  if (options.shard) options.layers = share_of(options.layers.value_or(LayerRange{0, count}), *options.shard);
  return options;
}

}  // namespace ombre::compile
