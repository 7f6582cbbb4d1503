// The formats of triangle meshes: one table for readers, writers and messages.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/file_format.h"
#include "formats/mesh/files_beside.h"
#include "formats/mesh/mesh.h"
#include "formats/packages/package_writers.h"

namespace ombre::formats {

// A format is read where `read` is set, and written where `bytes` or `write_package` is.
struct MeshFormat {
  std::string_view name;
  std::string_view ending;      // ".3mf"
  bool holds_bodies = false;    // says which triangles belong to which body
  bool holds_colours = false;   // has colours of vertices
  bool holds_beams = false;     // has struts beside triangles
  bool holds_settings = false;  // has settings of slicers
  bool is_archive = false;      // a zip archive, which needs libzip
  // True if the content shows for certain that a file has this format; null where only the ending tells.
  bool (*recognises)(std::string_view bytes, const std::string& ending) = nullptr;
  std::optional<Mesh> (*read)(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) = nullptr;
  // A format may keep what its meshes need in files beside them. Then these return the files' relative paths, and read
  // with them.
  std::vector<std::string> (*files_beside)(const std::string& name, std::string_view bytes) = nullptr;
  std::optional<Mesh> (*read_with)(const std::string& name, std::string_view bytes, const FilesBeside& files,
                                   Diagnostics& diagnostics) = nullptr;
  // The path is the file's own, for formats whose content names other files.
  LazyBytes (*bytes)(const MeshDocument& document, const std::string& path) = nullptr;
  // A second file, which lies beside the first where the document has materials: its ending and its content.
  std::string_view companion_ending = {};
  LazyBytes (*companion_bytes)(const MeshDocument& document) = nullptr;
  // Writes the file itself. Throws what write_3mf() throws.
  void (*write_package)(const std::string& path, const MeshDocument& document, SlicerFlavour flavour) = nullptr;

  bool is_written() const { return bytes || write_package; }
};

// Sorted by endings. Contents are compared in this order.
std::span<const MeshFormat> mesh_formats();
// Returns the format that the ending of the path names, or null.
const MeshFormat* find_mesh_format(const std::string& path);

// ".3mf", ".amf", ...
std::vector<std::string> read_mesh_endings();
std::vector<std::string> written_mesh_endings();
// The endings of formats that are written and have the property, such as &MeshFormat::holds_bodies.
std::vector<std::string> mesh_endings_with(bool MeshFormat::*property);

std::vector<FileFormat> mesh_file_formats();

}  // namespace ombre::formats
