// The module that unpacks streams of the format .xz by liblzma.
#include <lzma.h>

#include "formats/containers/block_packing.h"

namespace {

constexpr uint64_t most_memory = uint64_t{256} << 20;  // the strongest usual packing takes 65 MiB

}  // namespace

bool ombre_xz_unpack(std::string_view packed, std::string* bytes) {
  uint64_t memory = most_memory;
  size_t from = 0, to = 0;
  const lzma_ret result =
      lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const uint8_t*>(packed.data()), &from,
                                packed.size(), reinterpret_cast<uint8_t*>(bytes->data()), &to, bytes->size());
  return result == LZMA_OK && to == bytes->size();
}
