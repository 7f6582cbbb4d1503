// The interface between read_grid() and the module with OpenVDB.
#pragma once

#include "vdb/dense_grid.h"

// Reads a grid; the function that the module exports.
extern "C" void ombre_read_vdb_grid(const std::string* path, const std::string* name, int channel,
                                    const ombre::StopFlag* stop, ombre::vdb::DenseGrid* grid);
