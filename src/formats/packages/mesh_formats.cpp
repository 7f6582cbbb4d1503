#include "formats/packages/mesh_formats.h"

#include <algorithm>
#include <filesystem>

#include "base/text/file_ending.h"
#include "formats/containers/zip_archive.h"
#include "formats/mesh/mesh_writers.h"
#include "formats/packages/package_readers.h"

namespace ombre::formats {
namespace {

// True if the outermost element, behind a declaration and comments, is that of AMF.
bool is_amf_text(std::string_view bytes) {
  constexpr size_t sniffed_bytes = 1024;
  const size_t first = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first == std::string_view::npos || bytes[first] != '<') return false;
  const std::string_view beginning = bytes.substr(first, sniffed_bytes);
  return beginning.find("<amf>") != std::string_view::npos || beginning.find("<amf ") != std::string_view::npos;
}

bool is_amf(std::string_view bytes, const std::string& ending) {
  return is_zip(bytes) ? ending == ".amf" : is_amf_text(bytes);
}
bool is_3mf(std::string_view bytes, const std::string& ending) { return is_zip(bytes) && ending != ".amf"; }

// JSON is a mesh only where the ending says so.
bool is_gltf_text(std::string_view bytes, const std::string& ending) {
  const size_t first = bytes.find_first_not_of(" \t\r\n");
  return ending == ".gltf" && first != std::string_view::npos && bytes[first] == '{';
}

template <bool test(std::string_view)>
bool by_content(std::string_view bytes, const std::string&) {
  return test(bytes);
}
template <LazyBytes write(const MeshDocument&)>
LazyBytes bytes_of(const MeshDocument& document, const std::string&) {
  return write(document);
}
LazyBytes obj_with_library(const MeshDocument& document, const std::string& path) {
  return obj_bytes(document, std::filesystem::path(path).replace_extension(".mtl").filename().string());
}

constexpr MeshFormat rows[]{
    {.name = "3MF",
     .ending = ".3mf",
     .holds_bodies = true,
     .holds_colours = true,
     .holds_beams = true,
     .holds_settings = true,
     .is_archive = true,
     .recognises = is_3mf,
     .read = read_3mf,
     .write_package = write_3mf},
    {.name = "AMF",
     .ending = ".amf",
     .holds_bodies = true,
     .holds_colours = true,
     .holds_settings = true,
     .recognises = is_amf,
     .read = read_amf,
     .bytes = bytes_of<amf_bytes>},
    {.name = "binary glTF",
     .ending = ".glb",
     .holds_bodies = true,
     .holds_colours = true,
     .recognises = by_content<is_glb>,
     .read = read_gltf,
     .files_beside = gltf_buffer_files,
     .read_with = read_gltf,
     .bytes = bytes_of<glb_bytes>},
    {.name = "glTF",
     .ending = ".gltf",
     .recognises = is_gltf_text,
     .read = read_gltf,
     .files_beside = gltf_buffer_files,
     .read_with = read_gltf},
    {.name = "Wavefront OBJ",
     .ending = ".obj",
     .holds_bodies = true,
     .holds_colours = true,
     .read = read_obj,
     .bytes = obj_with_library,
     .companion_ending = ".mtl",
     .companion_bytes = mtl_bytes},
    {.name = "OFF", .ending = ".off", .recognises = by_content<is_off>, .read = read_off, .bytes = bytes_of<off_bytes>},
    {.name = "PLY",
     .ending = ".ply",
     .holds_colours = true,
     .recognises = by_content<is_ply>,
     .read = read_ply,
     .bytes = bytes_of<ply_bytes>},
    {.name = "STL", .ending = ".stl", .recognises = by_content<is_stl>, .read = read_stl, .bytes = bytes_of<stl_bytes>},
};

}  // namespace

std::span<const MeshFormat> mesh_formats() { return rows; }

const MeshFormat* find_mesh_format(const std::string& path) {
  const auto* found = std::ranges::find(rows, ending_of(path), &MeshFormat::ending);
  return found == std::end(rows) ? nullptr : found;
}

std::vector<std::string> read_mesh_endings() {
  std::vector<std::string> endings;
  for (const MeshFormat& row : rows)
    if (row.read) endings.emplace_back(row.ending);
  return endings;
}

std::vector<std::string> written_mesh_endings() {
  std::vector<std::string> endings;
  for (const MeshFormat& row : rows)
    if (row.is_written()) endings.emplace_back(row.ending);
  return endings;
}

std::vector<std::string> mesh_endings_with(bool MeshFormat::*property) {
  std::vector<std::string> endings;
  for (const MeshFormat& row : rows)
    if (row.is_written() && row.*property) endings.emplace_back(row.ending);
  return endings;
}

std::vector<FileFormat> mesh_file_formats() {
  std::vector<FileFormat> formats;
  for (const MeshFormat& row : rows)
    formats.push_back({row.name,
                       {row.ending},
                       Content::mesh,
                       row.read != nullptr,
                       row.is_written(),
                       row.is_archive ? &zip_module : nullptr});
  return formats;
}

}  // namespace ombre::formats
