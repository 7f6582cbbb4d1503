#include "studio/workspace/child_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/system/stopwatch.h"
#include "base/text/error.h"

namespace ombre::studio {
namespace {

TEST(ChildProcess, GivesWhatAProgramSays) {
  const StopFlag none;
  const ProgramOutput output = run_program({"sh", "-c", "echo one; echo two >&2; exit 3"}, none, 1000);
  EXPECT_EQ(output.out, "one\n");
  EXPECT_EQ(output.err, "two\n");
  EXPECT_EQ(output.status, 3);
  EXPECT_EQ(run_program({"sh", "-c", "kill -9 $$"}, none, 1000).status, -1);
  EXPECT_THROW(run_program({"/no/such/program"}, none, 1000), Error);
}

TEST(ChildProcess, PassesOnNoFiles) {
  const StopFlag none;
  // Descriptor 3 was opened by `ls` itself.
  EXPECT_EQ(run_program({"sh", "-c", "ls /proc/self/fd | tr '\\n' ' '"}, none, 1000).out, "0 1 2 3 ");
}

TEST(ChildProcess, EndsWhatDoesNotEnd) {
  const StopFlag soon(nullptr, 0.2), none;
  EXPECT_THROW(run_program({"sh", "-c", "sleep 3600 & sleep 3600"}, soon, 1000), Cancelled);
  EXPECT_THROW(run_program({"yes"}, none, 100000), Error);
}

TEST(ChildProcess, TellsAtOnceWhatAProgramSays) {
  const StopFlag none;
  std::vector<std::string> pieces;
  // The program goes on when what it has said first was heard.
  const std::string heard = testing::TempDir() + "/ombre_heard";
  const ProgramOutput output =
      run_program({"sh", "-c", "echo one >&2; until [ -e \"$0\" ]; do sleep 0.01; done; echo two >&2", heard}, none,
                  1000, [&](std::string_view piece) {
                    pieces.emplace_back(piece);
                    std::ofstream(heard).flush();
                  });
  EXPECT_EQ(pieces, (std::vector<std::string>{"one\n", "two\n"}));
  EXPECT_EQ(output.err, "one\ntwo\n");
}

TEST(ChildProcess, KeepsTheEndOfALongReport) {
  const StopFlag none;
  const ProgramOutput output =
      run_program({"sh", "-c", "yes | head -c 3000000 >&2; echo last >&2"}, none, 1 << 20, [](std::string_view) {});
  EXPECT_LT(output.err.size(), size_t{256} << 10);
  EXPECT_TRUE(output.err.ends_with("last\n"));
}

// A program that a killed studio has started is killed with all that it has started itself.
TEST(ChildProcess, EndsWithTheProgramThatStartedIt) {
  const std::filesystem::path note = testing::TempDir() + "/ombre_children_" + std::to_string(::getpid());
  const pid_t studio = ::fork();
  if (studio == 0) {
    const StopFlag none;
    run_program({"sh", "-c", "sleep 3600 & echo $$ $! > \"$0.part\"; mv \"$0.part\" \"$0\"; sleep 3600", note.string()},
                none, 1000);
    ::_exit(0);
  }
  const Stopwatch watch;
  while (!std::filesystem::exists(note) && watch.seconds() < 600)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  pid_t child = 0, grandchild = 0;
  std::ifstream(note) >> child >> grandchild;
  std::filesystem::remove(note);
  ASSERT_GT(grandchild, 0);
  ASSERT_EQ(::kill(grandchild, 0), 0);
  ::kill(studio, SIGKILL);
  ::waitpid(studio, nullptr, 0);
  // A process that has ended may remain as a zombie of a parent that does not wait for it.
  const auto runs = [](pid_t process) {
    std::string word, state;
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    while (status >> word)
      if (word == "State:" && status >> state) return state != "Z" && state != "X";
    return false;
  };
  while ((runs(child) || runs(grandchild)) && watch.seconds() < 1200)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(runs(child));
  EXPECT_FALSE(runs(grandchild));
}

}  // namespace
}  // namespace ombre::studio
