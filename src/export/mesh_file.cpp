#include "export/mesh_file.h"

#include <filesystem>
#include <system_error>

#include "base/text/error.h"
#include "export/output_file.h"

namespace ombre::exporting {
namespace {

namespace fs = std::filesystem;
using formats::LazyBytes;
using formats::MeshDocument;

void append_to(NewFile& file, const LazyBytes& bytes) {
  bytes.write([&file](std::string_view piece) { file.append(piece); });
  file.close();
}

void write_bytes(const std::string& path, const LazyBytes& bytes) {
  NewFile file(path);
  append_to(file, bytes);
  file.commit();
}

void write_both(const std::string& path, const LazyBytes& bytes, const std::string& beside,
                const LazyBytes& companion) {
  NewFile second(beside), first(path);
  append_to(second, companion);
  append_to(first, bytes);
  second.commit();
  try {
    first.commit();
  } catch (const Error&) {
    fs::remove(beside);  // half of a mesh is none
    throw;
  }
}

void write_archive(const std::string& path, const MeshDocument& document, const MeshFormat& format,
                   formats::SlicerFlavour flavour) {
  PendingFile file(path);
  try {
    format.write_package(file.part(), document, flavour);
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

std::string companion_path(const std::string& path, const MeshFormat& format) {
  if (format.companion_ending.empty()) return "";
  return fs::path(path).replace_extension(format.companion_ending).string();
}

void write_mesh_file(const std::string& path, const MeshDocument& document, const MeshFormat& format,
                     formats::SlicerFlavour flavour) {
  if (document.triangle_count() + document.beam_count() == 0)
    throw Error(Code::cannot_write, "cannot write " + path + ": there are no triangles", {{"file", path}});
  if (format.write_package) return write_archive(path, document, format, flavour);
  const LazyBytes bytes = format.bytes(document, path);
  if (!format.companion_bytes || document.materials.empty()) return write_bytes(path, bytes);
  write_both(path, bytes, companion_path(path, format), format.companion_bytes(document));
}

}  // namespace ombre::exporting
