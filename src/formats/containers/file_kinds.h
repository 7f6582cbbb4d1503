// What files are that are given as meshes but are none.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ombre::formats {

struct ForeignFile {
  std::string what;            // "a PNG picture"
  std::string hint;            // what to do instead; may be empty
  bool is_other_mesh = false;  // of a format of meshes or solids that Ombre does not read
};

// What the first bytes show for certain. Nothing for what a reader of meshes may be able to read.
std::optional<ForeignFile> foreign_file(std::string_view bytes);

// Before its last other byte: some programs fill up texts with zeros.
bool has_zeros(std::string_view bytes);
// Text in UTF-8 or a code page: no control characters but those of lines and tabs.
bool is_plain_text(std::string_view bytes);

}  // namespace ombre::formats
