#include "base/system/named_files.h"

#include <dirent.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>

#include "base/text/error.h"

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

fs::path whole_path(const fs::path& file) { return fs::canonical(fs::absolute(file).parent_path()) / file.filename(); }

// The iterators of libstdc++ end the program if there is no memory for them.
std::vector<std::string> names_in(const std::string& folder) {
  const auto fail = [&] {
    if (errno == ENOMEM) throw std::bad_alloc();
    const std::string reason = std::generic_category().message(errno);
    throw Error(Code::cannot_read, "cannot read the folder " + folder + ": " + reason, {{"file", folder}});
  };
  struct Close {
    void operator()(DIR* open) const { closedir(open); }
  };
  const std::unique_ptr<DIR, Close> open(opendir(folder.c_str()));
  if (!open) fail();
  std::vector<std::string> names;
  for (;;) {
    errno = 0;
    const dirent* const entry = readdir(open.get());
    if (!entry) break;
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") names.emplace_back(name);
  }
  if (errno != 0) fail();
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace ombre
