// Builds without pugixml report that they cannot read VTU and XDMF.
#ifndef OMBRE_3MF

#include "formats/containers/library_missing.h"
#include "formats/containers/text_scanner.h"
#include "formats/results/results_readers.h"

namespace ombre::formats {

Results read_vtu(const std::string& name, std::string_view, Diagnostics& diagnostics) {
  fail(diagnostics, name, std::string("VTU files cannot be read: ") + xml_missing, xml_remedy);
}

Results read_pvd(const std::string& name, std::string_view, const ResultsBeside&, Diagnostics& diagnostics) {
  return read_vtu(name, "", diagnostics);
}

Results read_pvtu(const std::string& name, std::string_view, const ResultsBeside&, Diagnostics& diagnostics) {
  return read_vtu(name, "", diagnostics);
}

Results read_xdmf(const std::string& name, std::string_view, const ResultsBeside&, Diagnostics& diagnostics) {
  fail(diagnostics, name, std::string("XDMF files cannot be read: ") + xml_missing, xml_remedy);
}

}  // namespace ombre::formats

#endif
