// Makes a calibration of inks from measured patches.
#pragma once

#include <string>

#include "jobs/common/session.h"

namespace ombre::jobs {

// Reads the CSV file, writes a calibration to `output`, which ends in .json, and an ICC profile beside it, and says how
// well the profile predicts. Throws Error.
void calibrate_inks(const std::string& measured, const std::string& output, bool force, const Session& session);

}  // namespace ombre::jobs
