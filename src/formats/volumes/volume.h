// Reads grids of numbers in files: NRRD, NIfTI, MetaImage, VTK's image data, NumPy's NPY, and raw numbers described by
// a JSON file beside them.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

// The supported types.
using VoxelValues = std::variant<std::vector<uint8_t>, std::vector<int8_t>, std::vector<uint16_t>, std::vector<int16_t>,
                                 std::vector<uint32_t>, std::vector<int32_t>, std::vector<float>, std::vector<double>>;

// The frame of a file's positions. The first three are those of a patient: R is right, A anterior, S superior.
enum class VolumeSpace : uint8_t { unknown, ras, lps, las, right_handed, left_handed };

// Contiguous numbers that need not be aligned for their type.
template <class T>
class Numbers {
 public:
  Numbers() = default;
  Numbers(const char* bytes, size_t count) : bytes_(bytes), count_(count) {}
  explicit Numbers(const std::vector<T>& list) : Numbers(reinterpret_cast<const char*>(list.data()), list.size()) {}

  T operator[](size_t n) const {
    T value;
    std::memcpy(&value, bytes_ + n * sizeof(T), sizeof(T));
    return value;
  }
  size_t size() const { return count_; }
  const char* bytes() const { return bytes_; }

 private:
  const char* bytes_ = nullptr;
  size_t count_ = 0;
};

struct VoxelVolume {
  std::array<int64_t, 3> count{};          // along its own axes, the first fastest
  VoxelValues values;                      // finite, one per voxel; or an empty list that only defines the type
  std::string_view in_file;                // if not empty: the little-endian numbers in the bytes of the file
  std::shared_ptr<const void> file;        // keeps these bytes alive
  bool stays_in_file = false;              // true if they do not use memory
  std::string type;                        // that of the file, such as "uint8"; 64-bit integers become int32 or double
  std::optional<Affine> space_from_index;  // maps indices of voxels to their centres in mm; invertible
  VolumeSpace space = VolumeSpace::unknown;
  // Slope and intercept that were applied to the file's numbers, in formats that have them.
  double slope = 1, intercept = 0;
  int64_t channels = 1;                    // values per voxel in the file; this volume contains one of them
  std::vector<std::string> warnings = {};  // sentences about what was left out
  std::optional<double> padding = {};      // the number in voxels that the scan marks as padding, if there are any
};

// Calls visit with the numbers of the volume as Numbers<T>.
template <class Visit>
decltype(auto) visit_numbers(const VoxelVolume& volume, const Visit& visit) {
  return std::visit(
      [&]<class T>(const std::vector<T>& list) {
        if (volume.in_file.empty()) return visit(Numbers<T>(list));
        return visit(Numbers<T>(volume.in_file.data(), volume.in_file.size() / sizeof(T)));
      },
      volume.values);
}

// A part of a segmentation in 3D Slicer's format (.seg.nrrd): the voxels with a label in a layer.
struct VolumeSegment {
  std::string name, id;  // names need not be unique
  int64_t label = 1;
  int layer = 0;                                     // channel of the file
  std::optional<std::array<double, 3>> colour = {};  // red, green and blue from 0 to 1
};

// The choice from a file with several grids or several values per voxel.
struct VolumeChoice {
  std::string name;                // name of one of several arrays; empty if there is only one
  int channel = -1;                // counted from 0; -1 if there is only one
  std::optional<double> nan = {};  // the number in place of NaN; without it, NaN is an error
  int phase = 0;                   // one of several volumes at the same place, counted from 1; 0 if there is only one
  bool are_labels = false;         // true where images with a palette give indices
  int64_t label = -1;              // the only label that is wanted; -1 for all
  bool is_regular = false;         // true where slices at uneven distances are resampled
  std::optional<double> outside = {};  // the number of voxels that a scan marks as padding
  bool is_outside_high = false;        // without `outside`: padding gets the scan's greatest number, not its least
  std::optional<double> level = {};    // without `outside`: the number of padding lies beyond this one
};

// The bytes of a file. With `may_refer`, numbers are not copied if they can be used in place.
struct VolumeFile {
  const std::string& path;
  std::string_view bytes;
  const std::string_view* companion = nullptr;  // contents of the file named by companion_of(); null if it is missing
  VolumeChoice choice = {};
  bool may_refer = false;
};

// Returns the name of a space: "RAS", "3D-right-handed", ...
std::string_view name(VolumeSpace space);

// Returns the path of the file with the rest of this one: a header's numbers, or the description of raw numbers (path +
// ".json", which may be missing). Empty if this file is complete. Throws Error.
std::string companion_of(const std::string& path, std::string_view bytes);

// Returns the segments that a file names, in its order; empty if it is not a segmentation. Throws Error.
std::vector<VolumeSegment> segments_of(const std::string& path, std::string_view bytes);

// Reads a volume. Throws Error, naming the path and what is wrong.
VoxelVolume read_volume(const VolumeFile& file);

// Puts `nan`, if given, in place of NaN. Throws Error, naming the path, if a value is still not finite.
void settle_numbers(const std::string& path, std::optional<double> nan, VoxelVolume& volume);

// Settles the numbers. Throws Error, naming the path, likewise, or if the volume's placement is impossible.
void settle_volume(const std::string& path, std::optional<double> nan, VoxelVolume& volume);

}  // namespace ombre::formats
