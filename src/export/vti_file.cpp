#include "export/vti_file.h"

#include <bit>
#include <cstring>

namespace ombre::exporting {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

}  // namespace

VtiFile::VtiFile(const std::string& path, formats::VtiGrid grid)
    : grid_(std::move(grid)), header_(formats::vti_header(grid_)), file_(path) {
  file_.append(header_);
  for (size_t n = 0; n < grid_.arrays.size(); ++n) {
    const uint64_t length = grid_.voxels() * grid_.arrays[n].bytes_per_voxel();
    std::string bytes(sizeof length, '\0');
    std::memcpy(bytes.data(), &length, sizeof length);
    file_.write_at(header_.size() + formats::vti_offset(grid_, n) - sizeof length, bytes);
  }
}

void VtiFile::write(size_t array, int64_t first_layer, std::string_view numbers) {
  const auto layer_voxels = static_cast<uint64_t>(grid_.count[0]) * static_cast<uint64_t>(grid_.count[1]);
  const uint64_t layer_bytes = layer_voxels * grid_.arrays[array].bytes_per_voxel();
  file_.write_at(header_.size() + formats::vti_offset(grid_, array) + static_cast<uint64_t>(first_layer) * layer_bytes,
                 numbers);
}

uint64_t VtiFile::bytes_written() const {
  uint64_t bytes = header_.size() + formats::vti_end().size();
  for (const formats::VtiArray& array : grid_.arrays) bytes += 8 + grid_.voxels() * array.bytes_per_voxel();
  return bytes;
}

void VtiFile::close() {
  const std::string end = formats::vti_end();
  file_.write_at(bytes_written() - end.size(), end);
  file_.close();
}

}  // namespace ombre::exporting
