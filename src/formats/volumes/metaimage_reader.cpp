// Reads grids in MetaImage files (itk.org/Wiki/ITK/MetaIO/Documentation): .mha, and .mhd with a separate data file.
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "base/text/text.h"
#include "formats/volumes/volume_packing.h"
#include "formats/volumes/volume_parts.h"

namespace ombre::formats {
namespace {

class MetaImage : TextHeader {
 public:
  MetaImage(const std::string& path, std::string_view bytes) : TextHeader(path) {
    constexpr size_t most_header = size_t{1} << 20;
    size_t at = 0;
    while (at < bytes.size() && at < most_header) {
      const size_t end = std::min(bytes.find('\n', at), bytes.size());
      const std::string_view line = bytes.substr(at, end - at);
      at = std::min(end + 1, bytes.size());
      const size_t equals = line.find('=');
      if (equals == std::string_view::npos) {
        if (trim(line).empty()) continue;
        fail("has a line in its header that is no field: \"" + std::string(line.substr(0, 60)) + '"');
      }
      const std::string key = to_lower(std::string(trim(line.substr(0, equals))));
      fields_[key] = std::string(trim(line.substr(equals + 1)));
      if (key == "elementdatafile") break;
    }
    rest_ = bytes.substr(at);
  }

  // Returns the name of the data file; empty if the header's own file contains the numbers.
  std::string data_file() const {
    const std::string name = field("elementdatafile");
    if (name.starts_with("LIST") || name.find('%') != std::string::npos)
      fail("has its numbers in several files; join them, by 3D Slicer for example");
    return to_lower(name) == "local" ? "" : name;
  }

  VoxelVolume read(const VolumeFile& file) const {
    check_shape();
    VoxelVolume volume;
    const std::vector<double> sizes = numbers("dimsize", 3);
    for (size_t n = 0; n < 3; ++n) volume.count[n] = whole("dimsize", sizes[n]);
    volume.type = type();
    volume.values = values_of_type(path_, volume.type);
    const uint64_t size = voxel_bytes(path_, volume.count, bytes_per_value(volume.values));
    volume.space = VolumeSpace::lps;
    volume.space_from_index = placed();
    if (!data_file().empty() && !file.companion) fail("has its numbers in " + data_file() + ", which is not there");
    const double channels = fields_.contains("elementnumberofchannels") ? numbers("elementnumberofchannels", 1)[0] : 1;
    const Channel channel = chosen_channel(file, whole("elementnumberofchannels", channels), false);
    take(file, data_file().empty() ? rest_ : *file.companion, size, channel, volume);
    return volume;
  }

 private:
  // Returns the first of the names that the header has.
  std::string first_of(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      if (fields_.contains(name)) return name;
    return "";
  }

  std::vector<double> numbers(const std::string& name, size_t count) const {
    std::istringstream stream(field(name));
    std::vector<double> values;
    for (std::string word; stream >> word;) {
      const auto value = parse_number(word);
      if (!value || !std::isfinite(*value)) fail("has a wrong \"" + name + "\": \"" + word.substr(0, 60) + '"');
      values.push_back(*value);
    }
    if (values.size() != count) fail("has a \"" + name + "\" without " + std::to_string(count) + " numbers");
    return values;
  }

  int64_t whole(const std::string& name, double value) const {
    constexpr double most = 1e15;
    if (!(std::abs(value) <= most) || value != std::floor(value)) fail("has a wrong \"" + name + '"');
    return static_cast<int64_t>(value);
  }

  bool flag(const std::string& name) const { return to_lower(field_or(name, "false")) == "true"; }

  void check_shape() const {
    if (to_lower(field_or("objecttype", "image")) != "image") fail("is a MetaIO file of another kind than an image");
    if (numbers("ndims", 1)[0] != 3) fail("has " + field("ndims") + " axes; three are read");
    if (to_lower(field_or("binarydata", "true")) != "true") fail("has its numbers as text; save it as binary");
  }

  std::string type() const {
    static const std::map<std::string, const char*> names{
        {"MET_CHAR", "int8"},     {"MET_UCHAR", "uint8"},    {"MET_SHORT", "int16"},     {"MET_USHORT", "uint16"},
        {"MET_INT", "int32"},     {"MET_UINT", "uint32"},    {"MET_LONG", "int32"},      {"MET_ULONG", "uint32"},
        {"MET_FLOAT", "float32"}, {"MET_DOUBLE", "float64"}, {"MET_LONG_LONG", "int64"}, {"MET_ULONG_LONG", "uint64"}};
    const std::string given = field("elementtype");
    const auto found = names.find(given);
    if (found == names.end())
      fail("has numbers of the type \"" + given.substr(0, 40) + "\"; save it as MET_SHORT, MET_FLOAT, ...");
    return found->second;
  }

  Affine placed() const {
    const std::string spacing = first_of({"elementspacing", "elementsize"}),
                      turn = first_of({"transformmatrix", "rotation", "orientation"}),
                      place = first_of({"offset", "position", "origin"});
    const std::vector<double> lengths = spacing.empty() ? std::vector<double>(3, 1.0) : numbers(spacing, 3);
    Affine map;
    for (size_t axis = 0; axis < 3; ++axis)
      if (!(lengths[axis] > 0)) fail("has voxels of " + format_number(lengths[axis]) + " mm");
    if (!turn.empty()) {
      // Each group of three numbers is the direction of an axis.
      const std::vector<double> directions = numbers(turn, 9);
      for (size_t axis = 0; axis < 3; ++axis)
        for (size_t n = 0; n < 3; ++n) map.rows[n][static_cast<int>(axis)] = directions[3 * axis + n];
    }
    map = map * Affine::scaling({lengths[0], lengths[1], lengths[2]});
    if (!place.empty()) {
      const std::vector<double> offset = numbers(place, 3);
      map.offset = {offset[0], offset[1], offset[2]};
    }
    check_placement(path_, map);
    return map;
  }

  void take(const VolumeFile& file, std::string_view bytes, uint64_t voxels_size, const Channel& channel,
            VoxelVolume& volume) const {
    const uint64_t size = voxels_size * static_cast<uint64_t>(channel.count);
    const bool is_big = flag("elementbyteordermsb") || flag("binarydatabyteordermsb");
    if (flag("compresseddata")) {
      check_room(path_, size);
      const Packing packing = is_gzip(bytes) ? Packing::gzip : Packing::zlib;
      return take_own_numbers(file, unpacked(path_, bytes, packing, size), is_big, channel, volume);
    }
    const int64_t skip = whole("headersize", fields_.contains("headersize") ? numbers("headersize", 1)[0] : 0);
    const uint64_t before = skip == -1 ? bytes.size() - std::min<uint64_t>(size, bytes.size())
                                       : static_cast<uint64_t>(std::max<int64_t>(skip, 0));
    if (skip < -1 || before > bytes.size()) fail("has a wrong \"HeaderSize\"");
    take_numbers(file, bytes.substr(before), is_big, channel, volume);
  }
};

}  // namespace

bool is_metaimage(std::string_view bytes) {
  constexpr size_t sniffed = 4096;
  const std::string begin = to_lower(std::string(bytes.substr(0, sniffed)));
  return begin.starts_with("objecttype") || begin.starts_with("ndims");
}

std::string metaimage_data_path(const std::string& path, std::string_view bytes) {
  const std::string name = MetaImage(path, bytes).data_file();
  return name.empty() ? "" : (std::filesystem::path(path).parent_path() / name).string();
}

VoxelVolume read_metaimage(const VolumeFile& file) { return MetaImage(file.path, file.bytes).read(file); }

}  // namespace ombre::formats
