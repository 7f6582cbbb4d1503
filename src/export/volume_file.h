// Writes grids of numbers as files for other programs, layer by layer.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/math/vec.h"
#include "base/text/data.h"
#include "export/output_file.h"
#include "formats/containers/gzip.h"

namespace ombre::exporting {

// A grid, x fastest, then y, then z; numbers are little-endian.
struct Volume {
  bool is_float = false;           // 32-bit floats, else bytes
  std::array<int64_t, 3> count{};  // along x, y, z
  Vec3 spacing_mm, origin_mm;      // the origin is the centre of the first voxel
  DataMembers about;               // meaning of the numbers, for people and programs

  uint64_t number_bytes() const { return is_float ? 4 : 1; }
  uint64_t layer_bytes() const {
    return static_cast<uint64_t>(count[0]) * static_cast<uint64_t>(count[1]) * number_bytes();
  }
  uint64_t bytes() const { return layer_bytes() * static_cast<uint64_t>(count[2]); }
};

// Returns a machine-readable description of the numbers: sizes, positions and meaning.
DataMembers describe(const Volume& volume);

// A format of files that hold a header and, behind it, the numbers of a grid.
struct VolumeFormat {
  std::string ending, help;
  std::string (*header)(const Volume& volume, bool is_gzip) = nullptr;  // null: there is none
  // True if it cannot hold spacing, origin and names, so that a description is written beside the file.
  bool has_description = false;
  bool can_compress = false;
};
const std::vector<VolumeFormat>& volume_formats();
// Returns the format of files with this ending, which must be a row's.
const VolumeFormat& volume_format(std::string_view ending);

std::string description_path(const std::string& path);

// A file that appears under its name when it is committed, and is removed otherwise. All functions throw Error.
class VolumeFile {
 public:
  VolumeFile(const std::string& path, const VolumeFormat& format, const Volume& volume, bool is_gzip = false);

  // Appends the numbers of the next layers.
  void append(std::string_view numbers);
  void close();
  void commit();
  uint64_t bytes_written() const { return bytes_; }

 private:
  void put(std::string_view bytes);

  NewFile file_;
  std::optional<NewFile> description_;
  std::optional<formats::GzipWriter> gzip_;
  uint64_t bytes_ = 0;
};

}  // namespace ombre::exporting
