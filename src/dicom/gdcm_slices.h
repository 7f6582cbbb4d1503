// Reads slices of DICOM files by GDCM.
#pragma once

#include "dicom/series.h"

namespace ombre::dicom {

// Reads, sorts and checks slices; see read_series().
Series read_slices(const std::string& name, const std::vector<std::string>& files, const SeriesChoice& choice);

}  // namespace ombre::dicom
