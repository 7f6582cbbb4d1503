// Where systems keep the fonts that pictures are labelled with.
#pragma once

#include <optional>
#include <string>

namespace ombre::draw {

// DejaVu Sans, of which the pictures of documents and tests are made.
bool is_usual(const std::string& font_file);
// The first there is, DejaVu Sans if possible.
std::optional<std::string> find_font_file();

}  // namespace ombre::draw
