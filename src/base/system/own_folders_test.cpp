#include "base/system/own_folders.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace ombre {

TEST(OwnFolders, BeginWithThatOfTheProgram) {
  std::string program;
  std::getline(std::ifstream("/proc/self/cmdline"), program, '\0');
  const auto folders = own_folders();
  ASSERT_FALSE(folders.empty());
  EXPECT_EQ(folders.front(), std::filesystem::canonical(program).parent_path());
}

TEST(OwnFolders, RiseButForTheRoot) {
  const auto folders = own_folders();
  ASSERT_FALSE(folders.empty());
  for (size_t n = 1; n < folders.size(); ++n) EXPECT_EQ(folders[n], folders[n - 1].parent_path());
  EXPECT_EQ(folders.back().parent_path(), "/");
}

}  // namespace ombre
