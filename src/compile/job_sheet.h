// Contact sheets of slice jobs.
#pragma once

#include <string>

namespace ombre::compile {

// Draws up to `layer_count` evenly spaced layers with material of the job in `folder`, finished or
// not, into one PNG file. Throws Error when the folder holds no job, no layer with material yet, or
// a file fails.
void write_contact_sheet(const std::string& folder, const std::string& image_path, int layer_count);

}  // namespace ombre::compile
