// Reads grids of raw numbers, and the descriptions beside them.
#include <cmath>

#include "base/text/json.h"
#include "base/text/text.h"
#include "formats/volumes/volume_parts.h"

namespace ombre::formats {
namespace {

class DescriptionReader {
 public:
  DescriptionReader(const std::string& path, const Data& data) : path_(path), data_(data) {}

  VolumeDescription read() const {
    VolumeDescription result;
    result.type = text("data_type");
    if (data_.find("dimensions")) result.count = counts();
    result.is_big_endian = byte_order() == "big";
    result.header_bytes = static_cast<uint64_t>(whole("header_bytes", data_.find("header_bytes"), 0));
    result.channels = whole("channels", data_.find("channels"), 1);
    constexpr int64_t most_channels = 1000;
    if (result.channels < 1 || result.channels > most_channels) fail("channels", "1 to 1000 values in each voxel");
    check_axes();
    if (const Data* space = data_.find("space")) {
      const auto known = space->string() ? space_called(to_lower(*space->string())) : std::nullopt;
      if (!known) fail("space", "\"RAS\", \"LPS\" or \"LAS\"");
      result.space = *known;
    }
    if (!data_.find("spacing_mm")) return result;
    const Vec3 origin = data_.find("origin_mm") ? vector("origin_mm") : Vec3{0, 0, 0};
    result.space_from_index = placed_along_axes(path_, vector("spacing_mm"), origin);
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& member, const std::string& expected) const {
    fail_volume(path_, "has a description whose \"" + member + "\" is wrong; expected " + expected);
  }

  std::string text(const char* member) const {
    const Data* data = data_.find(member);
    if (!data) return "";
    if (!data->string()) fail(member, "a text");
    return *data->string();
  }

  std::string byte_order() const {
    std::string order = text("byte_order");
    if (!order.empty() && order != "little" && order != "big") fail("byte_order", "\"little\" or \"big\"");
    return order;
  }

  int64_t whole(const char* member, const Data* data, int64_t otherwise) const {
    if (!data) return otherwise;
    constexpr double most = 1e15;
    const double* number = data->number();
    if (!number || !(*number >= 0 && *number <= most) || *number != std::floor(*number))
      fail(member, "a whole number that is not negative");
    return static_cast<int64_t>(*number);
  }

  const DataList& three(const char* member) const {
    const Data* data = data_.find(member);
    if (!data || !data->list() || data->list()->size() != 3) fail(member, "three numbers, for x, y and z");
    return *data->list();
  }

  std::array<int64_t, 3> counts() const {
    const DataList& list = three("dimensions");
    std::array<int64_t, 3> result{};
    for (size_t axis = 0; axis < 3; ++axis) result[axis] = whole("dimensions", &list[axis], 0);
    return result;
  }

  Vec3 vector(const char* member) const {
    const DataList& list = three(member);
    Vec3 result;
    for (int axis = 0; axis < 3; ++axis) {
      const double* number = list[static_cast<size_t>(axis)].number();
      if (!number) fail(member, "three numbers, for x, y and z");
      result[axis] = *number;
    }
    return result;
  }

  void check_axes() const {
    const Data* axes = data_.find("axes");
    if (axes && *axes != Data(DataList{Data("x"), Data("y"), Data("z")})) fail("axes", "[\"x\", \"y\", \"z\"]");
    const std::string fastest = text("fastest_axis");
    if (!fastest.empty() && fastest != "x") fail("fastest_axis", "\"x\"");
  }

  const std::string& path_;
  const Data& data_;
};

}  // namespace

VolumeDescription read_description(const std::string& path, const std::string& json) {
  Diagnostics diagnostics;
  const auto data = parse_json(make_source(path + ".json", json), diagnostics);
  if (!data || !data->members()) fail_volume(path, "has a description, " + path + ".json, that is no JSON object");
  return DescriptionReader(path, *data).read();
}

VoxelVolume read_raw(const VolumeFile& file) {
  const std::string& path = file.path;
  std::string_view bytes = file.bytes;
  const VolumeDescription description = read_description(path, std::string(*file.companion));
  if (description.type.empty() || !description.count)
    fail_volume(path, "has a description without \"data_type\" or \"dimensions\"");
  VoxelVolume volume;
  volume.type = description.type;
  volume.values = values_of_type(path, description.type);
  volume.count = *description.count;
  volume.space_from_index = description.space_from_index;
  volume.space = description.space;
  const uint64_t size =
      voxel_bytes(path, volume.count, bytes_per_value(volume.values)) * static_cast<uint64_t>(description.channels);
  bytes.remove_prefix(std::min<uint64_t>(description.header_bytes, bytes.size()));
  if (bytes.size() > size)
    fail_volume(path, "has " + format_count(bytes.size()) + " bytes, where its description has numbers of " +
                          format_count(size));
  const Channel channel = chosen_channel(file, description.channels, false);
  take_numbers(file, bytes, description.is_big_endian, channel, volume);
  return volume;
}

}  // namespace ombre::formats
