// Reads image data in VTK's XML files (.vti): one of their arrays, of points or cells.
#ifdef OMBRE_3MF

#include <cmath>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/volumes/volume_parts.h"
#include "formats/volumes/vtk_arrays.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

class VtiReader {
 public:
  VtiReader(const VolumeFile& file, Diagnostics& diagnostics)
      : file_(file), arrays_(file.path, file.bytes, diagnostics), xml_(arrays_.file()) {}

  VoxelVolume run() {
    const xml_node root = xml_.root("VTKFile");
    arrays_.read_settings(root);
    const xml_node image = root.child("ImageData"), piece = image.child("Piece");
    if (!image || !piece) xml_.fail_at(root, "this file holds no image data", "save it as .vti");
    if (piece.next_sibling("Piece")) xml_.fail_at(image, "the image data lie in several pieces", "join them");
    const Found found = chosen_array(piece);
    VoxelVolume volume;
    const std::vector<double> extent = three(piece, "Extent", 6);
    Vec3 first;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = extent[2 * static_cast<size_t>(axis)], high = extent[2 * static_cast<size_t>(axis) + 1];
      constexpr double most = 1e9;
      if (!(std::abs(low) <= most && std::abs(high) <= most) || low != std::floor(low) || high != std::floor(high))
        xml_.fail_at(piece, "the extent is no list of whole numbers");
      volume.count[static_cast<size_t>(axis)] = static_cast<int64_t>(high - low) + (found.is_of_cells ? 0 : 1);
      first[axis] = low + (found.is_of_cells ? 0.5 : 0);
    }
    place(image, first, volume);
    take(found.array, volume);
    return volume;
  }

 private:
  struct Found {
    xml_node array;
    bool is_of_cells = false;
  };

  Found chosen_array(xml_node piece) const {
    std::vector<Found> all;
    for (const bool is_of_cells : {false, true})
      for (const xml_node array : piece.child(is_of_cells ? "CellData" : "PointData").children("DataArray"))
        if (xml_.attribute(array, "type") != "String") all.push_back({array, is_of_cells});
    if (all.empty()) fail_volume(file_.path, "holds no arrays");
    std::string names;
    for (const Found& found : all) {
      const std::string name(xml_.attribute(found.array, "Name").value_or(""));
      if (name == file_.choice.name || (all.size() == 1 && file_.choice.name.empty())) return found;
      names += (names.empty() ? "" : ", ") + name;
    }
    if (file_.choice.name.empty())
      fail_volume(file_.path, "holds several arrays: " + names + "; choose one by series=\"" +
                                  std::string(xml_.attribute(all[0].array, "Name").value_or("")) + '"');
    fail_volume(file_.path, "holds no array \"" + file_.choice.name + "\"; it holds " + names);
  }

  std::vector<double> three(xml_node node, std::string_view name, size_t count) const {
    std::string_view text = xml_.required(node, name);
    std::vector<double> numbers;
    for (std::string_view word = next_word(text); !word.empty(); word = next_word(text))
      numbers.push_back(xml_.number(node, word, name));
    if (numbers.size() != count)
      xml_.fail_at(node, std::string(name) + " has " + std::to_string(numbers.size()) + " numbers; expected are " +
                             std::to_string(count));
    return numbers;
  }

  void place(xml_node image, Vec3 first, VoxelVolume& volume) const {
    const auto given = [&](const char* name, double otherwise) {
      return xml_.attribute(image, name) ? three(image, name, 3) : std::vector<double>(3, otherwise);
    };
    const std::vector<double> spacing = given("Spacing", 1), origin = given("Origin", 0);  // VTK's defaults
    Affine map;
    if (xml_.attribute(image, "Direction")) {
      const std::vector<double> rows = three(image, "Direction", 9);
      for (size_t row = 0; row < 3; ++row) map.rows[row] = {rows[3 * row], rows[3 * row + 1], rows[3 * row + 2]};
    }
    for (size_t axis = 0; axis < 3; ++axis)
      if (!(spacing[axis] > 0)) fail_volume(file_.path, "has voxels of " + format_number(spacing[axis]) + " mm");
    map = map * Affine::scaling({spacing[0], spacing[1], spacing[2]});
    map.offset = {origin[0], origin[1], origin[2]};
    map.offset = map(first);
    check_placement(file_.path, map);
    volume.space_from_index = map;
    volume.space = VolumeSpace::right_handed;
  }

  static std::string type_name(VtkArrays::Kind kind) {
    return (kind.family == 'f' ? "float" : kind.family == 'i' ? "int" : "uint") + std::to_string(8 * kind.bytes);
  }

  void take(xml_node array, VoxelVolume& volume) const {
    const VtkArrays::Kind kind = arrays_.kind_of(array);
    volume.type = type_name(kind);
    volume.values = values_of_type(file_.path, volume.type);
    const uint64_t values = xml_.count(array, xml_.attribute(array, "NumberOfComponents").value_or("1"), "a number");
    constexpr uint64_t most_values = 1000;
    if (values > most_values) xml_.fail_at(array, "the array has more than 1000 values in each voxel");
    const Channel channel = chosen_channel(file_, static_cast<int64_t>(values), false);
    const uint64_t size = voxel_bytes(file_.path, volume.count, kind.bytes) * values, count = size / kind.bytes;
    if (xml_.attribute(array, "format").value_or("ascii") == "ascii")
      return take_text(arrays_.numbers(array, count), channel, volume);
    if (const auto bytes = arrays_.bytes_in_file(array, count))
      return take_numbers(file_, *bytes, false, channel, volume);
    check_room(file_.path, size);
    take_own_numbers(file_, arrays_.bytes_of(array, count), false, channel, volume);
  }

  void take_text(const std::vector<double>& numbers, const Channel& channel, VoxelVolume& volume) const {
    volume.channels = channel.count;
    std::visit(
        [&]<class T>(std::vector<T>& list) {
          for (auto n = static_cast<size_t>(channel.chosen); n < numbers.size();
               n += static_cast<size_t>(channel.count)) {
            list.push_back(number_of_text<T>(file_.path, volume.type, numbers[n]));
          }
        },
        volume.values);
    if (volume.type.ends_with("int64")) narrow_integers(volume);
  }

  const VolumeFile& file_;
  VtkArrays arrays_;
  const XmlFile& xml_;
};

}  // namespace

VoxelVolume read_vti(const VolumeFile& file) {
  Diagnostics diagnostics;
  try {
    return VtiReader(file, diagnostics).run();
  } catch (const DesignError&) {
    const Diagnostic& wrong = diagnostics.list().front();
    fail_volume(file.path, "cannot be read: " + sentence_of(wrong));
  }
}

}  // namespace ombre::formats

#endif
