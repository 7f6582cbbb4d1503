// Finds fonts by their names.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ombre::draw {

struct FoundFont {
  std::string file;
  int index = 0;  // index of the face in the file
  std::string family;
  bool has_name = false;  // whether it belongs to the requested family
  bool is_bold = false, is_italic = false;
};

// Returns the system's font that fontconfig finds most similar; null if there is no font, or if this build does not
// support text.
std::optional<FoundFont> search_font(const std::string& family, bool bold, bool italic);

// Returns the font of one of these files that belongs to the family, preferably with this style; null if none does.
std::optional<FoundFont> search_font_files(const std::vector<std::string>& files, const std::string& family, bool bold,
                                           bool italic);

}  // namespace ombre::draw
