// Common parts of the readers of grids.
#pragma once

#include <cmath>
#include <limits>
#include <map>

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/volumes/volume.h"

namespace ombre::formats {

[[noreturn]] inline void fail_volume(const std::string& path, const std::string& message) {
  throw Error(Code::file_content, "the volume \"" + path + "\" " + message, {{"file", path}});
}

// A header of text: its fields by their names in lower case, and the bytes behind it.
class TextHeader {
 protected:
  explicit TextHeader(const std::string& path) : path_(path) {}

  [[noreturn]] void fail(const std::string& message) const { fail_volume(path_, message); }
  std::string field_or(const std::string& name, const std::string& otherwise) const {
    const auto found = fields_.find(name);
    return found == fields_.end() ? otherwise : found->second;
  }
  std::string field(const std::string& name) const {
    if (!fields_.contains(name)) fail("has a header without \"" + name + '"');
    return fields_.at(name);
  }

  const std::string& path_;
  std::map<std::string, std::string> fields_;
  std::string_view rest_;
};

// Returns an empty list for a type ("uint8", "int16", "float", ...): the list has the size of its numbers, and those of
// "int64" and "uint64" become doubles. Throws Error for other types.
VoxelValues values_of_type(const std::string& path, const std::string& type);
size_t bytes_per_value(const VoxelValues& values);

// Returns the size of all voxels, after checking that the counts are possible. Throws Error.
uint64_t voxel_bytes(const std::string& path, const std::array<int64_t, 3>& count, size_t bytes_per_value);

// Throws Error if this many bytes are more than the free memory. Readers call it with sizes stated by compressed files.
void check_room(const std::string& path, uint64_t bytes);

// A channel: one of several values per voxel.
struct Channel {
  int64_t count = 1, chosen = 0;
  bool is_apart = false;  // stored one value after another for all voxels, not voxel by voxel
};
// Returns the chosen channel. Throws Error if there are several and none is chosen, or too few.
Channel chosen_channel(const VolumeFile& file, int64_t count, bool is_apart);

// Takes the numbers from the first bytes; their type is that of the volume. Warns of bytes behind them. Throws Error if
// there are too few, or if a 64-bit integer is too large for a double.
void take_numbers(const VolumeFile& file, std::string_view bytes, bool is_big_endian, const Channel& channel,
                  VoxelVolume& volume);
// Takes the numbers from bytes that the caller no longer needs. Throws Error likewise.
void take_own_numbers(const VolumeFile& file, std::string bytes, bool is_big_endian, const Channel& channel,
                      VoxelVolume& volume);

// Returns a map from voxels' size and the first voxel's position along the axes. Throws Error for impossible values.
Affine placed_along_axes(const std::string& path, Vec3 spacing_mm, Vec3 origin_mm);
void check_placement(const std::string& path, const Affine& space_from_index);

// Converts a number read from text. Throws Error if the type cannot hold it.
template <class T>
T number_of_text(const std::string& path, const std::string& type, double value) {
  constexpr double most_exact = 9007199254740992;  // 2^53
  const bool is_exact = !type.ends_with("int64") || (std::abs(value) <= most_exact && value == std::floor(value));
  bool is_in_range = is_exact;
  if constexpr (std::is_integral_v<T>)
    is_in_range = value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max();
  if (!is_in_range) fail_volume(path, "has a number that its type cannot hold: " + format_number(value));
  return static_cast<T>(value);
}

// Converts 64-bit integers read as doubles to 32-bit integers if all of them fit.
void narrow_integers(VoxelVolume& volume);

// Replaces the numbers with slope * number + intercept as 32-bit floats.
void rescale_numbers(const std::string& path, double slope, double intercept, VoxelVolume& volume);

bool is_nifti(std::string_view bytes);
VoxelVolume read_nifti(const VolumeFile& file);
std::string nifti_data_path(const std::string& path, std::string_view bytes);

bool is_metaimage(std::string_view bytes);
VoxelVolume read_metaimage(const VolumeFile& file);
std::string metaimage_data_path(const std::string& path, std::string_view bytes);

VoxelVolume read_nrrd(const VolumeFile& file);
// Returns the path of the file with the numbers; empty if the header's own file contains them.
std::string nrrd_data_path(const std::string& path, std::string_view bytes);
// Returns the segments in the header's keys; none if it has no such keys.
std::vector<VolumeSegment> nrrd_segments(const std::string& path, std::string_view bytes);
VoxelVolume read_npy(const VolumeFile& file);
VoxelVolume read_raw(const VolumeFile& file);

// Readers of VTK's image data, whose arrays have names.
bool is_vti(std::string_view bytes);
VoxelVolume read_vti(const VolumeFile& file);

// The contents of a description; missing members are empty.
struct VolumeDescription {
  std::string type;
  std::optional<std::array<int64_t, 3>> count;
  bool is_big_endian = false;
  uint64_t header_bytes = 0;
  int64_t channels = 1;
  std::optional<Vec3> spacing_mm;
  Vec3 origin_mm;                          // of the first voxel
  std::optional<Affine> space_from_index;  // follows from the spacing and the origin
  VolumeSpace space = VolumeSpace::unknown;
};
// Throws Error, with the place of the mistake.
VolumeDescription read_description(const std::string& path, const std::string& json);

// Reads NRRD's "space" or its short form, in lower case; null if it is not a three-dimensional space.
std::optional<VolumeSpace> space_called(const std::string& name);

}  // namespace ombre::formats
