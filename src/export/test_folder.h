// A folder for tests of written files, which is empty at the beginning and gone afterwards.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/text/test_errors.h"

namespace ombre::exporting {

class FolderTest : public testing::Test {
 protected:
  FolderTest() : folder_(std::filesystem::path(testing::TempDir()) / ("export_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~FolderTest() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name = "") const {
    return name.empty() ? folder_.string() : (folder_ / name).string();
  }
  // Returns the sorted names in the folder, or in a folder in it.
  std::vector<std::string> names(const std::string& folder = "") const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path(folder)))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  void put(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  // Makes the file that is written before `name` appears accept no byte, like a full disk.
  void fill_disk_of(const std::string& name) const {
    std::filesystem::create_symlink("/dev/full", path(name) + ".part");
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace ombre::exporting
