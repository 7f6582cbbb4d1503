#include "base/system/helper_process.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <memory>
#include <thread>

#include "base/text/error.h"

namespace ombre {
namespace {

Error explain(HelperFailure failure) {
  return {Code::file_content, failure == HelperFailure::crashed ? "it crashed" : "it is slow"};
}

std::string run(const std::function<std::string()>& work, double seconds = 20, const StopFlag* stop = nullptr) {
  try {
    return run_in_helper(work, {seconds, size_t{1} << 30}, explain, stop);
  } catch (const Error& error) {
    return std::string("error: ") + error.what();
  }
}

// Returns the processor time of child processes that have ended.
double seconds_of_children() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string wait_forever() {
  for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}

TEST(HelperProcess, GivesWhatTheWorkReturns) {
  EXPECT_EQ(run([] { return std::string(); }), "");
  const std::string large(5'000'000, 'x');
  EXPECT_EQ(run([&] { return large; }), large);
  EXPECT_NE(run([] { return std::to_string(getpid()); }), std::to_string(getpid()));
}

TEST(HelperProcess, TellsErrorsCrashesAndHangs) {
  EXPECT_EQ(run([]() -> std::string { throw Error("no such shape"); }), "error: no such shape");
  EXPECT_EQ(run([]() -> std::string {
              std::raise(SIGKILL);
              return "";
            }),
            "error: it crashed");
  EXPECT_EQ(run([]() -> std::string { _exit(0); }), "error: it crashed");
  EXPECT_EQ(run(wait_forever, 0.02), "error: it is slow");
}

TEST(HelperProcess, CountsProcessorTime) {
  const auto sleep = [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    return std::string("awake");
  };
  EXPECT_EQ(run(sleep, 0.2), "awake");
  const double before = seconds_of_children();
  const auto spin = []() -> std::string {
    for (std::atomic<int> n = 0;;) ++n;
  };
  EXPECT_EQ(run(spin, 0.3), "error: it is slow");
  // The work ends by its processor time. The limit of the clock would allow twenty times as much.
  const double taken = seconds_of_children() - before;
  EXPECT_GE(taken, 0.3);
  EXPECT_LT(taken, 3);
}

TEST(HelperProcess, ErrorsKeepTheirCodesAndValues) {
  try {
    run_in_helper(
        []() -> std::string {
          throw Error(Code::file_missing, "no such file", {{"file", "a.step"}});
        },
        {20, size_t{1} << 30}, explain, nullptr);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::file_missing);
    EXPECT_EQ(error.values(), (CodeValues{{"file", "a.step"}}));
  }
}

TEST(HelperProcess, KeepsItsMemory) {
#ifdef OMBRE_SANITIZED
  GTEST_SKIP() << "the sanitizer ends programs that run out of memory";
#endif
  const auto greedy = [] {
    const std::unique_ptr<char[]> all(new char[size_t{3} << 30]);
    return std::string(1, all[1]);
  };
  EXPECT_EQ(run(greedy), "error: std::bad_alloc");
}

TEST(HelperProcess, AnswersOneRequestAfterAnother) {
  int sum = 0;
  Helper helper([&](const std::string& request) { return std::to_string(sum += std::stoi(request)); }, {}, explain);
  EXPECT_EQ(helper.ask("3", nullptr), "3");
  EXPECT_EQ(helper.ask("4", nullptr), "7");
  EXPECT_EQ(sum, 0);
  // The child survives an Error.
  EXPECT_THROW(helper.ask("x", nullptr), Error);
  EXPECT_EQ(helper.ask("5", nullptr), "12");
}

TEST(HelperProcess, ThatEndedAnswersNoMore) {
  const auto answer = [](const std::string& request) -> std::string {
    if (request == "crash") std::raise(SIGKILL);
    if (request == "hang") return wait_forever();
    return request + request;
  };
  Helper first(answer, {20, 0}, explain);
  const std::string large(3'000'000, 'x');
  EXPECT_EQ(first.ask(large, nullptr), large + large);
  for (int round = 0; round < 2; ++round) EXPECT_THROW(first.ask("crash", nullptr), Error);
  EXPECT_THROW(first.ask(large, nullptr), Error);
  Helper second(answer, {20, 0}, explain);
  StopFlag stop;
  int waited = 0;
  const auto waiting = [&] {
    if (++waited == 3) stop.request();
  };
  EXPECT_THROW(second.ask("hang", &stop, waiting), Cancelled);
  EXPECT_GE(waited, 3);
  EXPECT_THROW(second.ask("more", nullptr), Error);
}

TEST(HelperProcess, IsStopped) {
  StopFlag stop;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.request();
  });
  EXPECT_THROW(run(wait_forever, 20, &stop), Cancelled);
  other.join();
  EXPECT_THROW(run([]() -> std::string {
                 std::raise(SIGINT);
                 return "";
               }),
               Cancelled);
}

}  // namespace
}  // namespace ombre
