// Grids of numbers as files for other programs, layer by layer.
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

enum class VolumeFormat {
  raw,        // the numbers alone
  npy,        // NumPy's array of shape (z, y, x)
  nrrd,       // with spacing and origin
  nrrd_gzip,  // compressed
};

// A grid, x fastest, then y, then z; numbers low byte first.
struct Volume {
  bool is_float = false;           // numbers of 32 bits, else bytes
  std::array<int64_t, 3> count{};  // along x, y, z
  Vec3 spacing_mm, origin_mm;      // the origin is the centre of the first voxel
  DataMembers about;               // what the numbers are, for people and programs

  uint64_t number_bytes() const { return is_float ? 4 : 1; }
  uint64_t layer_bytes() const {
    return static_cast<uint64_t>(count[0]) * static_cast<uint64_t>(count[1]) * number_bytes();
  }
  uint64_t bytes() const { return layer_bytes() * static_cast<uint64_t>(count[2]); }
};

// Describes the numbers to a program: sizes, places and what they are.
DataMembers describe(const Volume& volume);

// Does a description lie beside the file, since it has no place for spacing, origin and names?
bool has_description(VolumeFormat format);
std::string description_path(const std::string& path);

// Appears under its name when it is committed, and is gone when it is not. All throw Error.
class VolumeFile {
 public:
  VolumeFile(const std::string& path, VolumeFormat format, const Volume& volume);

  // The numbers of the next layers.
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
