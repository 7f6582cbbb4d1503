#include "formats/volume.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/text.h"
#include "formats/volume_packing.h"
#include "formats/volume_parts.h"

namespace ombre::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers lie in memory low byte first");

constexpr uint64_t most_volume_bytes = uint64_t{16} << 30;
constexpr int64_t most_along_volume = int64_t{1} << 24;
constexpr double least_spacing_mm = 1e-6, greatest_spacing_mm = 1e4, farthest_mm = 1e6;

bool is_nrrd(std::string_view bytes) { return bytes.starts_with("NRRD"); }
bool is_npy(std::string_view bytes) { return bytes.starts_with("\x93NUMPY"); }

template <class T>
void swap_bytes(T& value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof value);
  std::reverse(raw, raw + sizeof value);
  std::memcpy(&value, raw, sizeof value);
}

std::string voxel_text(const VoxelVolume& volume, size_t n) {
  const auto nx = static_cast<size_t>(volume.count[0]), ny = static_cast<size_t>(volume.count[1]);
  return "(" + std::to_string(n % nx) + ", " + std::to_string(n / nx % ny) + ", " + std::to_string(n / nx / ny) + ")";
}

}  // namespace

std::string_view name(VolumeSpace space) {
  constexpr std::string_view names[] = {"unknown", "RAS", "LPS", "LAS", "3D-right-handed", "3D-left-handed"};
  return names[static_cast<size_t>(space)];
}

std::optional<VolumeSpace> space_called(const std::string& name) {
  if (name == "right-anterior-superior" || name == "ras") return VolumeSpace::ras;
  if (name == "left-posterior-superior" || name == "lps") return VolumeSpace::lps;
  if (name == "left-anterior-superior" || name == "las") return VolumeSpace::las;
  if (name == "3d-right-handed") return VolumeSpace::right_handed;
  if (name == "3d-left-handed") return VolumeSpace::left_handed;
  if (name == "scanner-xyz" || name == "unknown") return VolumeSpace::unknown;
  return std::nullopt;
}

VoxelValues values_of_type(const std::string& path, const std::string& type) {
  if (type == "uint8") return std::vector<uint8_t>();
  if (type == "int8") return std::vector<int8_t>();
  if (type == "uint16") return std::vector<uint16_t>();
  if (type == "int16") return std::vector<int16_t>();
  if (type == "uint32") return std::vector<uint32_t>();
  if (type == "int32") return std::vector<int32_t>();
  if (type == "float32") return std::vector<float>();
  if (type == "float64") return std::vector<double>();
  fail_volume(path, "has numbers of the type \"" + type +
                        "\"; save it as uint8, int8, uint16, int16, uint32, int32, float32 or float64");
}

size_t bytes_per_value(const VoxelValues& values) {
  return std::visit([](const auto& list) { return sizeof list[0]; }, values);
}

uint64_t voxel_bytes(const std::string& path, const std::array<int64_t, 3>& count, size_t bytes_per_value) {
  uint64_t bytes = bytes_per_value;
  for (const int64_t length : count) {
    if (length < 1) fail_volume(path, "has an axis of " + std::to_string(length) + " voxels");
    if (length > most_along_volume || bytes > most_volume_bytes / static_cast<uint64_t>(length))
      fail_volume(path, "has " + std::to_string(count[0]) + " x " + std::to_string(count[1]) + " x " +
                            std::to_string(count[2]) +
                            " voxels, which are more than 16 GiB; cut it or make it coarser");
    bytes *= static_cast<uint64_t>(length);
  }
  return bytes;
}

void take_numbers(const std::string& path, std::string_view bytes, bool is_big_endian, VoxelVolume& volume) {
  const uint64_t size = voxel_bytes(path, volume.count, bytes_per_value(volume.values));
  if (bytes.size() < size)
    fail_volume(path, "is cut off: it has " + format_count(bytes.size()) + " of the " + format_count(size) +
                          " bytes of its numbers");
  std::visit(
      [&](auto& list) {
        list.resize(size / sizeof list[0]);
        std::memcpy(list.data(), bytes.data(), size);
        if (is_big_endian && sizeof list[0] > 1)
          for (auto& value : list) swap_bytes(value);
      },
      volume.values);
  check_finite(path, volume);
}

void rescale_numbers(double slope, double intercept, VoxelVolume& volume) {
  std::vector<float> scaled;
  std::visit(
      [&](const auto& list) {
        scaled.reserve(list.size());
        for (const auto value : list)
          scaled.push_back(static_cast<float>(slope * static_cast<double>(value) + intercept));
      },
      volume.values);
  volume.values = std::move(scaled);
  volume.type = "float32";
}

void check_finite(const std::string& path, const VoxelVolume& volume) {
  std::visit(
      [&](const auto& list) {
        for (size_t n = 0; n < list.size(); ++n)
          if (!std::isfinite(static_cast<double>(list[n])))
            fail_volume(path, "has a value that is not finite at voxel " + voxel_text(volume, n) +
                                  "; put numbers in the place of NaN and infinity");
      },
      volume.values);
}

Affine placed_along_axes(const std::string& path, Vec3 spacing_mm, Vec3 origin_mm) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(spacing_mm[axis] > 0)) fail_volume(path, "has voxels of " + format_number(spacing_mm[axis]) + " mm");
  Affine map = Affine::scaling(spacing_mm);
  map.offset = origin_mm;
  check_placement(path, map);
  return map;
}

void check_placement(const std::string& path, const Affine& map) {
  std::array<Vec3, 3> steps;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 unit{axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
    steps[static_cast<size_t>(axis)] = map(unit) - map.offset;
    const double spacing = length(steps[static_cast<size_t>(axis)]);
    if (!(spacing >= least_spacing_mm && spacing <= greatest_spacing_mm))
      fail_volume(path, "has voxels of " + format_number(spacing) + " mm along its axis " + std::to_string(axis + 1) +
                            "; from 0.000001 to 10000 mm are possible");
  }
  const double volume = std::abs(determinant(map));
  constexpr double flat = 1e-3;  // of the volume that right angles would give
  if (!(volume > flat * length(steps[0]) * length(steps[1]) * length(steps[2])))
    fail_volume(path, "has axes that lie in one plane, or nearly so");
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(map.offset[axis]) <= farthest_mm))
      fail_volume(path, "has its origin more than 1000000 mm away; give it another by origin=(x, y, z)");
}

void check_volume(const std::string& path, const VoxelVolume& volume) {
  voxel_bytes(path, volume.count, bytes_per_value(volume.values));
  if (volume.space_from_index) check_placement(path, *volume.space_from_index);
  check_finite(path, volume);
}

std::string companion_of(const std::string& path, std::string_view bytes) {
  if (is_nrrd(bytes)) return nrrd_data_path(path, bytes);
  if (is_nifti(bytes)) return nifti_data_path(path, bytes);
  if (is_metaimage(bytes)) return metaimage_data_path(path, bytes);
  return path + ".json";
}

VoxelVolume read_volume(const std::string& path, std::string_view bytes, const std::string* companion) {
  if (is_nrrd(bytes)) return read_nrrd(path, bytes, companion);
  if (is_npy(bytes)) return read_npy(path, bytes, companion);
  if (is_nifti(bytes)) return read_nifti(path, bytes, companion);
  if (is_metaimage(bytes)) return read_metaimage(path, bytes, companion);
  if (is_gzip(bytes)) {
    const std::string all = unpacked_file(path, bytes, most_volume_bytes);
    if (is_gzip(all)) fail_volume(path, "is packed twice by gzip; unpack it");
    return read_volume(path, all, companion);
  }
  if (companion) return read_raw(path, bytes, *companion);
  fail_volume(path, "is none of NRRD, NIfTI, MetaImage and NPY, and no " + path +
                        ".json describes it; convert other formats, by 3D Slicer for example");
}

}  // namespace ombre::formats
