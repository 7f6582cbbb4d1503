#include "jobs/common/free_space.h"

#include <filesystem>

#include "base/text/error.h"
#include "base/text/text.h"

namespace ombre::jobs {

namespace fs = std::filesystem;

std::optional<double> free_bytes(const std::string& folder) {
  std::error_code error;
  fs::path path = fs::absolute(folder, error);
  while (!error && !fs::exists(path, error) && path.has_relative_path()) path = path.parent_path();
  const fs::space_info space = fs::space(path, error);
  if (error) return std::nullopt;
  return static_cast<double>(space.available);
}

void refuse_small_disk(const std::string& path, double bytes, const std::string& what, const Phrase& remedy) {
  const std::string folder = fs::absolute(path).parent_path().string();
  const std::optional<double> free = free_bytes(folder);
  if (!free || bytes <= *free) return;
  throw Error(Code::disk_space, what + " takes " + format_bytes(bytes) + ", and the disk of " + folder + " has " +
                                    format_bytes(*free) + " left; free some space there, " + remedy +
                                    ", or write all the same with " + spelled::option("--force"));
}

std::string space_warning(const std::string& folder, double bytes) {
  const std::optional<double> free = free_bytes(folder);
  if (!free || bytes <= *free) return "";
  return "the layers to come take about " + format_bytes(bytes) + ", and the disk of " + folder + " has " +
         format_bytes(*free) + " left; free some space there, or choose another folder";
}

}  // namespace ombre::jobs
