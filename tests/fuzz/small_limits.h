// Limits and files for fuzzed scripts, so that each input takes little time.
#pragma once

#include <optional>
#include <string>

#include "lang/engine/limits.h"

namespace ombre::fuzz {

inline lang::Limits small_limits() {
  lang::Limits limits;
  limits.elements = 10'000;
  limits.text_bytes = 1'000'000;
  limits.instances = 10'000;
  limits.calls = 10'000;
  limits.steps = 100'000;
  limits.closures = 2'000;
  limits.files = 10;
  return limits;
}

// Returns what the script of this text reads by include and use: itself and a library.
inline std::optional<std::string> file_for_script(const std::string& text, const std::string& path) {
  if (path == "self") return text;
  if (path == "lib") return "module m(a = 1) { children(); cube(a); } function f(x) = x + 1; v = 2;";
  return std::nullopt;
}

}  // namespace ombre::fuzz
