// Finds fonts by their names.
#pragma once

#include <optional>
#include <string>

namespace ombre::draw {

struct FoundFont {
  std::string file;
  int index = 0;  // of the face in the file
  std::string family;
  bool has_name = false;  // it is of the family that was asked for
  bool is_bold = false, is_italic = false;
};

// What the system has that comes nearest, by fontconfig. Nothing when there is no font, or this was built without text.
std::optional<FoundFont> search_font(const std::string& family, bool bold, bool italic);

}  // namespace ombre::draw
