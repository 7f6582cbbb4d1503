// Finds the printer profiles and materials that come with Ombre.
#pragma once

#include <string>

namespace ombre::compile {

// Returns the folder that holds printers/ and materials/: $OMBRE_DATA if it is set, else share/ombre in a folder above
// the program or the Python package, else the source tree that they were built in. Throws Error when there is none.
std::string data_folder();

}  // namespace ombre::compile
