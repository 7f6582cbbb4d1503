// Segmentations in DICOM: their segments, and their frames as a map of labels.
#pragma once

#include "dicom/gdcm_frames.h"
#include "dicom/series.h"

namespace ombre::dicom {

// Returns the segments that a file names. Throws Error, naming the scan.
std::vector<Segment> segments_of_file(const std::string& name, const std::string& file);

// Returns the colour of a CIELab value as DICOM stores it (part 3, C.10.7.1.1: D50 white), in sRGB from 0 to 1.
std::array<double, 3> colour_of_lab(const std::array<double, 3>& stored);

// Returns one frame for each slice from the lowest up, with the labels of all segments, or of the one chosen. Slices
// without a frame are empty. Throws Error, naming the scan, if segments overlap or frames do not lie on even slices.
std::vector<Frame> label_slices(const std::string& name, std::vector<Frame> frames, int64_t label);

}  // namespace ombre::dicom
