#include "studio/workspace/child_process.h"

#include <gtest/gtest.h>

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
  // Descriptor 3 is the folder that `ls` itself has opened.
  EXPECT_EQ(run_program({"sh", "-c", "ls /proc/self/fd | tr '\\n' ' '"}, none, 1000).out, "0 1 2 3 ");
}

TEST(ChildProcess, EndsWhatDoesNotEnd) {
  const Stopwatch watch;
  const StopFlag soon(nullptr, 0.2), none;
  EXPECT_THROW(run_program({"sh", "-c", "sleep 60 & sleep 60"}, soon, 1000), Cancelled);
  EXPECT_THROW(run_program({"yes"}, none, 100000), Error);
  EXPECT_LT(watch.seconds(), 20);
}

}  // namespace
}  // namespace ombre::studio
