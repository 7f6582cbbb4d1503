// Between read_solids() and the module that holds Open CASCADE, which takes longer to load than many jobs to run.
#pragma once

#include "cad/solids.h"

// What the module exports.
extern "C" void ombre_read_cad(const std::string* path, const ombre::StopFlag* stop,
                               std::vector<ombre::cad::SolidPtr>* solids);
