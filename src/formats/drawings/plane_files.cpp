#include "formats/drawings/plane_files.h"

#include "base/text/text.h"

namespace ombre::formats {

std::string text_of_left_out(const std::map<std::string, size_t>& left_out) {
  std::vector<std::string> parts;
  for (const auto& [kind, count] : left_out) parts.push_back(std::to_string(count) + " " + kind);
  return join(parts, ", ");
}

}  // namespace ombre::formats
