// Selects the reader for a mesh file.
#include "formats/packages/read_mesh.h"

#include <filesystem>

#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "formats/containers/file.h"
#include "formats/containers/file_kinds.h"
#include "formats/packages/mesh_formats.h"

namespace ombre::formats {
namespace {

void report_unknown(const std::string& name, Diagnostics& diagnostics) {
  diagnostics.error(Code::file_kind, {make_source(name, ""), 0, 0},
                    "neither the name nor the content tells which mesh format this is",
                    "name the file " + words_text(read_mesh_endings()), {{"file", name}});
}

// Returns the format that the content, or else the name tells; null, with the reason in the diagnostics.
const MeshFormat* format_of(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  const std::string ending = ending_of(name);
  for (const MeshFormat& format : mesh_formats())
    if (format.recognises && format.recognises(bytes, ending)) return &format;
  if (const auto foreign = foreign_file(bytes)) {
    const std::string hint =
        foreign->is_other_mesh ? "export a mesh: " + words_text(read_mesh_endings()) : foreign->hint;
    diagnostics.error(Code::file_kind, {make_source(name, ""), 0, 0}, "this is no mesh file but " + foreign->what, hint,
                      {{"file", name}});
    return nullptr;
  }
  const MeshFormat* format = find_mesh_format(name);
  if (format && format->read) return format;
  report_unknown(name, diagnostics);
  return nullptr;
}

}  // namespace

std::optional<Mesh> read_mesh(const std::string& path, Diagnostics& diagnostics) {
  const std::string bytes = read_file(path);
  FilesBeside files;
  const NamesOfFiles names = files_of_mesh(path);
  for (const std::string& name : names ? names(path, bytes) : std::vector<std::string>())
    files[name] =
        std::make_shared<const std::string>(read_file((std::filesystem::path(path).parent_path() / name).string()));
  return read_mesh(path, bytes, diagnostics, files);
}

std::optional<Mesh> read_mesh(const std::string& name, std::string_view bytes, Diagnostics& diagnostics,
                              const FilesBeside& files) {
  const MeshFormat* const format = format_of(name, bytes, diagnostics);
  if (!format) return std::nullopt;
  return format->read_with ? format->read_with(name, bytes, files, diagnostics)
                           : format->read(name, bytes, diagnostics);
}

NamesOfFiles files_of_mesh(const std::string& path) {
  const MeshFormat* const format = find_mesh_format(path);
  return format ? format->files_beside : nullptr;
}

}  // namespace ombre::formats
