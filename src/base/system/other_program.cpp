#include "base/system/other_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/system/not_copied.h"
#include "base/text/error.h"

namespace ombre {
namespace {

// Actions and attributes of posix_spawn, which are freed here.
class SpawnPlan : NotCopied {
 public:
  explicit SpawnPlan(const OtherProgram& program) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
    if (!program.log.empty()) {
      posix_spawn_file_actions_addopen(&actions_, 1, program.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      posix_spawn_file_actions_adddup2(&actions_, 1, 2);
    }
    if (!program.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions_, program.folder.c_str());
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);  // so that Ctrl-C does not reach the program
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }

  int spawn(pid_t& process, char* const* arguments, char* const* environment) const {
    return posix_spawnp(&process, arguments[0], &actions_, &attributes_, arguments, environment);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

// Returns the texts as C has them, with a null at their end.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> environment_with(const std::vector<std::pair<std::string, std::string>>& variables) {
  std::vector<std::string> all;
  for (const auto& [name, value] : variables) all.emplace_back(name).append("=").append(value);
  const auto is_replaced = [&](std::string_view entry) {
    const std::string_view name = entry.substr(0, entry.find('='));
    return std::ranges::any_of(variables, [&](const auto& variable) { return variable.first == name; });
  };
  for (char** entry = environ; *entry; ++entry)
    if (!is_replaced(*entry)) all.emplace_back(*entry);
  return all;
}

int wait_for(pid_t process, const OtherProgram& program, const StopFlag* stop) {
  constexpr auto pause = std::chrono::milliseconds(20);
  bool is_stopping = false;
  for (int status = 0;;) {
    const pid_t ended = waitpid(process, &status, WNOHANG);
    if (ended == process && is_stopping) throw Cancelled();
    if (ended == process) return status;
    if (ended < 0 && errno != EINTR)
      throw Error(Code::other_program, program.command[0] + " cannot be waited for: " + std::strerror(errno));
    if (!is_stopping && stop && stop->requested()) {
      kill(-process, program.stop_signal);
      is_stopping = true;
    }
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

std::optional<int> OtherProgram::run(const StopFlag* stop) const {
  std::vector<std::string> words = command, environment = environment_with(variables);
  pid_t process = 0;
  const int failure = SpawnPlan(*this).spawn(process, pointers_to(words).data(), pointers_to(environment).data());
  if (failure == ENOENT) return std::nullopt;
  if (failure != 0) throw Error(Code::other_program, command[0] + " cannot be started: " + std::strerror(failure));
  return wait_for(process, *this, stop);
}

}  // namespace ombre
