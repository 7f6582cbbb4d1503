// Draws contact sheets of slice jobs.
#pragma once

#include <string>

namespace ombre::compile {

// Returns a PNG file of up to `layer_count` evenly spaced layers with material of the job in `folder`, finished or not.
// Throws Error when the folder holds no job or no layer with material yet, or a file cannot be read.
std::string contact_sheet(const std::string& folder, int layer_count);

}  // namespace ombre::compile
