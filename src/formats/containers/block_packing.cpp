// Loads the modules for LZ4 and LZMA when the first block is read.
#include "formats/containers/block_packing.h"

#include "base/system/module_loader.h"

namespace ombre::formats {
namespace {

constexpr Module lz4{"ombre_lz4",  "LZ4",       "numbers packed by LZ4",
                     "liblz4-dev", "OMBRE_LZ4", "save with zlib (vtkZLibDataCompressor) or without packing"};
constexpr Module lzma{"ombre_lzma",  "liblzma",    "numbers packed by LZMA",
                      "liblzma-dev", "OMBRE_LZMA", "save with zlib (vtkZLibDataCompressor) or without packing"};

// Returns the greatest number of bytes that a byte of a block gives, so that a short block is not given much memory.
// LZMA's cheapest repetition gives 273 bytes, and takes no more than decisions that are as cheap as they become.
uint64_t greatest_ratio(BlockPacking packing) { return packing == BlockPacking::lz4 ? 255 : 16384; }

bool fill_block(std::string_view packed, BlockPacking packing, std::string& bytes) {
  if (packing == BlockPacking::lz4) {
    static const auto unpack_lz4 = load_function<decltype(ombre_lz4_unpack)>(lz4, "ombre_lz4_unpack");
    return unpack_lz4(packed, &bytes);
  }
  static const auto unpack_xz = load_function<decltype(ombre_xz_unpack)>(lzma, "ombre_xz_unpack");
  return unpack_xz(packed, &bytes);
}

}  // namespace

std::string unpack_block(std::string_view packed, BlockPacking packing, uint64_t size) {
  if (size / greatest_ratio(packing) > packed.size()) return "";
  std::string bytes(size, '\0');
  return fill_block(packed, packing, bytes) ? bytes : "";
}

}  // namespace ombre::formats
