// Reads grids of numbers by the content of their files.
#include "formats/volumes/volume_formats.h"
#include "formats/volumes/volume_packing.h"
#include "formats/volumes/volume_parts.h"

namespace ombre::formats {
namespace {

constexpr uint64_t most_unpacked_bytes = uint64_t{64} << 30;

VoxelVolume read_packed(const VolumeFile& file) {
  // The size stated at the end of the file is correct up to 4 GiB.
  check_room(file.path, std::max(file.bytes.size(), stated_gzip_size(file.bytes)));
  std::vector<std::string> warnings;
  const auto all =
      std::make_shared<const std::string>(unpacked_file(file.path, file.bytes, most_unpacked_bytes, warnings));
  if (is_gzip(*all)) fail_volume(file.path, "is packed twice by gzip; unpack it");
  VolumeFile inner = file;
  inner.bytes = *all;
  VoxelVolume volume = read_volume(inner);
  if (!volume.in_file.empty() && !volume.file) volume.file = all;
  volume.warnings.insert(volume.warnings.begin(), warnings.begin(), warnings.end());
  return volume;
}

}  // namespace

std::string companion_of(const std::string& path, std::string_view bytes) {
  const VolumeFormat& format = format_of_volume(bytes);
  return format.companion ? format.companion(path, bytes) : "";
}

std::vector<VolumeSegment> segments_of(const std::string& path, std::string_view bytes) {
  const VolumeFormat& format = format_of_volume(bytes);
  return format.segments ? format.segments(path, bytes) : std::vector<VolumeSegment>();
}

namespace {

VoxelVolume read_any(const VolumeFile& file) {
  if (const VolumeFormat& format = format_of_volume(file.bytes); format.read) return format.read(file);
  if (is_gzip(file.bytes)) return read_packed(file);
  if (file.companion) return read_raw(file);
  fail_volume(file.path, "is none of NRRD, NIfTI, MetaImage, VTI and NPY, and no " + file.path +
                             ".json describes it; convert other formats, by 3D Slicer for example");
}

}  // namespace

VoxelVolume read_volume(const VolumeFile& file) {
  VoxelVolume volume = read_any(file);
  settle_numbers(file.path, file.choice.nan, volume);
  return volume;
}

}  // namespace ombre::formats
