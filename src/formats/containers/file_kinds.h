// Recognizes files that are given as meshes but have another format.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ombre::formats {

struct ForeignFile {
  std::string what;            // such as "a PNG picture"
  std::string hint;            // what to do instead; may be empty
  bool is_other_mesh = false;  // of a format of meshes or solids that Ombre does not read
};

// Returns the format that the first bytes prove; null if a reader of meshes may be able to read the file.
std::optional<ForeignFile> foreign_file(std::string_view bytes);

// Returns true if there are zero bytes before the last other byte; some programs pad text with trailing zeros.
bool has_zeros(std::string_view bytes);
// Returns true for text in UTF-8 or a code page: the only control characters are line ends and tabs.
bool is_plain_text(std::string_view bytes);

}  // namespace ombre::formats
