// Any bytes as a bundle: its files in the folder that they are to go to, and nowhere else, or a message.
#include <cstdint>
#include <cstdlib>
#include <filesystem>

#include "base/system/temporary_folder.h"
#include "base/text/error.h"
#include "load/bundle.h"

namespace {

namespace fs = std::filesystem;

bool is_within(const fs::path& file, const fs::path& folder) {
  const fs::path relative = fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder));
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const ombre::TemporaryFolder folder;
  const fs::path inside = folder.path() / "deep" / "bundle";
  ombre::Diagnostics diagnostics;
  try {
    const auto unpacked = ombre::compile::unpack_bundle("fuzz.ombre", bytes, inside, diagnostics);
    if (unpacked.has_value() == diagnostics.has_errors()) std::abort();
    if (unpacked && !is_within(unpacked->design, inside)) std::abort();
  } catch (const ombre::Error&) {
    // A file and a folder of one name, or a name that is too long for the disk.
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path()))
    if (entry.is_symlink() || (entry.is_regular_file() && !is_within(entry.path(), inside))) std::abort();
  return 0;
}
