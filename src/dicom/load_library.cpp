// Loads the module of DICOM files when the first is read.
#include "dicom/series.h"

#include "base/error.h"
#include "base/module_loader.h"
#include "dicom/module.h"

namespace ombre::dicom {
namespace {

using ReadDicom = decltype(&ombre_read_dicom);

#ifdef OMBRE_GDCM_MODULE

ReadDicom load_module() {
  return load_function<decltype(ombre_read_dicom)>(OMBRE_GDCM_MODULE, "ombre_read_dicom", "DICOM files");
}

#else

ReadDicom load_module() {
  throw Error(
      Code::library_missing,
      "this ombre was built without GDCM; install libgdcm-dev, configure with -DOMBRE_DICOM=ON and build again, or "
      "save the scan as NRRD or NIfTI");
}

#endif

}  // namespace

bool is_dicom(std::string_view bytes) {
  constexpr size_t preamble = 128;
  return bytes.substr(0, preamble + 4).substr(std::min(preamble, bytes.size())) == "DICM";
}

Series read_series(const std::string& name, const std::vector<std::string>& files, const std::string& choice,
                   const StopFlag* stop) {
  static const ReadDicom read = load_module();
  Series series;
  read(&name, &files, &choice, stop, &series);
  return series;
}

}  // namespace ombre::dicom
