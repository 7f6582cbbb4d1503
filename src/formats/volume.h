// Grids of numbers that files hold: NRRD, NIfTI, MetaImage, NumPy's NPY, and raw numbers that a JSON file beside them
// describes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vec.h"

namespace ombre::formats {

// Types that are read.
using VoxelValues = std::variant<std::vector<uint8_t>, std::vector<int8_t>, std::vector<uint16_t>, std::vector<int16_t>,
                                 std::vector<uint32_t>, std::vector<int32_t>, std::vector<float>, std::vector<double>>;

// The frame in which a file gives places. The first three are of a patient: R is right, A anterior, S superior.
enum class VolumeSpace : uint8_t { unknown, ras, lps, las, right_handed, left_handed };

struct VoxelVolume {
  std::array<int64_t, 3> count{};          // along its own axes, the first fastest
  VoxelValues values;                      // finite, as many as voxels
  std::string type;                        // "uint8"
  std::optional<Affine> space_from_index;  // of voxels' centres, in mm; with an inverse
  VolumeSpace space = VolumeSpace::unknown;
};

// "RAS", "3D-right-handed", ...
std::string_view name(VolumeSpace space);

// The file in which the rest of this one is: a header's numbers, or the description of numbers (path + ".json", which
// need not be there). Empty where this one holds all. Throws Error.
std::string companion_of(const std::string& path, std::string_view bytes);

// `companion` holds that file's bytes; null where it is missing. Throws Error, naming the path and what is wrong.
VoxelVolume read_volume(const std::string& path, std::string_view bytes, const std::string* companion);

// Throws Error, naming the path, where a value is not finite, or the volume lies where none can.
void check_volume(const std::string& path, const VoxelVolume& volume);

}  // namespace ombre::formats
