// Bytes as text (RFC 4648).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ombre::formats {

// The bytes of such text, in which blanks and line ends may stand; = ends a group, and another may follow. Nothing
// where another character stands, or the last group is cut off.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace ombre::formats
