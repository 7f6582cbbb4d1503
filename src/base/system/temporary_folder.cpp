#include "base/system/temporary_folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>

#include "base/text/error.h"

namespace ombre {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "ombre-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw Error("no folder can be made as " + name + ": " + std::strerror(errno));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  try {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  } catch (const std::bad_alloc&) {  // NOLINT: without memory for the names in it, the folder stays
  }
}

}  // namespace ombre
