// The interface between read_series() and the module with GDCM.
#pragma once

#include "dicom/series.h"

// Reads a series; the function that the module exports.
extern "C" void ombre_read_dicom(const std::string* name, const std::vector<std::string>* files,
                                 const std::string* choice, const ombre::StopFlag* stop, ombre::dicom::Series* series);
