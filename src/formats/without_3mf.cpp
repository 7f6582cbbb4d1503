// What 3MF and AMF are in builds without libzip and pugixml: messages.
#ifndef OMBRE_3MF

#include "base/error.h"
#include "formats/mesh.h"
#include "formats/mesh_writers.h"
#include "formats/results_readers.h"
#include "formats/text_scanner.h"
#include "formats/volume_parts.h"
#include "formats/zip_archive.h"

namespace ombre::formats {
namespace {

constexpr const char* missing = "this ombre was built without libzip and pugixml";
constexpr const char* remedy = "install libzip-dev and libpugixml-dev, configure with -DOMBRE_3MF=ON and build again";

std::optional<Mesh> report(const std::string& name, const std::string& format, Diagnostics& diagnostics) {
  diagnostics.error(Code::library_missing, {make_source(name, ""), 0, 0}, format + " files cannot be read: " + missing,
                    remedy);
  return std::nullopt;
}

}  // namespace

std::optional<Mesh> read_3mf(const std::string& name, std::string_view, Diagnostics& diagnostics) {
  return report(name, "3MF", diagnostics);
}

std::optional<Mesh> read_amf(const std::string& name, std::string_view, Diagnostics& diagnostics) {
  return report(name, "AMF", diagnostics);
}

Results read_vtu(const std::string& name, std::string_view, Diagnostics& diagnostics) {
  fail(diagnostics, name, std::string("VTU files cannot be read: ") + missing, remedy);
}

VoxelVolume read_vti(const VolumeFile& file) {
  fail_volume(file.path, std::string("is VTK image data, and ") + missing + "; " + remedy);
}

Results read_xdmf(const std::string& name, std::string_view, const std::optional<ResultsFile>&,
                  Diagnostics& diagnostics) {
  fail(diagnostics, name, std::string("XDMF files cannot be read: ") + missing, remedy);
}

bool can_write_3mf() { return false; }

void write_zip(const std::string& path, const std::vector<ZipEntry>&) {
  throw Error(Code::cannot_write,
              "cannot write " + path + ": " + missing + "; " + remedy + ", or write another format");
}

ZipReader::ZipReader(const std::string& name, std::string_view, Diagnostics& diagnostics, uint64_t ratio)
    : name_(name), diagnostics_(diagnostics), ratio_(ratio) {
  fail(diagnostics, name, std::string("zip archives cannot be read: ") + missing, remedy);
}

ZipReader::~ZipReader() = default;

// Nobody has a reader of these builds.
std::optional<size_t> ZipReader::find(const std::string&) const { return std::nullopt; }
bool ZipReader::is_link(const std::string&) const { return false; }
std::string ZipReader::read(const std::string&) { return ""; }

}  // namespace ombre::formats

#endif
