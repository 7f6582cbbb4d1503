// Names of the files that `ombre fea` writes.
#pragma once

#include <string>

#include "jobs/fea/fea_choices.h"

namespace ombre::jobs {

// Returns the name of the file of HDF5 beside an .xdmf file.
std::string numbers_path(const std::string& path);

// Throws Error if a file exists that --force does not allow to replace.
void refuse_to_overwrite(const compile::FeaChoices& choices);

}  // namespace ombre::jobs
