// The main function of the unit tests.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/system/test_source_files.h"

namespace ombre {

std::string source_file(const std::string& name) {
  return name.empty() ? OMBRE_SOURCE_DIR : OMBRE_SOURCE_DIR "/" + name;
}

}  // namespace ombre

// Tests run at the same time, each in a process, so testing::TempDir() is a folder of the process's own.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  std::string folder = (std::filesystem::temp_directory_path() / "ombre_test_XXXXXX").string();
  if (!mkdtemp(folder.data()) || setenv("TEST_TMPDIR", folder.c_str(), 1) != 0) {
    std::perror(folder.c_str());
    return 1;
  }
  const int status = RUN_ALL_TESTS();
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  return status;
}
