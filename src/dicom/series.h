// Series of DICOM files, by GDCM: the slices of a scan, or one file with all of them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/vec.h"
#include "base/system/file_format.h"
#include "base/system/progress.h"

namespace ombre::dicom {

// A series with calibrated values, such as Hounsfield units: slope and intercept are applied.
struct Series {
  std::array<int64_t, 3> count{};  // columns, rows, slices
  // The values of all voxels, x fastest: in `whole` if all are 16-bit integers, else in `real`.
  std::vector<int16_t> whole;
  std::vector<float> real;
  double slope = 1, intercept = 0;  // slope and intercept of the first slice
  // maps indices of voxels to their centres in mm; x to the patient's left, y to the back, z to the head
  Affine lps_from_index;
  std::vector<std::string> warnings;
};

FileFormat file_format();
// Returns true if the bytes begin like a DICOM file.
bool is_dicom(std::string_view bytes);

// Reads a series. `files` are those of a folder, in any order; files other than DICOM images are skipped. `choice` is
// the number or UID of a series if there are several; empty for the only one.
// Throws Error, naming `name`, if there are no images or several series, if slices are missing, differ in size or are
// unevenly spaced, and if pixels are in colour, damaged or in an unknown encoding. Also throws Error in builds without
// the library, and Cancelled once `stop`, which may be null, is set. Names and other identifiers of patients are not
// read.
Series read_series(const std::string& name, const std::vector<std::string>& files, const std::string& choice,
                   const StopFlag* stop);

}  // namespace ombre::dicom
