// Series of DICOM files: the slices of a scan, or one file with all of them, by GDCM.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/vec.h"
#include "base/system/file_format.h"
#include "base/system/progress.h"

namespace ombre::dicom {

// Values are numbers as they are meant, such as Hounsfield units: slope and intercept are applied.
struct Series {
  std::array<int64_t, 3> count{};  // columns, rows, slices
  // x fastest, as many as voxels. Whole ones where all values are whole numbers of 16 bits, else floats.
  std::vector<int16_t> whole;
  std::vector<float> real;
  double slope = 1, intercept = 0;  // that the first slice's numbers went through
  Affine lps_from_index;            // of voxels' centres, in mm; x to the patient's left, y to the back, z to the head
  std::vector<std::string> warnings;
};

// Does the file begin as one of DICOM?
FileFormat file_format();
bool is_dicom(std::string_view bytes);

// `files` are those of a folder, in any order; what is no DICOM image is passed over. `choice` is the number or the UID
// of one series, where the files belong to several; empty: the only one. Throws Error, naming `name`: when there are no
// images or several series, when slices are missing, are of different sizes or lie unevenly, when their pixels are in
// colour, packed in a way that is not known, or damaged, and when this was built without the library. Neither names nor
// other identifiers of patients are read. Cancelled once `stop`, which may be null, is set.
Series read_series(const std::string& name, const std::vector<std::string>& files, const std::string& choice,
                   const StopFlag* stop);

}  // namespace ombre::dicom
