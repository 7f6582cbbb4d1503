// Selects the reader for a mesh file.
#include "formats/packages/read_mesh.h"

#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "formats/containers/file.h"
#include "formats/containers/file_kinds.h"
#include "formats/packages/mesh_formats.h"

namespace ombre::formats {
namespace {

std::optional<Mesh> report_unknown(const std::string& name, Diagnostics& diagnostics) {
  diagnostics.error(Code::file_kind, {make_source(name, ""), 0, 0},
                    "neither the name nor the content tells which mesh format this is",
                    "name the file " + words_text(read_mesh_endings()), {{"file", name}});
  return std::nullopt;
}

}  // namespace

std::optional<Mesh> read_mesh(const std::string& path, Diagnostics& diagnostics) {
  return read_mesh(path, read_file(path), diagnostics);
}

std::optional<Mesh> read_mesh(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  const std::string ending = ending_of(name);
  for (const MeshFormat& format : mesh_formats())
    if (format.recognises && format.recognises(bytes, ending)) return format.read(name, bytes, diagnostics);
  if (const auto foreign = foreign_file(bytes)) {
    const std::string hint =
        foreign->is_other_mesh ? "export a mesh: " + words_text(read_mesh_endings()) : foreign->hint;
    diagnostics.error(Code::file_kind, {make_source(name, ""), 0, 0}, "this is no mesh file but " + foreign->what, hint,
                      {{"file", name}});
    return std::nullopt;
  }
  const MeshFormat* format = find_mesh_format(name);
  if (format && format->read) return format->read(name, bytes, diagnostics);
  return report_unknown(name, diagnostics);
}

}  // namespace ombre::formats
