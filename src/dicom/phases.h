// Several volumes at the same places, such as the times of a beating heart.
#pragma once

#include "dicom/gdcm_frames.h"

namespace ombre::dicom {

struct PhaseResult {
  std::vector<Frame> frames;  // one at each place, from the lowest up
  size_t doubles = 0;         // frames that equal another one in place and phase, and were left out
  std::string first_double;
};

// Chooses the frames of one phase; -1 for the only one. `frames` must be sorted by height. Throws Error, naming the
// scan, if there are several and none is chosen, or if places have different numbers of them.
PhaseResult frames_of_phase(const std::string& name, std::vector<Frame> frames, int phase);

}  // namespace ombre::dicom
