// Reads grids in NRRD files (teem.sourceforge.net/nrrd/format.html), attached and detached, raw, gzip and text.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>

#include "base/text/text.h"
#include "formats/volumes/volume_packing.h"
#include "formats/volumes/volume_parts.h"

namespace ombre::formats {
namespace {

namespace fs = std::filesystem;

class NrrdReader : TextHeader {
 public:
  NrrdReader(const std::string& path, std::string_view bytes) : TextHeader(path) {
    constexpr size_t most_header = size_t{1} << 20;
    size_t at = 0;
    for (bool is_first = true; at < bytes.size(); is_first = false) {
      if (at > most_header) fail("has a header of more than a mebibyte");
      const size_t end = std::min(bytes.find('\n', at), bytes.size());
      std::string line(bytes.substr(at, end - at));
      if (line.ends_with('\r')) line.pop_back();
      at = std::min(end + 1, bytes.size());
      if (line.empty()) break;
      if (is_first)
        check_version(line);
      else
        take_line(line);
    }
    rest_ = bytes.substr(at);
  }

  std::string data_file() const {
    const std::string name = field_or("data file", field_or("datafile", ""));
    if (name.empty()) return "";
    if (name.starts_with("LIST") || name.find('%') != std::string::npos)
      fail("has its numbers in several files; join them, by 3D Slicer for example");
    return name;
  }

  // Returns the segments in 3D Slicer's keys (extensions of NRRD, Segmentation file). Before version 4.11 each segment
  // had its own layer, in which its voxels are 1.
  std::vector<VolumeSegment> segments() const {
    std::vector<VolumeSegment> segments;
    for (int n = 0;; ++n) {
      const std::string prefix = "Segment" + std::to_string(n) + "_";
      const auto id = note(prefix + "ID"), name = note(prefix + "Name");
      if (!id && !name) return segments;
      const auto label = note(prefix + "LabelValue"), layer = note(prefix + "Layer");
      VolumeSegment segment{name.value_or(*id), id.value_or("")};
      if (label) segment.label = whole(prefix + "LabelValue", *label);
      if (segment.label < 0 || segment.label > most_label) fail("has a wrong \"" + prefix + "LabelValue\"");
      segment.layer = layer ? static_cast<int>(whole(prefix + "Layer", *layer)) : label ? 0 : n;
      if (segment.layer < 0 || segment.layer > most_layers) fail("has a wrong \"" + prefix + "Layer\"");
      if (const auto colour = note(prefix + "Color")) segment.colour = read_colour(*colour);
      segments.push_back(std::move(segment));
    }
  }

  VoxelVolume read(const VolumeFile& file) const {
    VoxelVolume volume;
    volume.type = type();
    volume.values = values_of_type(path_, volume.type);
    const Channel channel = read_axes(file, volume);
    voxel_bytes(path_, volume.count, bytes_per_value(volume.values));  // before anything is decompressed
    if (!data_file().empty() && !file.companion) fail("has its numbers in " + data_file() + ", which is not there");
    read_numbers(file, data_file().empty() ? rest_ : *file.companion, channel, volume);
    return volume;
  }

 private:
  using Words = std::vector<std::string>;
  static constexpr int most_layers = 100000;
  static constexpr int64_t most_label = (1 << 24) - 1;  // largest integer that floats represent exactly without gaps

  void check_version(const std::string& line) const {
    if (line.size() != 8 || line < "NRRD0001" || line > "NRRD0005")
      fail("has the NRRD version \"" + line.substr(0, 20) + "\"; NRRD0001 to NRRD0005 are read");
  }

  void take_line(const std::string& line) {
    if (line[0] == '#') return;
    if (const size_t equals = line.find(":="); equals != std::string::npos) {
      notes_[line.substr(0, equals)] = unescaped(std::string_view(line).substr(equals + 2));
      return;
    }
    const size_t colon = line.find(": ");
    if (colon == std::string::npos)
      return fail("has a line in its header that is no field: \"" + line.substr(0, 60) + '"');
    fields_[to_lower(line.substr(0, colon))] = std::string(trim(line.substr(colon + 2)));
  }

  // Returns a value in which a backslash before an n means a line end, and one before a backslash a backslash.
  static std::string unescaped(std::string_view text) {
    std::string result;
    for (size_t n = 0; n < text.size(); ++n) {
      const bool is_escape = text[n] == '\\' && n + 1 < text.size() && (text[n + 1] == 'n' || text[n + 1] == '\\');
      if (is_escape) ++n;
      result += is_escape && text[n] == 'n' ? '\n' : text[n];
    }
    return result;
  }

  std::optional<std::string> note(const std::string& key) const {
    const auto found = notes_.find(key);
    return found == notes_.end() ? std::nullopt : std::optional(found->second);
  }

  // Returns nothing for a text that is no colour, since colours of segments only show.
  static std::optional<std::array<double, 3>> read_colour(const std::string& text) {
    const Words words = words_of(text);
    if (words.size() != 3) return std::nullopt;
    std::array<double, 3> colour{};
    for (size_t n = 0; n < 3; ++n) {
      const auto value = parse_number(words[n]);
      if (!value || !(*value >= 0 && *value <= 1)) return std::nullopt;
      colour[n] = *value;
    }
    return colour;
  }

  static Words words_of(const std::string& text) {
    std::istringstream stream(text);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
  }

  double number(const std::string& name, std::string_view text) const {
    const auto value =
        to_lower(std::string(trim(text))) == "nan" ? std::optional(std::nan("")) : parse_number(trim(text));
    if (!value) fail("has a wrong \"" + name + "\": \"" + std::string(text.substr(0, 60)) + '"');
    return *value;
  }

  int64_t whole(const std::string& name, const std::string& text) const {
    constexpr double most = 1e15;
    const double value = number(name, text);
    if (!(std::abs(value) <= most) || value != std::floor(value))
      fail("has a wrong \"" + name + "\": \"" + text.substr(0, 60) + '"');
    return static_cast<int64_t>(value);
  }

  std::string type() const {
    static const std::map<std::string, const char*> names{{"signed char", "int8"},
                                                          {"int8", "int8"},
                                                          {"int8_t", "int8"},
                                                          {"uchar", "uint8"},
                                                          {"unsigned char", "uint8"},
                                                          {"uint8", "uint8"},
                                                          {"uint8_t", "uint8"},
                                                          {"short", "int16"},
                                                          {"short int", "int16"},
                                                          {"int16", "int16"},
                                                          {"int16_t", "int16"},
                                                          {"signed short", "int16"},
                                                          {"signed short int", "int16"},
                                                          {"ushort", "uint16"},
                                                          {"unsigned short", "uint16"},
                                                          {"unsigned short int", "uint16"},
                                                          {"uint16", "uint16"},
                                                          {"uint16_t", "uint16"},
                                                          {"int", "int32"},
                                                          {"signed int", "int32"},
                                                          {"int32", "int32"},
                                                          {"int32_t", "int32"},
                                                          {"uint", "uint32"},
                                                          {"unsigned int", "uint32"},
                                                          {"uint32", "uint32"},
                                                          {"uint32_t", "uint32"},
                                                          {"longlong", "int64"},
                                                          {"long long", "int64"},
                                                          {"long long int", "int64"},
                                                          {"signed long long", "int64"},
                                                          {"signed long long int", "int64"},
                                                          {"int64", "int64"},
                                                          {"int64_t", "int64"},
                                                          {"ulonglong", "uint64"},
                                                          {"unsigned long long", "uint64"},
                                                          {"unsigned long long int", "uint64"},
                                                          {"uint64", "uint64"},
                                                          {"uint64_t", "uint64"},
                                                          {"float", "float32"},
                                                          {"double", "float64"}};
    const std::string name = field("type");
    const auto known = names.find(to_lower(name));
    return known == names.end() ? name : known->second;
  }

  // Parses vectors such as "(1,0,0) none (0, 1, 0)", each of three numbers or none. Numbers that are NaN mean none.
  std::vector<std::optional<Vec3>> vectors(const std::string& name) const {
    std::vector<std::optional<Vec3>> result;
    std::string_view text = fields_.at(name);
    for (text = trim(text); !text.empty(); text = trim(text)) {
      if (text.starts_with("none")) {
        result.emplace_back();
        text.remove_prefix(4);
        continue;
      }
      const size_t end = text.find(')');
      if (text[0] != '(' || end == std::string_view::npos) fail("has a wrong \"" + name + '"');
      const auto numbers = split(std::string(text.substr(1, end - 1)), ',');
      if (numbers.size() != 3) fail("has vectors in \"" + name + "\" that have not three numbers");
      Vec3 vector;
      for (int axis = 0; axis < 3; ++axis) vector[axis] = number(name, numbers[static_cast<size_t>(axis)]);
      const bool is_none = std::isnan(vector.x) && std::isnan(vector.y) && std::isnan(vector.z);
      result.push_back(is_none ? std::nullopt : std::optional(vector));
      text.remove_prefix(end + 1);
    }
    return result;
  }

  // Reads the axes. Axes of one value that are not axes of space are ignored. The first or last axis, if it is not one
  // of space, contains the values of a voxel.
  Channel read_axes(const VolumeFile& file, VoxelVolume& volume) const {
    const Words sizes = words_of(field("sizes"));
    std::vector<std::optional<Vec3>> directions;
    if (fields_.contains("space directions")) directions = vectors("space directions");
    // The orientation is unknown if no axis has a direction.
    const bool has_directions = std::ranges::any_of(directions, [](const auto& one) { return one.has_value(); });
    if (directions.empty()) directions.resize(sizes.size());
    if (!has_directions) std::ranges::fill(directions, Vec3{});
    const Words spacings = words_of(field_or("spacings", ""));
    if (whole("dimension", field("dimension")) != static_cast<int64_t>(sizes.size()) ||
        directions.size() != sizes.size() || (!spacings.empty() && spacings.size() != sizes.size()))
      fail("has a header whose fields disagree on the number of axes");
    std::vector<int64_t> counts;
    std::vector<Vec3> steps;
    std::vector<double> lengths;
    Channel channel;
    for (size_t axis = 0; axis < sizes.size(); ++axis) {
      const int64_t count = whole("sizes", sizes[axis]);
      const bool is_space = has_directions ? directions[axis].has_value() : is_space_by_kind(axis, sizes.size(), count);
      if (!is_space && count == 1) continue;
      const bool is_at_end = axis == 0 || axis + 1 == sizes.size();
      if (!is_space && (!is_at_end || channel.count > 1))
        fail("has values of voxels along several axes, or in the middle");
      if (!is_space) {
        channel = chosen_channel(file, count, axis != 0);
        continue;
      }
      counts.push_back(count);
      steps.push_back(*directions[axis]);
      if (!spacings.empty()) lengths.push_back(number("spacings", spacings[axis]));
      if (!spacings.empty() && lengths.back() < 0) fail("has a wrong \"spacings\": they must be positive");
    }
    if (counts.size() != 3) fail("has " + std::to_string(counts.size()) + " axes; three are read");
    std::copy(counts.begin(), counts.end(), volume.count.begin());
    read_space(volume);
    if (has_directions)
      volume.space_from_index = placed(steps, volume);
    else if (!lengths.empty() && !std::isnan(lengths[0] + lengths[1] + lengths[2]))
      volume.space_from_index = placed({{lengths[0], 0, 0}, {0, lengths[1], 0}, {0, 0, lengths[2]}}, volume);
    if (!has_directions && (fields_.contains("axis mins") || fields_.contains("axismins")))
      volume.warnings.push_back("the volume \"" + path_ +
                                "\" has \"axis mins\", which are not read; write origin=(x, y, z) where they matter");
    if (channel.count == 1) chosen_channel(file, 1, false);
    return channel;
  }

  // Returns true for an axis of space if there are no directions; "kinds" then distinguishes the axes.
  bool is_space_by_kind(size_t axis, size_t axes, int64_t count) const {
    const Words kinds = words_of(to_lower(field_or("kinds", "")));
    if (kinds.size() == axes) return kinds[axis] == "space" || kinds[axis] == "domain" || kinds[axis] == "???";
    return axes == 3 || count != 1;
  }

  void read_space(VoxelVolume& volume) const {
    if (!fields_.contains("space")) return;
    const auto space = space_called(to_lower(field("space")));
    if (!space) fail("has the space \"" + field("space") + "\", which is none of three dimensions that is read");
    volume.space = *space;
  }

  Affine placed(const std::vector<Vec3>& steps, VoxelVolume& volume) const {
    const double mm = unit_mm();
    Vec3 origin;
    if (fields_.contains("space origin")) {
      const auto found = vectors("space origin");
      if (found.size() != 1) fail("has a wrong \"space origin\"");
      if (!found[0])
        volume.warnings.push_back("the volume \"" + path_ +
                                  "\" has an unknown \"space origin\"; its first voxel is put at the origin");
      origin = found[0].value_or(Vec3{});
    }
    Affine map;
    for (int row = 0; row < 3; ++row)
      for (int axis = 0; axis < 3; ++axis)
        map.rows[static_cast<size_t>(row)][axis] = mm * steps[static_cast<size_t>(axis)][row];
    map.offset = mm * origin;
    check_placement(path_, map);
    return map;
  }

  double unit_mm() const {
    static const std::map<std::string, double> units{{"", 1},          {"mm", 1},         {"millimeter", 1},
                                                     {"cm", 10},       {"m", 1000},       {"um", 1e-3},
                                                     {"micron", 1e-3}, {"microns", 1e-3}, {"\xC2\xB5m", 1e-3}};
    std::optional<double> mm;
    std::string text = field_or("space units", "");
    std::replace(text.begin(), text.end(), '"', ' ');
    for (const std::string& word : words_of(text)) {
      const auto unit = units.find(to_lower(word));
      if (unit == units.end()) fail("has lengths in \"" + word + "\"; mm, cm, m and um are read");
      if (mm && *mm != unit->second) fail("has lengths in different units");
      mm = unit->second;
    }
    return mm.value_or(1);
  }

  void read_numbers(const VolumeFile& file, std::string_view bytes, const Channel& channel, VoxelVolume& volume) const {
    const std::string encoding = to_lower(field("encoding"));
    for (int64_t lines = whole("line skip", field_or("line skip", field_or("lineskip", "0"))); lines > 0; --lines)
      bytes.remove_prefix(bytes.find('\n') == std::string_view::npos ? bytes.size() : bytes.find('\n') + 1);
    if (encoding == "txt" || encoding == "text" || encoding == "ascii") return read_text(bytes, channel, volume);
    const uint64_t size =
        voxel_bytes(path_, volume.count, bytes_per_value(volume.values)) * static_cast<uint64_t>(channel.count);
    const int64_t skip = whole("byte skip", field_or("byte skip", field_or("byteskip", "0")));
    const bool is_big = is_big_endian(bytes_per_value(volume.values));
    if (encoding == "gzip" || encoding == "gz") {
      if (skip != 0) fail("has a \"byte skip\" before packed numbers; save it without");
      check_room(path_, size);
      return take_own_numbers(file, unpacked(path_, bytes, Packing::gzip, size), is_big, channel, volume);
    }
    if (encoding != "raw") fail("has the encoding \"" + encoding + "\"; save it as raw, gzip or ascii");
    const uint64_t before =
        skip == -1 ? bytes.size() - std::min<uint64_t>(size, bytes.size()) : static_cast<uint64_t>(skip);
    if (skip < -1 || before > bytes.size()) fail("has a wrong \"byte skip\"");
    take_numbers(file, bytes.substr(before), is_big, channel, volume);
  }

  bool is_big_endian(size_t bytes_per_number) const {
    if (bytes_per_number == 1) return false;
    const std::string endian = to_lower(field("endian"));
    if (endian != "little" && endian != "big") fail("has a wrong \"endian\"; little and big are possible");
    return endian == "big";
  }

  void read_text(std::string_view bytes, const Channel& channel, VoxelVolume& volume) const {
    if (channel.count > 1) fail("has several values in each voxel as text; save it as raw or gzip");
    const auto count = static_cast<size_t>(volume.count[0] * volume.count[1] * volume.count[2]);
    if (bytes.size() / 2 + 1 < count) fail("is cut off: its text has too few numbers");
    std::visit(
        [&](auto& list) {
          using T = std::remove_reference_t<decltype(list[0])>;
          constexpr std::string_view blanks = " \t\r\n,";
          while (list.size() < count) {
            const size_t begin = std::min(bytes.find_first_not_of(blanks), bytes.size());
            bytes.remove_prefix(begin);
            const size_t end = std::min(bytes.find_first_of(blanks), bytes.size());
            if (end == 0) fail("is cut off: its text has too few numbers");
            list.push_back(number_of_text<T>(path_, volume.type, number("number", bytes.substr(0, end))));
            bytes.remove_prefix(end);
          }
        },
        volume.values);
    if (volume.type.ends_with("int64")) narrow_integers(volume);
  }

  std::map<std::string, std::string> notes_;
};

}  // namespace

std::string nrrd_data_path(const std::string& path, std::string_view bytes) {
  const std::string name = NrrdReader(path, bytes).data_file();
  return name.empty() ? "" : (fs::path(path).parent_path() / name).string();
}

std::vector<VolumeSegment> nrrd_segments(const std::string& path, std::string_view bytes) {
  return NrrdReader(path, bytes).segments();
}

VoxelVolume read_nrrd(const VolumeFile& file) { return NrrdReader(file.path, file.bytes).read(file); }

}  // namespace ombre::formats
