// Finds the reader for a mesh file.
#include "formats/mesh.h"

#include <filesystem>

#include "base/text.h"
#include "formats/file.h"
#include "formats/text_scanner.h"

namespace ombre::formats {
namespace {

constexpr std::string_view zip_signature = "PK\x03\x04";

std::string extension(const std::string& name) { return to_lower(std::filesystem::path(name).extension().string()); }

std::optional<Mesh> report_unknown(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  if (bytes.substr(0, zip_signature.size()) == zip_signature)
    diagnostics.error({make_source(name, ""), 0, 0},
                      "this is a zip archive (3MF and AMF files are), which cannot be read as a mesh",
                      "save the mesh as STL, OBJ, PLY or OFF");
  else
    diagnostics.error({make_source(name, ""), 0, 0}, "neither the name nor the content tells which mesh format this is",
                      "name the file .stl, .obj, .ply or .off");
  return std::nullopt;
}

}  // namespace

std::optional<Mesh> read_mesh(const std::string& path, Diagnostics& diagnostics) {
  return read_mesh(path, read_file(path), diagnostics);
}

std::optional<Mesh> read_mesh(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  if (is_ply(bytes)) return read_ply(name, bytes, diagnostics);
  if (is_off(bytes)) return read_off(name, bytes, diagnostics);
  if (is_stl(bytes)) return read_stl(name, bytes, diagnostics);

  const std::string ending = extension(name);
  if (ending == ".obj") return read_obj(name, bytes, diagnostics);
  if (ending == ".stl") return read_stl(name, bytes, diagnostics);
  if (ending == ".ply") return read_ply(name, bytes, diagnostics);
  if (ending == ".off") return read_off(name, bytes, diagnostics);
  return report_unknown(name, bytes, diagnostics);
}

}  // namespace ombre::formats
