// The module that unpacks blocks by LZ4.
#include <lz4.h>

#include "formats/containers/block_packing.h"

bool ombre_lz4_unpack(std::string_view packed, std::string* bytes) {
  if (packed.size() > LZ4_MAX_INPUT_SIZE || bytes->size() > LZ4_MAX_INPUT_SIZE) return false;
  const int size = static_cast<int>(bytes->size());
  return LZ4_decompress_safe(packed.data(), bytes->data(), static_cast<int>(packed.size()), size) == size;
}
