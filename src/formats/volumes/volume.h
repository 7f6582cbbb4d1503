// Grids of numbers that files hold: NRRD, NIfTI, MetaImage, VTK's image data, NumPy's NPY, and raw numbers that a JSON
// file beside them describes.
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

// Types that are read.
using VoxelValues = std::variant<std::vector<uint8_t>, std::vector<int8_t>, std::vector<uint16_t>, std::vector<int16_t>,
                                 std::vector<uint32_t>, std::vector<int32_t>, std::vector<float>, std::vector<double>>;

// The frame in which a file gives places. The first three are of a patient: R is right, A anterior, S superior.
enum class VolumeSpace : uint8_t { unknown, ras, lps, las, right_handed, left_handed };

// Numbers side by side, which need not lie where their type could be read directly.
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
  VoxelValues values;                      // finite, as many as voxels; or an empty list that says their type
  std::string_view in_file;                // where not empty: the numbers, low byte first, in bytes of the file
  std::shared_ptr<const void> file;        // keeps these bytes
  bool stays_in_file = false;              // do they take no memory?
  std::string type;                        // "uint8"
  std::optional<Affine> space_from_index;  // of voxels' centres, in mm; with an inverse
  VolumeSpace space = VolumeSpace::unknown;
  // What the file's numbers went through, where its format has that.
  double slope = 1, intercept = 0;
  int64_t channels = 1;  // values that the file has in each voxel; these are one of them
};

// Calls with the numbers of the volume as Numbers<T>.
template <class Visit>
decltype(auto) visit_numbers(const VoxelVolume& volume, const Visit& visit) {
  return std::visit(
      [&]<class T>(const std::vector<T>& list) {
        if (volume.in_file.empty()) return visit(Numbers<T>(list));
        return visit(Numbers<T>(volume.in_file.data(), volume.in_file.size() / sizeof(T)));
      },
      volume.values);
}

// A part of a segmentation, as 3D Slicer writes them (.seg.nrrd): the voxels with a number in a layer.
struct VolumeSegment {
  std::string name, id;  // names need not differ
  int64_t label = 1;
  int layer = 0;                                     // the channel of the file
  std::optional<std::array<double, 3>> colour = {};  // red, green and blue from 0 to 1
};

// What is taken of a file that holds several grids, or several values in each voxel.
struct VolumeChoice {
  std::string name;  // of one of several arrays; empty: there is one
  int channel = -1;  // counted from 0; -1: there is one
};

// The bytes of a file. With `may_refer` numbers that lie in them as they are used are not copied.
struct VolumeFile {
  const std::string& path;
  std::string_view bytes;
  const std::string_view* companion = nullptr;  // what companion_of() names; null where it is missing
  VolumeChoice choice = {};
  bool may_refer = false;
};

// "RAS", "3D-right-handed", ...
std::string_view name(VolumeSpace space);

// The file in which the rest of this one is: a header's numbers, or the description of numbers (path + ".json", which
// need not be there). Empty where this one holds all. Throws Error.
std::string companion_of(const std::string& path, std::string_view bytes);

// The segments that a file names, in its order; none where it is no segmentation. Throws Error.
std::vector<VolumeSegment> segments_of(const std::string& path, std::string_view bytes);

// Throws Error, naming the path and what is wrong.
VoxelVolume read_volume(const VolumeFile& file);

// Throws Error, naming the path, where a value is not finite, or the volume lies where none can.
void check_volume(const std::string& path, const VoxelVolume& volume);

}  // namespace ombre::formats
