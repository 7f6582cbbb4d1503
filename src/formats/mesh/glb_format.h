// The layout of binary glTF 2.0: a header, and chunks with headers of their own.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ombre::formats {

inline constexpr uint32_t glb_magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
inline constexpr size_t glb_header_bytes = 12, glb_chunk_header_bytes = 8;

}  // namespace ombre::formats
