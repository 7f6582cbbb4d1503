// Decoding and encoding of base64 (RFC 4648).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ombre::formats {

// Returns the decoded bytes. Blanks and line ends are skipped; = ends a group, and another may follow. Null if the text
// has another character or an incomplete last group.
std::optional<std::string> from_base64(std::string_view text);
// Returns the text of the bytes on one line.
std::string to_base64(std::string_view bytes);

}  // namespace ombre::formats
