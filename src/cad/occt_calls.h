// The interface between read_solids() and the module with Open CASCADE, which takes longer to load than many jobs take
// to run.
#pragma once

#include "cad/solids.h"

// Reads a file; the function that the module exports.
extern "C" void ombre_read_cad(const std::string* path, const ombre::StopFlag* stop,
                               std::vector<ombre::cad::SolidPtr>* solids);
