// A temporary folder of a test, which is removed with it, and the errors that it expects.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "base/system/not_copied.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {

class TestFolder : NotCopied {
 public:
  TestFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path = std::filesystem::temp_directory_path() /
           ("ombre_studio_" + std::string(test->test_suite_name()) + "_" + test->name() + std::to_string(::getpid()));
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~TestFolder() { std::filesystem::remove_all(path); }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path / name).parent_path());
    std::ofstream(path / name, std::ios::binary) << text;
  }
  std::string read(const std::string& name) const {
    std::ifstream file(path / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path path;
};

// Returns the code of the request error that the work throws; empty if it throws none.
inline std::string code_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const RequestError& error) {
    return error.code();
  }
  return "";
}

}  // namespace ombre::studio
