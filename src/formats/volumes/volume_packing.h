// Packed numbers of grids: gzip and zlib streams.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ombre::formats {

enum class Packing : uint8_t { gzip, zlib };

// Exactly so many bytes; members of a gzip stream follow each other. Throws Error, naming the path.
std::string unpacked(const std::string& path, std::string_view bytes, Packing packing, uint64_t size);

// Everything in a gzip file, however much that is. Throws Error where it is damaged or more than `most` bytes.
std::string unpacked_file(const std::string& path, std::string_view bytes, uint64_t most);
bool is_gzip(std::string_view bytes);
// The length of what is packed, modulo 2^32, as the end of a gzip file states it.
uint64_t stated_gzip_size(std::string_view bytes);

}  // namespace ombre::formats
