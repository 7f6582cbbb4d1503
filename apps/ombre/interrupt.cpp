// Handles Ctrl-C: the first asks a job to stop where it can be resumed, the second ends the program.
#include "ombre/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "base/system/assert.h"
#include "jobs/common/exit_codes.h"

namespace ombre::cli {
namespace {

std::atomic<StopFlag*> current_flag{nullptr};
std::atomic<bool> quits_at_once{false};
static_assert(std::atomic<StopFlag*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

// Only calls functions that are allowed in a signal handler.
void on_signal(int) {
  StopFlag* flag = current_flag.load();
  if (!flag || flag->requested() || quits_at_once) ::_exit(jobs::interrupted);
  flag->request();
  constexpr std::string_view text =
      "\nstopping, once what is under way is finished; press Ctrl-C again to quit at once\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace

InterruptGuard::InterruptGuard() {
  ASSERT(current_flag.load() == nullptr);
  current_flag = &flag_;
  interrupt_before_ = std::signal(SIGINT, on_signal);
  terminate_before_ = std::signal(SIGTERM, on_signal);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, interrupt_before_);
  std::signal(SIGTERM, terminate_before_);
  current_flag = nullptr;
}

QuitAtOnce::QuitAtOnce() { quits_at_once = true; }
QuitAtOnce::~QuitAtOnce() { quits_at_once = false; }

}  // namespace ombre::cli
