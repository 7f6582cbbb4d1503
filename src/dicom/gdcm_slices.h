// Slices of DICOM files, as GDCM reads them.
#pragma once

#include "dicom/series.h"

namespace ombre::dicom {

// Reads, sorts and checks; see read_series().
Series read_slices(const std::string& name, const std::vector<std::string>& files, const std::string& choice);

}  // namespace ombre::dicom
