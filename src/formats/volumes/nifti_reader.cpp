// Reads grids in NIfTI files, versions 1 and 2 (nifti.nimh.nih.gov/nifti-1, nifti-2): .nii, .nii.gz, .hdr with .img.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/text/text.h"
#include "formats/volumes/volume_packing.h"
#include "formats/volumes/volume_parts.h"

namespace ombre::formats {
namespace {

constexpr size_t size_of_1 = 348, size_of_2 = 540;

// Offsets of the header's fields in a version.
struct Layout {
  size_t dimensions, dimension_bytes, data_type, spacings, spacing_bytes, offset, slope, intercept, units, qform, sform,
      quaternion, place, rows;
};
constexpr Layout layout_1{40, 2, 70, 76, 4, 108, 112, 116, 123, 252, 254, 256, 268, 280};
constexpr Layout layout_2{16, 8, 12, 104, 8, 168, 176, 184, 500, 344, 348, 352, 376, 400};

class NiftiHeader {
 public:
  NiftiHeader(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {
    const auto size = read<int32_t>(0);
    is_big_endian_ = size != static_cast<int32_t>(size_of_1) && size != static_cast<int32_t>(size_of_2);
    is_second_ = read<int32_t>(0) == static_cast<int32_t>(size_of_2);
    if (bytes.size() < (is_second_ ? size_of_2 : size_of_1)) fail_volume(path, "is cut off in its header");
  }

  bool is_big_endian() const { return is_big_endian_; }
  const Layout& layout() const { return is_second_ ? layout_2 : layout_1; }
  // Returns true if the numbers are in another file.
  bool is_pair() const { return bytes_.substr(is_second_ ? 4 : 344, 2) == "ni"; }

  template <class T>
  T read(size_t at) const {
    T value{};
    if (at + sizeof value > bytes_.size()) fail_volume(path_, "is cut off in its header");
    std::array<char, sizeof value> raw;
    bytes_.copy(raw.data(), raw.size(), at);
    if (is_big_endian_) std::reverse(raw.begin(), raw.end());
    std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }
  // Reads a real number with the version's size.
  double real(size_t at) const { return is_second_ ? read<double>(at) : static_cast<double>(read<float>(at)); }
  // Reads the n-th of a list of real numbers.
  double real(size_t list, size_t n) const { return real(list + n * layout().spacing_bytes); }
  int64_t whole(size_t at) const { return is_second_ ? read<int64_t>(at) : int64_t{read<int16_t>(at)}; }
  int code(size_t at) const { return is_second_ ? read<int32_t>(at) : int{read<int16_t>(at)}; }
  int data_type() const { return read<int16_t>(layout().data_type); }
  int units() const { return (is_second_ ? read<int32_t>(layout().units) : int{read<int8_t>(layout().units)}) & 7; }

 private:
  const std::string& path_;
  std::string_view bytes_;
  bool is_big_endian_ = false, is_second_ = false;
};

std::string type_of(const std::string& path, int code) {
  switch (code) {
    case 2:
      return "uint8";
    case 4:
      return "int16";
    case 8:
      return "int32";
    case 16:
      return "float32";
    case 64:
      return "float64";
    case 256:
      return "int8";
    case 512:
      return "uint16";
    case 768:
      return "uint32";
    case 1024:
      return "int64";
    case 1280:
      return "uint64";
    default:
      fail_volume(path, "has numbers of the NIfTI type " + std::to_string(code) +
                            "; integers of 8 to 64 bits and floats of 32 or 64 bits are read");
  }
}

struct NiftiSize {
  std::array<int64_t, 3> count{1, 1, 1};
  int64_t channels = 1;  // number of values along the axes after the third, including time
};

NiftiSize size_of(const std::string& path, const NiftiHeader& header) {
  const auto dimension = [&](size_t n) {
    return header.whole(header.layout().dimensions + n * header.layout().dimension_bytes);
  };
  const int64_t dimensions = dimension(0);
  if (dimensions < 1 || dimensions > 7) fail_volume(path, "has a header with " + std::to_string(dimensions) + " axes");
  NiftiSize size;
  constexpr int64_t most_channels = 100'000;
  for (int64_t n = 1; n <= dimensions; ++n) {
    const int64_t length = dimension(static_cast<size_t>(n));
    if (n <= 3)
      size.count[static_cast<size_t>(n - 1)] = length;
    else if (length > 1 && (length > most_channels || (size.channels *= length) > most_channels))
      fail_volume(path, "has more than 100000 values in each voxel, or volumes in time");
  }
  return size;
}

double mm_of(const NiftiHeader& header) {
  constexpr int metre = 1, micron = 3;
  return header.units() == metre ? 1000 : header.units() == micron ? 1e-3 : 1;
}

// Returns the rotation of a quaternion whose real part follows from the other three (method 2 of the standard).
Affine turned(const NiftiHeader& header) {
  const Layout& at = header.layout();
  const double b = header.real(at.quaternion, 0), c = header.real(at.quaternion, 1), d = header.real(at.quaternion, 2);
  const double rest = 1 - (b * b + c * c + d * d);
  const double scale = rest < 0 ? 1 / std::sqrt(b * b + c * c + d * d) : 1, a = rest < 0 ? 0 : std::sqrt(rest);
  const double x = b * scale, y = c * scale, z = d * scale;
  Affine map;
  map.rows = {Vec3{a * a + x * x - y * y - z * z, 2 * (x * y - a * z), 2 * (x * z + a * y)},
              Vec3{2 * (x * y + a * z), a * a + y * y - x * x - z * z, 2 * (y * z - a * x)},
              Vec3{2 * (x * z - a * y), 2 * (y * z + a * x), a * a + z * z - x * x - y * y}};
  return map;
}

Vec3 spacing_of(const NiftiHeader& header) {
  Vec3 spacing;
  for (size_t n = 0; n < 3; ++n) {
    const double length = std::abs(header.real(header.layout().spacings, n + 1));
    spacing[static_cast<int>(n)] = length == 0 ? 1 : length;
  }
  return spacing;
}

Affine by_quaternion(const NiftiHeader& header) {
  const double side = header.real(header.layout().spacings, 0) < 0 ? -1 : 1;
  Vec3 spacing = spacing_of(header);
  spacing.z *= side;
  Affine map = turned(header) * Affine::scaling(spacing);
  for (size_t n = 0; n < 3; ++n) map.offset[static_cast<int>(n)] = header.real(header.layout().place, n);
  return map;
}

Affine by_rows(const NiftiHeader& header) {
  Affine map;
  for (size_t row = 0; row < 3; ++row) {
    for (size_t n = 0; n < 3; ++n) map.rows[row][static_cast<int>(n)] = header.real(header.layout().rows, 4 * row + n);
    map.offset[static_cast<int>(row)] = header.real(header.layout().rows, 4 * row + 3);
  }
  return map;
}

// Sets the placement: the affine map if there is one, else that of the quaternion, else only the size of the voxels.
void place(const std::string& path, const NiftiHeader& header, VoxelVolume& volume) {
  const bool has_rows = header.code(header.layout().sform) > 0, has_turn = header.code(header.layout().qform) > 0;
  const Affine map = has_rows   ? by_rows(header)
                     : has_turn ? by_quaternion(header)
                                : Affine::scaling(spacing_of(header));
  for (const Vec3& row : map.rows)
    if (!is_finite(row)) fail_volume(path, "has an orientation that is not finite");
  if (!is_finite(map.offset)) fail_volume(path, "has an origin that is not finite");
  const double mm = mm_of(header);
  volume.space_from_index = Affine::scaling({mm, mm, mm}) * map;
  check_placement(path, *volume.space_from_index);
  if (has_rows || has_turn) volume.space = VolumeSpace::ras;
}

// Converts the numbers to slope * number + intercept. A slope that is zero or not finite means that there is none, as
// in nibabel and ITK.
void rescale(const std::string& path, const NiftiHeader& header, VoxelVolume& volume) {
  const double slope = header.real(header.layout().slope), intercept = header.real(header.layout().intercept);
  if (slope == 0 || !std::isfinite(slope) || (slope == 1 && intercept == 0)) return;
  if (!std::isfinite(intercept)) fail_volume(path, "has a slope whose intercept is not finite");
  rescale_numbers(path, slope, intercept, volume);
}

}  // namespace

bool is_nifti(std::string_view bytes) {
  const auto has = [&](size_t at, std::string_view magic) {
    return bytes.size() >= at + 4 && (bytes.substr(at, 4) == std::string("n+") + std::string(magic) ||
                                      bytes.substr(at, 4) == std::string("ni") + std::string(magic));
  };
  using namespace std::string_view_literals;
  return has(344, "1\0"sv) || has(4, "2\0"sv);
}

std::string nifti_data_path(const std::string& path, std::string_view bytes) {
  if (!NiftiHeader(path, bytes).is_pair()) return "";
  const std::filesystem::path header(path);
  for (const char* ending : {".img", ".img.gz", ".IMG"}) {
    const std::string beside = std::filesystem::path(header).replace_extension(ending).string();
    std::error_code ignored;
    if (std::filesystem::exists(beside, ignored)) return beside;
  }
  return std::filesystem::path(header).replace_extension(".img").string();
}

VoxelVolume read_nifti(const VolumeFile& file) {
  const std::string& path = file.path;
  const NiftiHeader header(path, file.bytes);
  VoxelVolume volume;
  const NiftiSize sizes = size_of(path, header);
  const Channel channel = chosen_channel(file, sizes.channels, true);
  volume.count = sizes.count;
  volume.type = type_of(path, header.data_type());
  volume.values = values_of_type(path, volume.type);
  const uint64_t size = voxel_bytes(path, volume.count, bytes_per_value(volume.values)) *
                        static_cast<uint64_t>(channel.count);  // before anything is decompressed
  place(path, header, volume);
  if (header.is_pair() && !file.companion) fail_volume(path, "has its numbers in an .img file, which is not there");
  const std::string_view numbers = header.is_pair() ? *file.companion : file.bytes;
  const double offset = header.layout().spacing_bytes == 8
                            ? static_cast<double>(header.read<int64_t>(header.layout().offset))
                            : static_cast<double>(header.read<float>(header.layout().offset));
  if (!(offset >= 0 && offset <= 1e15)) fail_volume(path, "has a header with a wrong offset of its numbers");
  const auto skip = static_cast<uint64_t>(offset);
  const auto check_begin = [&](std::string_view all) {
    if (skip > all.size()) fail_volume(path, "is cut off: its numbers begin behind its end");
  };
  if (header.is_pair() && is_gzip(numbers)) {
    check_room(path, size);
    constexpr uint64_t most_behind = 1 << 20;
    std::string unpacked = unpacked_file(path, numbers, size + skip + most_behind, volume.warnings);
    check_begin(unpacked);
    unpacked.erase(0, skip);
    take_own_numbers(file, std::move(unpacked), header.is_big_endian(), channel, volume);
  } else {
    check_begin(numbers);
    take_numbers(file, numbers.substr(skip), header.is_big_endian(), channel, volume);
  }
  rescale(path, header, volume);
  return volume;
}

}  // namespace ombre::formats
