// Reads grids of numbers by the content of their files.
#include "formats/volumes/volume_packing.h"
#include "formats/volumes/volume_parts.h"

namespace ombre::formats {
namespace {

constexpr uint64_t most_unpacked_bytes = uint64_t{64} << 30;

bool is_nrrd(std::string_view bytes) { return bytes.starts_with("NRRD"); }
bool is_npy(std::string_view bytes) { return bytes.starts_with("\x93NUMPY"); }

}  // namespace

std::string companion_of(const std::string& path, std::string_view bytes) {
  if (is_nrrd(bytes)) return nrrd_data_path(path, bytes);
  if (is_nifti(bytes)) return nifti_data_path(path, bytes);
  if (is_metaimage(bytes)) return metaimage_data_path(path, bytes);
  if (is_vti(bytes)) return "";
  return path + ".json";
}

std::vector<VolumeSegment> segments_of(const std::string& path, std::string_view bytes) {
  return is_nrrd(bytes) ? nrrd_segments(path, bytes) : std::vector<VolumeSegment>();
}

namespace {

VoxelVolume read_packed(const VolumeFile& file) {
  // The size stated at the end of the file is correct up to 4 GiB.
  check_room(file.path, std::max(file.bytes.size(), stated_gzip_size(file.bytes)));
  const auto all = std::make_shared<const std::string>(unpacked_file(file.path, file.bytes, most_unpacked_bytes));
  if (is_gzip(*all)) fail_volume(file.path, "is packed twice by gzip; unpack it");
  VolumeFile inner = file;
  inner.bytes = *all;
  VoxelVolume volume = read_volume(inner);
  if (!volume.in_file.empty() && !volume.file) volume.file = all;
  return volume;
}

}  // namespace

VoxelVolume read_volume(const VolumeFile& file) {
  const std::string_view bytes = file.bytes;
  if (is_nrrd(bytes)) return read_nrrd(file);
  if (is_npy(bytes)) return read_npy(file);
  if (is_nifti(bytes)) return read_nifti(file);
  if (is_metaimage(bytes)) return read_metaimage(file);
  if (is_vti(bytes)) return read_vti(file);
  if (is_gzip(bytes)) return read_packed(file);
  if (file.companion) return read_raw(file);
  fail_volume(file.path, "is none of NRRD, NIfTI, MetaImage, VTI and NPY, and no " + file.path +
                             ".json describes it; convert other formats, by 3D Slicer for example");
}

}  // namespace ombre::formats
