#include "jobs/slice/slice_choices.h"

#include <filesystem>

#include "base/text/text.h"
#include "jobs/slice/plan.h"

namespace ombre::compile {

std::string SliceChoices::output_folder() const {
  return folder.empty() ? std::filesystem::path(design.design).stem().string() + "_slices" : folder;
}

FolderUse SliceChoices::folder_use() const {
  if (force) return FolderUse::replace;
  return resume ? FolderUse::resume : FolderUse::fresh;
}

std::optional<LayerRange> chosen_layers(const std::string& wanted, int64_t count) {
  if (wanted.empty()) return std::nullopt;
  if (const auto layers = parse_layer_range(wanted, count)) return layers;
  throw options::WrongValue(spelled::option("--layers", wanted) + " selects none of the " +
                            format_count(static_cast<unsigned long long>(count)) + " layers, which are 0:" +
                            std::to_string(count) + "; write for example " + spelled::option("--layers", "0:10"));
}

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
  options.layers = chosen_layers(choices.layers, count);
  if (options.shard) options.layers = share_of(options.layers.value_or(LayerRange{0, count}), *options.shard);
  return options;
}

}  // namespace ombre::compile
