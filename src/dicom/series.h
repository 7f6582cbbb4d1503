// Series of DICOM files, by GDCM: the slices of a scan, or one file with all of them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
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
  bool has_lengths = true;             // false if the files do not say how large voxels are
  std::optional<double> padding = {};  // the value that was put in the place of padding
  std::vector<std::string> warnings;
};

struct SeriesChoice {
  std::string series = {};             // number or UID of one of several series; empty for the only one
  int phase = 0;                       // one of several volumes at the same places, from 1; 0 for the only one
  int64_t label = -1;                  // the only label of a segmentation that is wanted; -1 for all
  bool is_regular = false;             // resamples slices at uneven distances linearly
  std::optional<double> outside = {};  // the value of padding; else the least of the others
  bool is_outside_high = false;        // without `outside`: the greatest of the others
  std::optional<double> level = {};    // without `outside`: the value of padding lies beyond this one
};

// A segment of a segmentation: its name, its number and its colour in sRGB from 0 to 1.
struct Segment {
  std::string name;
  int64_t label = 1;
  std::optional<std::array<double, 3>> colour = {};
};

FileFormat file_format();
// Returns true if the bytes begin like a DICOM file; the 128 bytes before its mark may hold anything.
bool is_dicom(std::string_view bytes);
// Returns true if the bytes begin like the directory of a medium (DICOMDIR).
bool is_directory_of_files(std::string_view bytes);

// Returns the segments that a file names; none if it is no segmentation. Throws Error.
std::vector<Segment> read_segments(const std::string& name, const std::string& file, std::string_view bytes);

// Reads a series. `files` are those of a folder, in any order; files other than DICOM images are skipped, and
// localizers and secondary captures are set aside. Throws Error, naming `name`, if there are no images or several
// series or phases, if slices are missing, differ in size, jump sideways or are unevenly spaced, and if pixels are in
// colour, damaged or in an unknown encoding. Also throws Error in builds without the library, and Cancelled once
// `stop`, which may be null, is set. Names and other identifiers of patients are not read.
Series read_series(const std::string& name, const std::vector<std::string>& files, const SeriesChoice& choice,
                   const StopFlag* stop);

}  // namespace ombre::dicom
