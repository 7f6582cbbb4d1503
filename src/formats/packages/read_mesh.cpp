// Selects the reader for a mesh file.
#include "formats/packages/read_mesh.h"

#include "base/text/file_ending.h"
#include "formats/containers/file.h"
#include "formats/containers/file_kinds.h"
#include "formats/containers/zip_archive.h"
#include "formats/packages/package_readers.h"

namespace ombre::formats {
namespace {

// Finds the root element after a declaration and comments.
bool is_amf(std::string_view bytes) {
  constexpr size_t sniffed_bytes = 1024;
  const size_t first = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first == std::string_view::npos || bytes[first] != '<') return false;
  const std::string_view beginning = bytes.substr(first, sniffed_bytes);
  return beginning.find("<amf>") != std::string_view::npos || beginning.find("<amf ") != std::string_view::npos;
}

std::optional<Mesh> report_unknown(const std::string& name, Diagnostics& diagnostics) {
  diagnostics.error(Code::file_kind, {make_source(name, ""), 0, 0},
                    "neither the name nor the content tells which mesh format this is",
                    "name the file .stl, .obj, .ply, .off, .3mf or .amf", {{"file", name}});
  return std::nullopt;
}

}  // namespace

std::optional<Mesh> read_mesh(const std::string& path, Diagnostics& diagnostics) {
  return read_mesh(path, read_file(path), diagnostics);
}

std::optional<Mesh> read_mesh(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  const std::string ending = ending_of(name);
  if (is_ply(bytes)) return read_ply(name, bytes, diagnostics);
  if (is_off(bytes)) return read_off(name, bytes, diagnostics);
  if (is_zip(bytes)) return ending == ".amf" ? read_amf(name, bytes, diagnostics) : read_3mf(name, bytes, diagnostics);
  if (is_amf(bytes)) return read_amf(name, bytes, diagnostics);
  if (is_stl(bytes)) return read_stl(name, bytes, diagnostics);
  if (const auto foreign = foreign_file(bytes)) {
    diagnostics.error(Code::file_kind, {make_source(name, ""), 0, 0}, "this is no mesh file but " + foreign->what,
                      foreign->hint, {{"file", name}});
    return std::nullopt;
  }

  if (ending == ".obj") return read_obj(name, bytes, diagnostics);
  if (ending == ".stl") return read_stl(name, bytes, diagnostics);
  if (ending == ".ply") return read_ply(name, bytes, diagnostics);
  if (ending == ".off") return read_off(name, bytes, diagnostics);
  if (ending == ".3mf") return read_3mf(name, bytes, diagnostics);
  if (ending == ".amf") return read_amf(name, bytes, diagnostics);
  return report_unknown(name, diagnostics);
}

}  // namespace ombre::formats
