#include "formats/volumes/nrrd.h"

#include "base/text/text.h"

namespace ombre::formats {
namespace {

std::string vector_text(Vec3 v) {
  return '(' + format_number(v.x) + ',' + format_number(v.y) + ',' + format_number(v.z) + ')';
}

// Escapes a value, which must be one line.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? "\\n" : c == '\\' ? "\\\\" : std::string(1, c);
  return result;
}

}  // namespace

std::string nrrd_header(const NrrdHeader& header) {
  const auto& [nx, ny, nz] = header.count;
  const Vec3 step = header.spacing_mm;
  std::string text = "NRRD0004\n";
  text += "type: " + header.type + '\n';
  text += "dimension: 3\n";
  text += "space: 3D-right-handed\n";
  text += "sizes: " + std::to_string(nx) + ' ' + std::to_string(ny) + ' ' + std::to_string(nz) + '\n';
  text += "space directions: " + vector_text({step.x, 0, 0}) + ' ' + vector_text({0, step.y, 0}) + ' ' +
          vector_text({0, 0, step.z}) + '\n';
  text += "kinds: domain domain domain\n";
  text += "endian: little\n";
  text += std::string("encoding: ") + (header.is_gzip ? "gzip" : "raw") + '\n';
  text += "space units: \"mm\" \"mm\" \"mm\"\n";
  text += "space origin: " + vector_text(header.origin_mm) + '\n';
  for (const auto& [key, value] : header.notes) text += escaped(key) + ":=" + escaped(value) + '\n';
  return text + '\n';
}

}  // namespace ombre::formats
