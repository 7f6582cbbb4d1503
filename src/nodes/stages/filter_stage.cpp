#include "nodes/stages/filter_stage.h"

#include <algorithm>

#include "base/text/text.h"

namespace ombre::nodes {

using design::StageChannel;

std::vector<design::StageRead> FilterStage::reads() const {
  return {{.solid = solid_, .inside = true, .fractions = use_.materials, .attributes = use_.attributes}};
}

std::vector<StageChannel> FilterStage::channels(const std::vector<StageChannel>& read) const {
  std::vector<StageChannel> made;
  const auto add = [&](MaterialId material) {
    made.push_back({sum_channel(material), material, 0, false, material_range()});
  };
  for (const StageChannel& channel : read)
    if (channel.material) add(*channel.material);
  const auto is_void = [](const StageChannel& channel) { return channel.material == void_material; };
  if (use_.count_void && std::ranges::none_of(made, is_void)) add(void_material);
  made.push_back({"share", {}, 0, false, share_range()});
  for (const std::string& name : use_.attributes) made.push_back({"attribute " + name, {}, 0, false});
  return made;
}

Hash FilterStage::hash_with(const std::string& key) const {
  std::string text = key + (use_.materials ? " materials" : "") + (use_.count_void ? " void" : "");
  for (const std::string& name : use_.attributes) text += " \"" + name + '"';
  return hash_bytes(text);
}

}  // namespace ombre::nodes
