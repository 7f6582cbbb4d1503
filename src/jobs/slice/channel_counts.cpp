#include "jobs/slice/channel_counts.h"

#include <functional>

#include "base/text/text.h"

namespace ombre::compile {
namespace {

using voxel::Channel;
using voxel::ChannelType;

// A material or another channel, with what is counted of it.
struct Counted {
  std::string name;
  const Channel* channel = nullptr;  // null for a material
  uint64_t voxels = 0;
  std::optional<double> mean;  // of the counted voxels of a dose, in its unit
};

DataMembers describe(const Channel& channel) {
  const voxel::ChannelKind& kind = voxel::channel_kind(channel.type);
  DataMembers members{{"name", channel.name}, {"type", kind.name}};
  if (kind.last_shade == 0) return members;
  members.emplace_back("unit", channel.unit);
  members.emplace_back("range", DataList{channel.range.lo, channel.range.hi});
  if (channel.samples > 0) members.emplace_back("samples", number(channel.samples));
  return members;
}

double mean_of(const Channel& channel, uint64_t voxels, uint64_t shades) {
  return voxel::value_of_shade(channel, static_cast<double>(shades) / static_cast<double>(voxels));
}

// Calls `take` for each material and each other channel, in the order of the counts.
void for_all(const SliceRequest& request, const VoxelCounts& counts,
             const std::function<void(const Counted& counted)>& take) {
  size_t at = 0, dose = 0;
  for (const Channel& channel : request.channels) {
    if (channel.type == ChannelType::material) {
      for (const SliceMaterial& material : request.materials) take({material.name, nullptr, counts.voxels[at++], {}});
      continue;
    }
    Counted counted{channel.name, &channel, counts.voxels[at++], {}};
    if (voxel::channel_kind(channel.type).is_dose()) {
      const uint64_t shades = counts.shades[dose++];
      if (counted.voxels > 0) counted.mean = mean_of(channel, counted.voxels, shades);
    }
    take(counted);
  }
}

DataMembers describe(const Counted& counted, std::optional<double> voxel_mm3) {
  DataMembers members{{"name", counted.name}, {"voxels", number(counted.voxels)}};
  if (voxel_mm3) members.emplace_back("volume_mm3", static_cast<double>(counted.voxels) * *voxel_mm3);
  if (!counted.channel || !voxel::channel_kind(counted.channel->type).is_dose()) return members;
  members.emplace_back("mean", counted.mean ? Data(*counted.mean) : Data());
  members.emplace_back("unit", counted.channel->unit);
  return members;
}

std::string text_of(const Counted& counted, std::optional<double> voxel_mm3) {
  const ChannelType type = counted.channel ? counted.channel->type : ChannelType::material;
  std::string text = counted.name + ": " + format_count(counted.voxels) + ' ' + voxel::channel_kind(type).counted;
  if (voxel_mm3) text += ", " + format_rounded(static_cast<double>(counted.voxels) * *voxel_mm3) + " mm3";
  if (counted.mean) text += ", mean " + format_rounded(*counted.mean, 4);
  if (counted.mean && !counted.channel->unit.empty()) text += ' ' + counted.channel->unit;
  return text;
}

}  // namespace

LayerSizes layer_sizes(const SliceRequest& request) {
  LayerSizes sizes{0, 0, request.check_texts.size()};
  for (const Channel& channel : request.channels) {
    sizes.voxels += channel.type == ChannelType::material ? request.materials.size() : 1;
    sizes.shades += voxel::channel_kind(channel.type).is_dose() ? 1 : 0;
  }
  return sizes;
}

VoxelCounts count_voxels(const SliceRequest& request, const voxel::LayerResult& layer) {
  VoxelCounts counts;
  for (size_t i = 0; i < request.channels.size(); ++i) {
    if (request.channels[i].type == ChannelType::material) {
      const std::array<uint64_t, 256> of = count_materials(std::get<RunLayer>(layer.channels[i]));
      for (const SliceMaterial& material : request.materials) counts.voxels.push_back(of[material.id]);
      continue;
    }
    const voxel::PixelCount count = voxel::count_pixels(layer.channels[i]);
    counts.voxels.push_back(count.voxels);
    if (voxel::channel_kind(request.channels[i].type).is_dose()) counts.shades.push_back(count.shades);
  }
  return counts;
}

VoxelCounts no_counts(const SliceRequest& request) {
  const LayerSizes sizes = layer_sizes(request);
  return {std::vector<uint64_t>(sizes.voxels), std::vector<uint64_t>(sizes.shades)};
}

DataMembers describe_counts(const SliceRequest& request, const VoxelCounts& counts, std::optional<double> voxel_mm3) {
  DataList materials, channels;
  for_all(request, counts, [&](const Counted& counted) {
    (counted.channel ? channels : materials).emplace_back(describe(counted, voxel_mm3));
  });
  DataMembers members;
  if (request.has_materials()) members.emplace_back("materials", std::move(materials));
  if (!channels.empty()) members.emplace_back("channels", std::move(channels));
  return members;
}

std::vector<std::string> count_texts(const SliceRequest& request, const VoxelCounts& counts,
                                     std::optional<double> voxel_mm3) {
  std::vector<std::string> texts;
  for_all(request, counts, [&](const Counted& counted) { texts.push_back(text_of(counted, voxel_mm3)); });
  return texts;
}

DataList describe_channels(const SliceRequest& request) {
  DataList list;
  for (const Channel& channel : request.channels)
    if (channel.type != ChannelType::material) list.emplace_back(describe(channel));
  return list;
}

double voxel_mm3(const voxel::Lattice& lattice) {
  return lattice.pitch[0].mm() * lattice.pitch[1].mm() * lattice.pitch[2].mm();
}

}  // namespace ombre::compile
