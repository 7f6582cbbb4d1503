// Decompresses numbers of grids: gzip and zlib streams.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

enum class Packing : uint8_t { gzip, zlib };

// Returns exactly `size` decompressed bytes; a gzip stream may have several members. Throws Error, naming the path.
std::string unpacked(const std::string& path, std::string_view bytes, Packing packing, uint64_t size);

// Returns the whole contents of a gzip file. Bytes that follow its last member are ignored, as gzip does: zeros are
// padding, and of others `warnings` tells. Throws Error if it is damaged or has more than `most` bytes.
std::string unpacked_file(const std::string& path, std::string_view bytes, uint64_t most,
                          std::vector<std::string>& warnings);
bool is_gzip(std::string_view bytes);
// Returns the decompressed size modulo 2^32, as stated at the end of a gzip file, as far as it is possible.
uint64_t stated_gzip_size(std::string_view bytes);

}  // namespace ombre::formats
