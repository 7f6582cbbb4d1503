#include "base/system/file_format.h"

#include <algorithm>
#include <array>

#include "base/text/text.h"

namespace ombre {

std::string_view name_of(Content content) {
  constexpr std::array<std::string_view, static_cast<size_t>(Content::last) + 1> names{
      "surface meshes", "CAD solids",         "volumes", "images", "drawings",
      "outlines",       "meshes of elements", "results", "tables"};
  return names[static_cast<size_t>(content)];
}

bool has_ending(const std::string& name, const FileFormat& format) {
  const std::string lower = to_lower(name);
  return std::ranges::any_of(format.endings, [&](std::string_view ending) { return lower.ends_with(ending); });
}

std::vector<std::string> endings_of(std::span<const FileFormat> formats) {
  std::vector<std::string> endings;
  for (const FileFormat& format : formats) endings.insert(endings.end(), format.endings.begin(), format.endings.end());
  return endings;
}

}  // namespace ombre
