#include "studio/workspace/preset_files.h"

#include <fstream>

#include "base/text/file_ending.h"
#include "base/text/text.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* presets_ending = ".presets.json";

bool is_of_openscad(const std::string& name) { return ending_of(name) == ".scad"; }

}  // namespace

std::string presets_file_of(const std::string& design) {
  return fs::path(design).replace_extension(is_of_openscad(design) ? ".json" : presets_ending).generic_string();
}

bool is_presets_file(const fs::path& file) {
  if (to_lower(file.filename().string()).ends_with(presets_ending)) return true;
  std::error_code ignored;
  if (ending_of(file) != ".json" || !fs::exists(fs::path(file).replace_extension(".scad"), ignored)) return false;
  std::string beginning(256, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  return beginning.find('"' + std::string(presets_member) + '"') != std::string::npos;
}

}  // namespace ombre::studio
