#include "formats/volumes/volume_parts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/system/free_memory.h"
#include "base/text/text.h"

namespace ombre::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers lie in memory low byte first");

constexpr uint64_t most_volume_bytes = uint64_t{1} << 40;
constexpr int64_t most_along_volume = int64_t{1} << 24;
constexpr double least_spacing_mm = 1e-6, greatest_spacing_mm = 1e4, farthest_mm = 1e6;

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
  if (type == "float64" || type == "int64" || type == "uint64") return std::vector<double>();
  fail_volume(
      path, "has numbers of the type \"" + type + "\"; save it as integers of 8 to 64 bits, as float32 or as float64");
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
                            std::to_string(count[2]) + " voxels, which are more than 1 TiB; cut it or make it coarser");
    bytes *= static_cast<uint64_t>(length);
  }
  return bytes;
}

void check_room(const std::string& path, uint64_t bytes) {
  const uint64_t free = free_memory_bytes();
  if (free == 0 || bytes <= free) return;
  fail_volume(path, "needs " + format_bytes(static_cast<double>(bytes)) + " of memory, and " +
                        format_bytes(static_cast<double>(free)) +
                        " are free; save it without compression, low byte first (as .nrrd, .mhd, .nii or .npy), since "
                        "such files stay on disk, or cut it or make it coarser");
}

Channel chosen_channel(const VolumeFile& file, int64_t count, bool is_apart) {
  const int wanted = file.choice.channel;
  const std::string most = std::to_string(count - 1);
  if (count < 1) fail_volume(file.path, "has no values in its voxels");
  if (count > 1 && wanted < 0)
    fail_volume(file.path, "has " + std::to_string(count) +
                               " values in each voxel, or volumes in time; choose one by channel=0, up to " + most);
  if (wanted >= count)
    fail_volume(file.path, "has no channel " + std::to_string(wanted) + "; 0 " +
                               (count > 1 ? "to " + most + " are" : "is") + " there");
  return {count, std::max(wanted, 0), is_apart};
}

namespace {

// Returns true if the numbers can be used in place.
bool lie_as_used(const Channel& channel, bool is_big_endian, size_t value_bytes) {
  return (channel.is_apart || channel.count == 1) && (!is_big_endian || value_bytes == 1);
}

bool lies_within(std::string_view part, std::string_view whole) {
  return part.data() >= whole.data() && part.data() + part.size() <= whole.data() + whole.size();
}

template <class T>
void copy_numbers(std::string_view bytes, bool is_big_endian, const Channel& channel, size_t count,
                  std::vector<T>& list) {
  list.resize(count);
  const size_t first = static_cast<size_t>(channel.chosen) * (channel.is_apart ? count : 1),
               step = channel.is_apart ? 1 : static_cast<size_t>(channel.count);
  const Numbers<T> numbers(bytes.data() + first * sizeof(T), 0);
  if (step == 1)
    std::memcpy(list.data(), numbers.bytes(), count * sizeof(T));
  else
    for (size_t n = 0; n < count; ++n) list[n] = numbers[n * step];
  if (is_big_endian && sizeof(T) > 1)
    for (T& value : list) swap_bytes(value);
}

// Copies 64-bit integers as doubles. Throws Error if one is not below 2^53, from where on doubles have gaps.
template <class T>
void copy_long_integers(const VolumeFile& file, std::string_view bytes, bool is_big_endian, const Channel& channel,
                        size_t count, VoxelVolume& volume) {
  std::vector<T> stored;
  copy_numbers(bytes, is_big_endian, channel, count, stored);
  constexpr int64_t most_exact = int64_t{1} << 53;
  std::vector<double> list(count);
  for (size_t n = 0; n < count; ++n) {
    if (std::cmp_greater(stored[n], most_exact) || std::cmp_less(stored[n], -most_exact))
      fail_volume(file.path, "has the " + volume.type + " " + std::to_string(stored[n]) + " at voxel " +
                                 voxel_text(volume, n) + ", which is beyond 2^53 and would be rounded");
    list[n] = static_cast<double>(stored[n]);
  }
  volume.values = std::move(list);
  narrow_integers(volume);
}

void copy_all_numbers(const VolumeFile& file, std::string_view bytes, bool is_big_endian, const Channel& channel,
                      size_t count, VoxelVolume& volume) {
  if (volume.type == "int64") return copy_long_integers<int64_t>(file, bytes, is_big_endian, channel, count, volume);
  if (volume.type == "uint64") return copy_long_integers<uint64_t>(file, bytes, is_big_endian, channel, count, volume);
  std::visit([&](auto& list) { copy_numbers(bytes, is_big_endian, channel, count, list); }, volume.values);
}

}  // namespace

void narrow_integers(VoxelVolume& volume) {
  const auto* list = std::get_if<std::vector<double>>(&volume.values);
  using Limits = std::numeric_limits<int32_t>;
  if (!list || !std::ranges::all_of(*list, [](double v) { return v >= Limits::min() && v <= Limits::max(); })) return;
  std::vector<int32_t> narrow;
  narrow.reserve(list->size());
  for (const double value : *list) narrow.push_back(static_cast<int32_t>(value));
  volume.values = std::move(narrow);
}

void take_numbers(const VolumeFile& file, std::string_view bytes, bool is_big_endian, const Channel& channel,
                  VoxelVolume& volume) {
  const size_t value_bytes = bytes_per_value(volume.values);
  const uint64_t size = voxel_bytes(file.path, volume.count, value_bytes);
  if (bytes.size() / size < static_cast<uint64_t>(channel.count))
    fail_volume(file.path, "is cut off: it has " + format_count(bytes.size()) + " of the " +
                               format_count(size * static_cast<uint64_t>(channel.count)) + " bytes of its numbers");
  volume.channels = channel.count;
  if (const uint64_t rest = bytes.size() - size * static_cast<uint64_t>(channel.count); rest > 0)
    volume.warnings.push_back("the volume \"" + file.path + "\" has " + format_count(rest) +
                              " bytes behind its numbers, which are not read");
  const bool is_kept = lies_within(bytes, file.bytes) || (file.companion && lies_within(bytes, *file.companion)) ||
                       volume.file != nullptr;
  const bool is_long = volume.type.ends_with("int64");
  if (file.may_refer && is_kept && !is_long && lie_as_used(channel, is_big_endian, value_bytes)) {
    volume.in_file = bytes.substr(size * static_cast<uint64_t>(channel.chosen), size);
  } else {
    check_room(file.path, size);
    copy_all_numbers(file, bytes, is_big_endian, channel, size / value_bytes, volume);
  }
}

void take_own_numbers(const VolumeFile& file, std::string bytes, bool is_big_endian, const Channel& channel,
                      VoxelVolume& volume) {
  const auto kept = std::make_shared<const std::string>(std::move(bytes));
  volume.file = kept;
  take_numbers(file, *kept, is_big_endian, channel, volume);
  if (volume.in_file.empty()) volume.file = nullptr;
}

void rescale_numbers(const std::string& path, double slope, double intercept, VoxelVolume& volume) {
  std::vector<float> scaled;
  visit_numbers(volume, [&](const auto& numbers) {
    check_room(path, numbers.size() * sizeof(float));
    scaled.reserve(numbers.size());
    for (size_t n = 0; n < numbers.size(); ++n)
      scaled.push_back(static_cast<float>(slope * static_cast<double>(numbers[n]) + intercept));
  });
  volume.values = std::move(scaled);
  volume.in_file = {};
  volume.file = nullptr;
  volume.type = "float32";
  volume.slope = slope;
  volume.intercept = intercept;
}

namespace {

struct NotFinite {
  uint64_t nans = 0, infinities = 0;
  size_t first_nan = 0, first_infinity = 0;
};

NotFinite count_not_finite(const VoxelVolume& volume) {
  NotFinite found;
  visit_numbers(volume, [&]<class T>(const Numbers<T>& numbers) {
    if constexpr (std::is_floating_point_v<T>)
      for (size_t n = 0; n < numbers.size(); ++n) {
        const T value = numbers[n];
        if (std::isnan(value) && found.nans++ == 0) found.first_nan = n;
        if (std::isinf(value) && found.infinities++ == 0) found.first_infinity = n;
      }
  });
  return found;
}

void replace_nans(const std::string& path, double nan, VoxelVolume& volume) {
  std::visit(
      [&]<class T>(std::vector<T>& list) {
        if constexpr (std::is_floating_point_v<T>) {
          if (!volume.in_file.empty()) {
            check_room(path, volume.in_file.size());
            list.resize(volume.in_file.size() / sizeof(T));
            std::memcpy(list.data(), volume.in_file.data(), volume.in_file.size());
          }
          std::ranges::replace_if(
              list, [](T value) { return std::isnan(value); }, static_cast<T>(nan));
        }
      },
      volume.values);
  volume.in_file = {};
  volume.file = nullptr;
}

}  // namespace

void settle_numbers(const std::string& path, std::optional<double> nan, VoxelVolume& volume) {
  const NotFinite found = count_not_finite(volume);
  if (found.infinities > 0)
    fail_volume(path, "has " + format_count(found.infinities) +
                          (found.infinities == 1 ? " value that is" : " values that are") +
                          " infinite, the first at voxel " + voxel_text(volume, found.first_infinity) +
                          "; put finite numbers in their place");
  if (found.nans == 0) return;
  if (!nan)
    fail_volume(path, "has " + format_count(found.nans) + (found.nans == 1 ? " value that is" : " values that are") +
                          " NaN, no number, the first at voxel " + voxel_text(volume, found.first_nan) +
                          "; nan=0 puts another number in their place");
  replace_nans(path, *nan, volume);
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
  constexpr double flat = 1e-3;  // as a share of the volume that right angles would give
  if (!(volume > flat * length(steps[0]) * length(steps[1]) * length(steps[2])))
    fail_volume(path, "has axes that lie in one plane, or nearly so");
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(map.offset[axis]) <= farthest_mm))
      fail_volume(path, "has its origin more than 1000000 mm away; give it another by origin=(x, y, z)");
}

void settle_volume(const std::string& path, std::optional<double> nan, VoxelVolume& volume) {
  voxel_bytes(path, volume.count, bytes_per_value(volume.values));
  if (volume.space_from_index) check_placement(path, *volume.space_from_index);
  settle_numbers(path, nan, volume);
}

bool is_vti(std::string_view bytes) {
  constexpr size_t sniffed = 4096;
  const std::string_view begin = trim(without_byte_order_mark(bytes).substr(0, sniffed));
  return begin.starts_with('<') && begin.find("<VTKFile") != std::string_view::npos &&
         begin.find("ImageData") != std::string_view::npos;
}

}  // namespace ombre::formats
