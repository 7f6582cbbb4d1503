// The interface between read_series() and the module with GDCM.
#pragma once

#include "dicom/series.h"

// Reads a series; the function that the module exports.
extern "C" void ombre_read_dicom(const std::string* name, const std::vector<std::string>* files,
                                 const ombre::dicom::SeriesChoice* choice, const ombre::StopFlag* stop,
                                 ombre::dicom::Series* series);
// Reads the segments of a file.
extern "C" void ombre_read_dicom_segments(const std::string* name, const std::string* file,
                                          std::vector<ombre::dicom::Segment>* segments);
