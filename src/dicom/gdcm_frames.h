// The frames of one DICOM file: their places, scales and numbers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/vec.h"

namespace ombre::dicom {

// The values that distinguish volumes at the same places, in the order in which they sort them.
enum PhaseKey : uint8_t { temporal_position, trigger_time, echo_time, b_value, acquisition, phase_keys };

struct Frame {
  std::string path;
  int64_t number = 0;                                            // in the file, from 0
  std::array<int64_t, 2> count{};                                // columns, rows
  std::array<double, 2> spacing{1, 1};                           // along columns and rows
  std::array<Vec3, 2> directions{Vec3{1, 0, 0}, Vec3{0, 1, 0}};  // of rows and columns
  Vec3 place;                                                    // centre of the first pixel
  double step = 0;  // distance to the next slice, as far as the frame alone says it; 0 if unknown
  bool has_place = false, has_spacing = false;
  double instance = 0, slope = 1, intercept = 0;
  std::array<double, phase_keys> phase{};  // NaN where it is not given
  int64_t segment = 0;                     // of a segmentation; 0 for other images
  std::vector<float> values;
  std::vector<uint32_t> padding;  // indices of values that lie outside of what was scanned
};

// Returns the place of a frame along its normal, in mm.
inline double height(const Frame& frame) { return dot(frame.place, cross(frame.directions[0], frame.directions[1])); }

// Reads all frames. Adds sentences about what was left out to `warnings`. Throws Error, naming the scan, if the file is
// damaged or holds what is not read.
std::vector<Frame> read_frames(const std::string& name, const std::string& path, std::vector<std::string>& warnings);

}  // namespace ombre::dicom
