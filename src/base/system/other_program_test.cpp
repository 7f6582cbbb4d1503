#include "base/system/other_program.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "base/system/temporary_folder.h"
#include "base/text/error.h"

namespace ombre {
namespace {

// Runs a script of the shell in the folder, and returns its exit code. What it says is in said.log.
int run_shell(const TemporaryFolder& folder, const std::string& script, const StopFlag* stop = nullptr) {
  const OtherProgram program{
      {"sh", "-c", script}, folder.path(), folder.file("said.log"), {{"OMBRE_TEST_WORD", "new"}}, SIGTERM};
  return WEXITSTATUS(program.run(stop).value());
}

std::string said(const TemporaryFolder& folder) {
  std::ostringstream text;
  text << std::ifstream(folder.file("said.log")).rdbuf();
  return text.str();
}

}  // namespace

TEST(OtherProgram, WorksInItsFolderAndGivesItsStatus) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_shell(folder, "pwd -P; echo wrong >&2; exit 7"), 7);
  EXPECT_EQ(said(folder), std::filesystem::canonical(folder.path()).string() + "\nwrong\n");
}

TEST(OtherProgram, VariablesReplaceThoseOfThisProcess) {
  setenv("OMBRE_TEST_WORD", "old", 1);
  setenv("OMBRE_TEST_WORDS", "kept", 1);
  const TemporaryFolder folder;
  run_shell(folder, "env | grep ^OMBRE_TEST_WORD | sort");
  EXPECT_EQ(said(folder), "OMBRE_TEST_WORD=new\nOMBRE_TEST_WORDS=kept\n");
}

TEST(OtherProgram, ThatIsMissingHasNoStatus) {
  EXPECT_FALSE((OtherProgram{{"ombre-has-no-such-program"}, "", "", {}, SIGTERM}.run(nullptr)));
}

TEST(OtherProgram, StopsWithItsChildren) {
  const TemporaryFolder folder;
  StopFlag stop;
  std::thread stopper([&] {
    while (said(folder).empty()) std::this_thread::yield();
    stop.request();
  });
  EXPECT_THROW(run_shell(folder, "sleep 1000 & echo $!; wait; echo ended", &stop), Cancelled);
  stopper.join();
  const pid_t child = std::stoi(said(folder));
  while (kill(child, 0) == 0 && std::filesystem::exists("/proc/" + std::to_string(child) + "/exe"))
    std::this_thread::yield();
  EXPECT_EQ(said(folder), std::to_string(child) + "\n");
}

}  // namespace ombre
