// Loads the module for DICOM files when the first is read.
#include "dicom/series.h"

#include "base/system/module_loader.h"
#include "dicom/gdcm_calls.h"

namespace ombre::dicom {
namespace {

constexpr Module gdcm{"ombre_gdcm",  "GDCM",        "DICOM files",
                      "libgdcm-dev", "OMBRE_DICOM", "save the scan as NRRD or NIfTI"};

}  // namespace

FileFormat file_format() {
  return {"DICOM",
          {".dcm"},
          Content::volume,
          true,
          false,
          &gdcm,
          "colours; several series, phases or orientations without a choice; slices that are missing, uneven or jump "
          "sideways; overlapping or fractional segments",
          "localizers; secondary captures; slices that come twice; overlays"};
}

bool is_dicom(std::string_view bytes) {
  constexpr size_t preamble = 128;
  return bytes.substr(0, preamble + 4).substr(std::min(preamble, bytes.size())) == "DICM";
}

bool is_directory_of_files(std::string_view bytes) {
  constexpr size_t sniffed = 512;
  return is_dicom(bytes) && bytes.substr(0, sniffed).find("1.2.840.10008.1.3.10") != std::string_view::npos;
}

std::vector<Segment> read_segments(const std::string& name, const std::string& file, std::string_view bytes) {
  constexpr size_t sniffed = 512;
  if (!is_dicom(bytes) || bytes.substr(0, sniffed).find("1.2.840.10008.5.1.4.1.1.66.") == std::string_view::npos)
    return {};
  static const auto read = load_function<decltype(ombre_read_dicom_segments)>(gdcm, "ombre_read_dicom_segments");
  std::vector<Segment> segments;
  read(&name, &file, &segments);
  return segments;
}

Series read_series(const std::string& name, const std::vector<std::string>& files, const SeriesChoice& choice,
                   const StopFlag* stop) {
  static const auto read = load_function<decltype(ombre_read_dicom)>(gdcm, "ombre_read_dicom");
  Series series;
  read(&name, &files, &choice, stop, &series);
  return series;
}

}  // namespace ombre::dicom
