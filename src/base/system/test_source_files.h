// Files of the project itself, which tests read. Only tests/test_main.cpp knows its folder, so that the objects of
// tests are the same in each clone, and a cache of the compiler serves all.
#pragma once

#include <string>

namespace ombre {

// Returns the path of a file or folder that is named relative to the project's folder; without a name of that folder.
std::string source_file(const std::string& name = "");

}  // namespace ombre
