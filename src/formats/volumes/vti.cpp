#include "formats/volumes/vti.h"

#include "base/text/text.h"
#include "formats/containers/xml_text.h"

namespace ombre::formats {
namespace {

constexpr uint64_t length_bytes = 8;

uint64_t array_bytes(const VtiGrid& grid, size_t array) { return grid.voxels() * grid.arrays[array].bytes_per_voxel(); }

std::string numbers(Vec3 v) { return format_number(v.x) + " " + format_number(v.y) + " " + format_number(v.z); }

std::string array_text(const VtiGrid& grid, size_t n) {
  const VtiArray& array = grid.arrays[n];
  std::string text = std::string("        <DataArray type=\"") + (array.is_float ? "Float32" : "UInt8") + "\" Name=\"" +
                     xml_escaped(array.name) + "\"";
  if (array.components.size() > 1) {
    text += " NumberOfComponents=\"" + std::to_string(array.components.size()) + "\"";
    for (size_t c = 0; c < array.components.size(); ++c)
      text += " ComponentName" + std::to_string(c) + "=\"" + xml_escaped(array.components[c]) + "\"";
  }
  return text + " format=\"appended\" offset=\"" + std::to_string(vti_offset(grid, n) - length_bytes) + "\"/>\n";
}

// Returns a valid XML comment, which cannot contain two consecutive hyphens.
std::string comment(std::string text) {
  for (size_t at = text.find("--"); at != std::string::npos; at = text.find("--")) text.replace(at, 2, "- -");
  if (!text.empty() && text.back() == '-') text += ' ';
  return text;
}

}  // namespace

uint64_t VtiGrid::voxels() const {
  return static_cast<uint64_t>(count[0]) * static_cast<uint64_t>(count[1]) * static_cast<uint64_t>(count[2]);
}

uint64_t vti_offset(const VtiGrid& grid, size_t array) {
  uint64_t offset = length_bytes;
  for (size_t n = 0; n < array; ++n) offset += array_bytes(grid, n) + length_bytes;
  return offset;
}

std::string vti_header(const VtiGrid& grid) {
  std::string extent;
  for (const int64_t length : grid.count) extent += (extent.empty() ? "0 " : " 0 ") + std::to_string(length);
  std::string text = "<?xml version=\"1.0\"?>\n";
  if (!grid.note.empty()) text += "<!-- " + comment(grid.note) + " -->\n";
  text +=
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "  <ImageData WholeExtent=\"" +
      extent + "\" Origin=\"" + numbers(grid.corner_mm) + "\" Spacing=\"" + numbers(grid.spacing_mm) +
      "\">\n    <Piece Extent=\"" + extent + "\">\n      <CellData>\n";
  for (size_t n = 0; n < grid.arrays.size(); ++n) text += array_text(grid, n);
  return text + "      </CellData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_";
}

std::string vti_end() { return "\n  </AppendedData>\n</VTKFile>\n"; }

}  // namespace ombre::formats
