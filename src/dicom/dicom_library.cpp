// Loads the module for DICOM files when the first is read.
#include "dicom/series.h"

#include "base/system/module_loader.h"
#include "dicom/gdcm_calls.h"

namespace ombre::dicom {
namespace {

constexpr Module gdcm{"ombre_gdcm",  "GDCM",        "DICOM files",
                      "libgdcm-dev", "OMBRE_DICOM", "save the scan as NRRD or NIfTI"};

}  // namespace

FileFormat file_format() { return {"DICOM", {".dcm"}, Content::volume, true, false, &gdcm}; }

bool is_dicom(std::string_view bytes) {
  constexpr size_t preamble = 128;
  return bytes.substr(0, preamble + 4).substr(std::min(preamble, bytes.size())) == "DICM";
}

Series read_series(const std::string& name, const std::vector<std::string>& files, const std::string& choice,
                   const StopFlag* stop) {
  static const auto read = load_function<decltype(ombre_read_dicom)>(gdcm, "ombre_read_dicom");
  Series series;
  read(&name, &files, &choice, stop, &series);
  return series;
}

}  // namespace ombre::dicom
