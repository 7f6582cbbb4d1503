#include "formats/volumes/volume_packing.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>

#include "base/text/text.h"
#include "formats/volumes/volume_parts.h"

namespace ombre::formats {
namespace {

constexpr uint64_t most_growth = 1032;  // greatest ratio of deflate

using Unpacker = std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>;

Unpacker make_unpacker() { return {libdeflate_alloc_decompressor(), libdeflate_free_decompressor}; }

}  // namespace

uint64_t stated_gzip_size(std::string_view bytes) {
  constexpr size_t digits = 4;
  if (bytes.size() < digits) return 0;
  uint64_t size = 0;
  for (size_t n = 0; n < digits; ++n)
    size |= static_cast<uint64_t>(static_cast<unsigned char>(bytes[bytes.size() - digits + n])) << 8 * n;
  return std::min<uint64_t>(size, most_growth * bytes.size());
}

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"); }

std::string unpacked(const std::string& path, std::string_view bytes, Packing packing, uint64_t size) {
  if (size / most_growth > bytes.size()) fail_volume(path, "is cut off: its packed numbers are too short");
  const Unpacker unpacker = make_unpacker();
  const auto unpack = packing == Packing::gzip ? libdeflate_gzip_decompress_ex : libdeflate_zlib_decompress_ex;
  std::string result(size, '\0');
  size_t done = 0;
  while (done < size) {
    size_t taken = 0, made = 0;
    const auto status =
        unpack(unpacker.get(), bytes.data(), bytes.size(), result.data() + done, size - done, &taken, &made);
    if (status == LIBDEFLATE_INSUFFICIENT_SPACE) fail_volume(path, "has more packed numbers than its sizes say");
    if (status != LIBDEFLATE_SUCCESS || (made == 0 && taken == 0))
      fail_volume(path, "has packed numbers that are damaged or cut off");
    bytes.remove_prefix(taken);
    done += made;
  }
  return result;
}

std::string unpacked_file(const std::string& path, std::string_view bytes, uint64_t most,
                          std::vector<std::string>& warnings) {
  constexpr uint64_t least_room = 1 << 16;
  const uint64_t possible = std::min(most, most_growth * bytes.size() + least_room);
  const Unpacker unpacker = make_unpacker();
  std::string result;
  uint64_t room = std::clamp(stated_gzip_size(bytes), least_room, possible);
  for (bool is_first = true; !bytes.empty() && (is_first || is_gzip(bytes));) {
    const size_t done = result.size();
    result.resize(done + room);
    size_t taken = 0, made = 0;
    const auto status = libdeflate_gzip_decompress_ex(unpacker.get(), bytes.data(), bytes.size(), result.data() + done,
                                                      room, &taken, &made);
    result.resize(done + (status == LIBDEFLATE_SUCCESS ? made : 0));
    if (status == LIBDEFLATE_INSUFFICIENT_SPACE) {
      if (done + room >= possible) fail_volume(path, "unpacks to more than " + format_bytes(static_cast<double>(most)));
      room = std::min(2 * room, possible - done);
      continue;
    }
    if (status != LIBDEFLATE_SUCCESS) fail_volume(path, "is packed by gzip, and damaged or cut off");
    is_first = false;
    bytes.remove_prefix(taken);
    room = std::min(std::max(least_room, room), possible - std::min(possible, static_cast<uint64_t>(result.size())));
  }
  if (bytes.find_first_not_of('\0') != std::string_view::npos)
    warnings.push_back("the volume \"" + path + "\" has " + format_count(bytes.size()) +
                       " bytes behind its packed contents, which are not read");
  return result;
}

}  // namespace ombre::formats
