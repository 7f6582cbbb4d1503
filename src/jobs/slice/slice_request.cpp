// Small conversions into a slice request.
#include "jobs/slice/slice_request.h"
#include "voxel/image_kinds.h"

namespace ombre::compile {

bool Sampling::has_materials() const {
  return !channels.empty() && channels.front().type == voxel::ChannelType::material;
}

void use_printer(SliceRequest& request, const voxel::Printer& printer, std::optional<ImageFormat> image) {
  request.printer = printer.name;
  static_cast<voxel::Images&>(request) = printer;
  if (image) request.format = *image;
  for (const voxel::Channel& channel : request.channels)
    request.format = voxel::format_for(channel.type, request.format);
  const bool has_masks = request.format == ImageFormat::mask && request.has_materials();
  if (has_masks || request.channels.size() > 1) request.files = request.files.with_material();
}

LayerProducer whole_layers(RegionProducer regions, const voxel::Lattice& lattice) {
  return [regions = std::move(regions), count = lattice.count](int64_t begin, int64_t end, const StopFlag* stop) {
    return regions({{0, 0, begin}, {count[0], count[1], end}}, stop);
  };
}

}  // namespace ombre::compile
