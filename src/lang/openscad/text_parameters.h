// The parameters that text() and the functions measuring it have in common.
#pragma once

#include <cctype>
#include <string>

#include "solids/tree.h"

namespace ombre::lang::openscad {

// Only the first letter counts.
inline std::string direction_called(const std::string& name) {
  for (const char* direction : {"ltr", "rtl", "ttb", "btt"})
    if (!name.empty() && std::tolower(static_cast<unsigned char>(name[0])) == direction[0]) return direction;
  return "ltr";
}

// `Call` gives arguments by name.
template <class Call>
solids::Text text_of(const Call& call) {
  solids::Text result;
  result.text = call.text("text");
  result.size = call.number("size", 10);
  result.font = call.text("font");
  result.horizontal = call.text("halign", "left");
  result.vertical = call.text("valign", "baseline");
  result.direction = direction_called(call.text("direction", "ltr"));
  result.language = call.text("language", "en");
  result.script = call.text("script", "Latn");
  result.spacing = call.number("spacing", 1);
  result.font_files = call.font_files();
  return result;
}

}  // namespace ombre::lang::openscad
