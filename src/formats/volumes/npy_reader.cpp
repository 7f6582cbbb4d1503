// Reads grids in NumPy's array files, versions 1 to 3.
#include <charconv>

#include "base/text/text.h"
#include "formats/volumes/volume_parts.h"

namespace ombre::formats {
namespace {

struct NpyHeader {
  std::string type;  // such as "<f4"
  bool is_fortran = false;
  std::vector<int64_t> shape;
  size_t bytes = 0;  // size of the header
};

std::string_view header_text(const std::string& path, std::string_view bytes, size_t& end) {
  constexpr size_t before_length = 8;
  const auto byte = [&](size_t n) { return static_cast<size_t>(static_cast<unsigned char>(bytes[n])); };
  if (bytes.size() < 12) fail_volume(path, "is cut off in its header");
  const size_t version = byte(6), length_bytes = version == 1 ? 2 : 4;
  if (version < 1 || version > 3)
    fail_volume(path, "has the NPY version " + std::to_string(version) + "; 1 to 3 are read");
  size_t length = 0;
  for (size_t n = 0; n < length_bytes; ++n) length |= byte(before_length + n) << 8 * n;
  const size_t begin = before_length + length_bytes;
  if (length > bytes.size() - begin) fail_volume(path, "is cut off in its header");
  end = begin + length;
  return bytes.substr(begin, length);
}

// Returns the text that follows 'key':, without leading blanks.
std::string_view member(const std::string& path, std::string_view text, const std::string& key) {
  const size_t at = text.find("'" + key + "'");
  const size_t colon = at == std::string_view::npos ? at : text.find(':', at);
  if (colon == std::string_view::npos) fail_volume(path, "has a header without '" + key + "'");
  text.remove_prefix(colon + 1);
  return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

std::vector<int64_t> shape_of(const std::string& path, std::string_view text) {
  const size_t end = text.find(')');
  if (!text.starts_with('(') || end == std::string_view::npos) fail_volume(path, "has a header with a wrong 'shape'");
  std::vector<int64_t> shape;
  for (const std::string& word : split(std::string(text.substr(1, end - 1)), ',')) {
    const std::string_view number = trim(word);
    if (number.empty()) continue;
    int64_t length = 0;
    const auto [stop, status] = std::from_chars(number.data(), number.data() + number.size(), length);
    if (status != std::errc() || stop != number.data() + number.size())
      fail_volume(path, "has a header with a wrong 'shape'");
    shape.push_back(length);
  }
  return shape;
}

NpyHeader read_header(const std::string& path, std::string_view bytes) {
  NpyHeader header;
  const std::string_view text = header_text(path, bytes, header.bytes);
  const std::string_view type = member(path, text, "descr");
  const size_t end = type.find('\'', 1);
  if (!type.starts_with('\'') || end == std::string_view::npos)
    fail_volume(path, "holds records; save one array of numbers");
  header.type = type.substr(1, end - 1);
  header.is_fortran = member(path, text, "fortran_order").starts_with("True");
  header.shape = shape_of(path, member(path, text, "shape"));
  return header;
}

std::string type_called(const std::string& path, const std::string& type) {
  const std::string word = type.empty() ? "" : type.substr(1);
  if (word == "b1" || word == "u1") return "uint8";
  if (word == "i1") return "int8";
  if (word == "u2") return "uint16";
  if (word == "i2") return "int16";
  if (word == "u4") return "uint32";
  if (word == "i4") return "int32";
  if (word == "u8") return "uint64";
  if (word == "i8") return "int64";
  if (word == "f4") return "float32";
  if (word == "f8") return "float64";
  fail_volume(path, "has numbers of NumPy's type \"" + type +
                        "\"; save it with astype(\"float32\"), or as integers of 8 to 64 bits");
}

// Reorders numbers from z fastest to x fastest.
void turn_axes(VoxelVolume& volume) {
  std::visit(
      [&](auto& list) {
        const auto [nx, ny, nz] = volume.count;
        auto turned = list;
        size_t n = 0;
        for (int64_t i = 0; i < nx; ++i)
          for (int64_t j = 0; j < ny; ++j)
            for (int64_t k = 0; k < nz; ++k) turned[static_cast<size_t>((k * ny + j) * nx + i)] = list[n++];
        list = std::move(turned);
      },
      volume.values);
}

}  // namespace

VoxelVolume read_npy(const VolumeFile& file) {
  const std::string& path = file.path;
  const NpyHeader header = read_header(path, file.bytes);
  const size_t axes = header.shape.size();
  if (axes != 3 && (axes != 4 || header.is_fortran))
    fail_volume(path, "has an array of " + std::to_string(axes) +
                          " axes; its shape must be (z, y, x), or (z, y, x, channel) by rows");
  VoxelVolume volume;
  volume.type = type_called(path, header.type);
  volume.values = values_of_type(path, volume.type);
  volume.count = {header.shape[2], header.shape[1], header.shape[0]};
  const Channel channel = chosen_channel(file, axes == 4 ? header.shape[3] : 1, false);
  VolumeFile as_used = file;
  as_used.may_refer = file.may_refer && !header.is_fortran;
  take_numbers(as_used, file.bytes.substr(header.bytes), header.type[0] == '>', channel, volume);
  if (header.is_fortran) turn_axes(volume);
  if (!file.companion) return volume;
  const VolumeDescription about = read_description(path, std::string(*file.companion));
  if (about.count && *about.count != volume.count) fail_volume(path, "has another size than its description says");
  volume.space_from_index = about.space_from_index;
  volume.space = about.space;
  return volume;
}

}  // namespace ombre::formats
