// Builds without libzip and pugixml report that they cannot read 3MF and AMF.
#ifndef OMBRE_3MF

#include "formats/containers/library_missing.h"
#include "formats/packages/package_readers.h"

namespace ombre::formats {
namespace {

std::optional<Mesh> report(const std::string& name, const std::string& format, Diagnostics& diagnostics) {
  diagnostics.error(Code::library_missing, {make_source(name, ""), 0, 0},
                    format + " files cannot be read: " + xml_missing, xml_remedy);
  return std::nullopt;
}

}  // namespace

std::optional<Mesh> read_3mf(const std::string& name, std::string_view, Diagnostics& diagnostics) {
  return report(name, "3MF", diagnostics);
}

std::optional<Mesh> read_amf(const std::string& name, std::string_view, Diagnostics& diagnostics) {
  return report(name, "AMF", diagnostics);
}

}  // namespace ombre::formats

#endif
