// Reads grids of raw numbers, and the descriptions beside them.
#include "base/text/json.h"
#include "base/text/record.h"
#include "base/text/text.h"
#include "formats/volumes/volume_parts.h"

namespace ombre::formats {
namespace {

// A field that may only say how our arrays lie in files.
Field<VolumeDescription> fixed(const std::string& name, const Data& only) {
  return {name, [=](VolumeDescription&, const Data& data, const MemberReader& reader) {
            if (data != only) reader.fail_expected(data, print_json_line(only) + " for \"" + name + '"');
          }};
}

void read_space(VolumeDescription& description, const Data& data, const MemberReader& reader) {
  const auto space = data.string() ? space_called(to_lower(*data.string())) : std::nullopt;
  if (!space) return reader.fail_expected(data, R"("RAS", "LPS" or "LAS" for "space")");
  description.space = *space;
}

const Record<VolumeDescription>& description_record() {
  using D = VolumeDescription;
  constexpr double most = 1e15, most_channels = 1000;
  static const Record<D> record =
      Record<D>("a description of numbers",
                {field::text("data_type", &D::type),
                 field::numbers("dimensions", &D::count, "[x, y, z], how many voxels there are", {1, most, true}),
                 field::choice("byte_order", &D::is_big_endian, {"little", "big"}),
                 field::whole("header_bytes", &D::header_bytes, 0, most),
                 field::whole("channels", &D::channels, 1, most_channels), fixed("axes", DataList{"x", "y", "z"}),
                 fixed("fastest_axis", "x"), field::special("space", read_space),
                 field::numbers("spacing_mm", &D::spacing_mm, "[x, y, z] in mm", above_zero),
                 field::numbers("origin_mm", &D::origin_mm, "[x, y, z] in mm")})
          .open();
  return record;
}

}  // namespace

VolumeDescription read_description(const std::string& path, const std::string& json) {
  Diagnostics diagnostics;
  const auto data = parse_json(make_source(path + ".json", json), diagnostics);
  VolumeDescription description;
  if (!data || !description_record().read(*data, description, MemberReader(diagnostics)))
    fail_volume(path, "has a wrong description: " + placed_sentence_of(diagnostics.list().front()));
  if (description.spacing_mm)
    description.space_from_index = placed_along_axes(path, *description.spacing_mm, description.origin_mm);
  return description;
}

VoxelVolume read_raw(const VolumeFile& file) {
  const std::string& path = file.path;
  std::string_view bytes = file.bytes;
  const VolumeDescription description = read_description(path, std::string(*file.companion));
  if (description.type.empty() || !description.count)
    fail_volume(path, "has a description without \"data_type\" or \"dimensions\"");
  VoxelVolume volume;
  volume.type = description.type;
  volume.values = values_of_type(path, description.type);
  volume.count = *description.count;
  volume.space_from_index = description.space_from_index;
  volume.space = description.space;
  const uint64_t size =
      voxel_bytes(path, volume.count, bytes_per_value(volume.values)) * static_cast<uint64_t>(description.channels);
  bytes.remove_prefix(std::min<uint64_t>(description.header_bytes, bytes.size()));
  if (bytes.size() > size)
    fail_volume(path, "has " + format_count(bytes.size()) + " bytes, where its description has numbers of " +
                          format_count(size));
  const Channel channel = chosen_channel(file, description.channels, false);
  take_numbers(file, bytes, description.is_big_endian, channel, volume);
  return volume;
}

}  // namespace ombre::formats
