// Decompresses blocks of bytes by LZ4 and LZMA. The libraries are in modules that are loaded on demand.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ombre::formats {

enum class BlockPacking : uint8_t {
  lz4,  // a raw block without a header
  xz    // a stream of the format .xz
};

// Returns exactly `size` bytes; an empty text if the block is damaged or holds another number of bytes. Throws Error in
// builds without the library.
std::string unpack_block(std::string_view packed, BlockPacking packing, uint64_t size);

}  // namespace ombre::formats

// The functions that the modules export. They fill the bytes, and return false if the block holds more or fewer.
extern "C" bool ombre_lz4_unpack(std::string_view packed, std::string* bytes);
extern "C" bool ombre_xz_unpack(std::string_view packed, std::string* bytes);
