// Parts that the readers of grids share.
#pragma once

#include "base/text/error.h"
#include "formats/volumes/volume.h"

namespace ombre::formats {

[[noreturn]] inline void fail_volume(const std::string& path, const std::string& message) {
  throw Error(Code::file_content, "the volume \"" + path + "\" " + message, {{"file", path}});
}

// An empty list of that type ("uint8", "int16", "float", ...); throws Error for others.
VoxelValues values_of_type(const std::string& path, const std::string& type);
size_t bytes_per_value(const VoxelValues& values);

// All voxels' bytes, once the counts are found to be possible. Throws Error.
uint64_t voxel_bytes(const std::string& path, const std::array<int64_t, 3>& count, size_t bytes_per_value);

// Throws Error where so many bytes are more than the memory that is free. What is packed, say, becomes so large.
void check_room(const std::string& path, uint64_t bytes);

// One of several values in each voxel.
struct Channel {
  int64_t count = 1, chosen = 0;
  bool is_apart = false;  // all voxels' first values come first, not all values of the first voxel
};
// The one that the choice means. Throws Error where there are several and none is chosen, or too few.
Channel chosen_channel(const VolumeFile& file, int64_t count, bool is_apart);

// The numbers of the first bytes; the type is that of `values`. Throws Error where there are too few, or some are not
// finite.
void take_numbers(const VolumeFile& file, std::string_view bytes, bool is_big_endian, const Channel& channel,
                  VoxelVolume& volume);
// The same of bytes that are no longer needed.
void take_own_numbers(const VolumeFile& file, std::string bytes, bool is_big_endian, const Channel& channel,
                      VoxelVolume& volume);

// Lengths of a voxel and the first one's place, along the axes. Throws Error where nobody can mean them.
Affine placed_along_axes(const std::string& path, Vec3 spacing_mm, Vec3 origin_mm);
void check_placement(const std::string& path, const Affine& space_from_index);
void check_finite(const std::string& path, const VoxelVolume& volume);

// slope * number + intercept, as floats of 32 bits.
void rescale_numbers(const std::string& path, double slope, double intercept, VoxelVolume& volume);

bool is_nifti(std::string_view bytes);
VoxelVolume read_nifti(const VolumeFile& file);
std::string nifti_data_path(const std::string& path, std::string_view bytes);

bool is_metaimage(std::string_view bytes);
VoxelVolume read_metaimage(const VolumeFile& file);
std::string metaimage_data_path(const std::string& path, std::string_view bytes);

VoxelVolume read_nrrd(const VolumeFile& file);
// The path of the file that holds the numbers; empty where the header's own does.
std::string nrrd_data_path(const std::string& path, std::string_view bytes);
// Of the header's keys; none where it has no such keys.
std::vector<VolumeSegment> nrrd_segments(const std::string& path, std::string_view bytes);
VoxelVolume read_npy(const VolumeFile& file);
VoxelVolume read_raw(const VolumeFile& file);

// VTK's image data, whose arrays have names.
bool is_vti(std::string_view bytes);
VoxelVolume read_vti(const VolumeFile& file);

// The contents of a description; members that it leaves out are empty.
struct VolumeDescription {
  std::string type;
  std::optional<std::array<int64_t, 3>> count;
  bool is_big_endian = false;
  uint64_t header_bytes = 0;
  int64_t channels = 1;
  std::optional<Affine> space_from_index;
  VolumeSpace space = VolumeSpace::unknown;
};
VolumeDescription read_description(const std::string& path, const std::string& json);

// Reads NRRD's "space" or its short form, in small letters; nothing for what is no space of three dimensions.
std::optional<VolumeSpace> space_called(const std::string& name);

}  // namespace ombre::formats
