// Converts layers of a slice job from and to the entries of its journal.
#include "jobs/slice/layer_entry.h"

#include <algorithm>
#include <functional>

namespace ombre::compile {
namespace {

std::optional<std::vector<uint64_t>> wholes(const Data* data) {
  if (!data || !data->list()) return std::nullopt;
  std::vector<uint64_t> values;
  for (const Data& element : *data->list()) {
    const std::optional<uint64_t> value = stores::whole_number(&element);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

DataList list_of(const std::vector<uint64_t>& counts) {
  DataList list;
  for (const uint64_t count : counts) list.push_back(number(count));
  return list;
}

// Adds a check of the journal: [check, voxels, i, j, k] of the first voxel. Returns false if it is none of the job's.
bool add_check(const Data& check, std::vector<voxel::CheckHits>& checks) {
  const auto values = wholes(&check);
  if (!values || values->size() != 5 || (*values)[0] >= checks.size()) return false;
  voxel::CheckHits& hits = checks[(*values)[0]];
  hits.count = (*values)[1];
  for (size_t axis = 0; axis < 3; ++axis) hits.first[axis] = static_cast<int64_t>((*values)[2 + axis]);
  return true;
}

}  // namespace

bool VoxelCounts::is_empty() const {
  return std::all_of(voxels.begin(), voxels.end(), [](uint64_t count) { return count == 0; });
}

void VoxelCounts::add(const VoxelCounts& other) {
  std::ranges::transform(voxels, other.voxels, voxels.begin(), std::plus());
  std::ranges::transform(shades, other.shades, shades.begin(), std::plus());
}

DataMembers record_of(const LayerEntry& layer) {
  DataList checks;
  for (size_t i = 0; i < layer.checks.size(); ++i) {
    const voxel::CheckHits& hits = layer.checks[i];
    if (hits.count == 0) continue;
    checks.emplace_back(
        DataList{number(i), number(hits.count), number(hits.first[0]), number(hits.first[1]), number(hits.first[2])});
  }
  DataMembers record{{"voxels", list_of(layer.counts.voxels)}};
  if (!layer.counts.shades.empty()) record.emplace_back("shades", list_of(layer.counts.shades));
  if (!checks.empty()) record.emplace_back("checks", checks);
  return record;
}

std::optional<LayerEntry> layer_of(const stores::Entry& entry, const LayerSizes& sizes) {
  const Data record(entry.record);
  const auto voxels = wholes(record.find("voxels"));
  const auto shades = record.find("shades") ? wholes(record.find("shades")) : std::vector<uint64_t>();
  if (!voxels || voxels->size() != sizes.voxels || !shades || shades->size() != sizes.shades) return std::nullopt;
  LayerEntry layer{entry.id, entry.files, {*voxels, *shades}, std::vector<voxel::CheckHits>(sizes.checks)};
  if (const Data* checks = record.find("checks"); checks && checks->list())
    for (const Data& check : *checks->list())
      if (!add_check(check, layer.checks)) return std::nullopt;
  return layer;
}

std::vector<LayerEntry> parse_layers(std::string_view journal, const LayerSizes& sizes) {
  const auto accepts = [&](const stores::Entry& entry) { return layer_of(entry, sizes).has_value(); };
  std::vector<LayerEntry> layers;
  for (const auto& [id, entry] : stores::parse_journal(layer_member, journal, accepts))
    layers.push_back(*layer_of(entry, sizes));
  return layers;
}

}  // namespace ombre::compile
