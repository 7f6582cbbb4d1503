#include "export/mesh_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/mesh/mesh_writers.h"
#include "formats/packages/package_writers.h"

namespace ombre::exporting {
namespace {

namespace fs = std::filesystem;
using formats::LazyBytes;
using formats::MeshDocument;

struct Ending {
  std::string_view text;
  MeshFormat format;
  bool holds_bodies;
};
constexpr std::array<Ending, 7> endings{{{".3mf", MeshFormat::three_mf, true},
                                         {".amf", MeshFormat::amf, true},
                                         {".glb", MeshFormat::glb, true},
                                         {".obj", MeshFormat::obj, true},
                                         {".off", MeshFormat::off, false},
                                         {".ply", MeshFormat::ply, false},
                                         {".stl", MeshFormat::stl, false}}};

void append_to(NewFile& file, const LazyBytes& bytes) {
  bytes.write([&file](std::string_view piece) { file.append(piece); });
  file.close();
}

void write_bytes(const std::string& path, const LazyBytes& bytes) {
  NewFile file(path);
  append_to(file, bytes);
  file.commit();
}

void write_obj(const std::string& path, const MeshDocument& document) {
  const std::string library = material_library_path(path);
  const LazyBytes bytes = formats::obj_bytes(document, fs::path(library).filename().string());
  if (document.materials.empty()) return write_bytes(path, bytes);
  NewFile materials(library), file(path);
  append_to(materials, formats::mtl_bytes(document));
  append_to(file, bytes);
  materials.commit();
  file.commit();
}

void write_archive(const std::string& path, const MeshDocument& document, formats::SlicerFlavour flavour) {
  PendingFile file(path);
  try {
    formats::write_3mf(file.part(), document, flavour);
  } catch (const std::system_error& error) {
    throw write_error(path, error.code().value());
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw Error(Code::cannot_write, "cannot write " + path + ": " + error.what(), {{"file", path}});
  }
  file.commit();
}

}  // namespace

std::optional<MeshFormat> mesh_format_of(const std::string& path) {
  const std::string wanted = ending_of(path);
  for (const Ending& ending : endings)
    if (ending.text == wanted) return ending.format;
  return std::nullopt;
}

std::string mesh_endings() {
  std::vector<std::string> texts;
  for (const Ending& ending : endings) texts.emplace_back(ending.text);
  return join(texts, ", ");
}

bool holds_bodies(MeshFormat format) { return std::ranges::find(endings, format, &Ending::format)->holds_bodies; }

std::string endings_with_bodies() {
  std::vector<std::string> texts;
  for (const Ending& ending : endings)
    if (ending.holds_bodies) texts.emplace_back(ending.text);
  return join(texts, ", ");
}

std::string material_library_path(const std::string& path) { return fs::path(path).replace_extension(".mtl").string(); }

void write_mesh_file(const std::string& path, const MeshDocument& document, MeshFormat format,
                     formats::SlicerFlavour flavour) {
  if (document.triangle_count() + document.beam_count() == 0)
    throw Error(Code::cannot_write, "cannot write " + path + ": there are no triangles", {{"file", path}});
  switch (format) {
    case MeshFormat::stl:
      return write_bytes(path, formats::stl_bytes(document));
    case MeshFormat::obj:
      return write_obj(path, document);
    case MeshFormat::ply:
      return write_bytes(path, formats::ply_bytes(document));
    case MeshFormat::off:
      return write_bytes(path, formats::off_bytes(document));
    case MeshFormat::amf:
      return write_bytes(path, formats::amf_bytes(document));
    case MeshFormat::three_mf:
      return write_archive(path, document, flavour);
    case MeshFormat::glb:
      return write_bytes(path, formats::glb_bytes(document));
  }
}

}  // namespace ombre::exporting
