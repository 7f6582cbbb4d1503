// Finds the system's fonts, with which pictures are labelled.
#pragma once

#include <optional>
#include <string>

namespace ombre::draw {

// Returns true for DejaVu Sans, with which the pictures of the documentation and of tests are made.
bool is_usual(const std::string& font_file);
// Returns the first font that exists, preferably DejaVu Sans.
std::optional<std::string> find_font_file();

}  // namespace ombre::draw
