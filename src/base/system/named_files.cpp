#include "base/system/named_files.h"

#include <algorithm>
#include <filesystem>

namespace ombre {

namespace fs = std::filesystem;

std::vector<std::string> places_of(const std::string& path, const std::string& named_by) {
  constexpr int most_links = 40;  // largest number of symbolic links that are followed in a row, as on Linux
  const fs::path wanted(path);
  if (wanted.is_absolute()) return {path};
  std::vector<std::string> places;
  const auto add = [&places](const std::string& place) {
    if (std::ranges::find(places, place) == places.end()) places.push_back(place);
  };
  fs::path file(named_by);
  for (int links = 0; links <= most_links; ++links) {
    add((file.parent_path() / wanted).generic_string());
    std::error_code status;
    const fs::path target = fs::read_symlink(file, status);
    if (status) break;
    file = file.parent_path() / target;
  }
  add(path);
  return places;
}

}  // namespace ombre
