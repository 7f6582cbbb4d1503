// Builds without libzip report that they cannot read or write zip archives.
#ifndef OMBRE_3MF

#include "base/text/error.h"
#include "formats/containers/library_missing.h"
#include "formats/containers/text_scanner.h"
#include "formats/containers/zip_archive.h"

namespace ombre::formats {

bool can_write_zip() { return false; }

void write_zip(const std::string& path, const std::vector<ZipEntry>&) {
  throw Error(Code::cannot_write,
              "cannot write " + path + ": " + xml_missing + "; " + xml_remedy + ", or write another format");
}

ZipReader::ZipReader(const std::string& name, std::string_view, Diagnostics& diagnostics, ZipLimits limits)
    : name_(name), diagnostics_(diagnostics), limits_(limits) {
  fail(diagnostics, name, std::string("zip archives cannot be read: ") + xml_missing, xml_remedy);
}

ZipReader::~ZipReader() = default;

// No reader can be constructed in these builds.
std::optional<size_t> ZipReader::find(const std::string&) const { return std::nullopt; }
bool ZipReader::is_link(const std::string&) const { return false; }
std::string ZipReader::read(const std::string&) { return ""; }

}  // namespace ombre::formats

#endif
