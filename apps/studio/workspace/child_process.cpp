#include "studio/workspace/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "base/system/not_copied.h"
#include "base/text/error.h"

namespace ombre::studio {
namespace {

class Pipe : NotCopied {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw Error(Code::other_program, "cannot make a pipe to another program");
  }
  ~Pipe() {
    close(0);
    close(1);
  }

  int end(size_t which) const { return ends_[which]; }
  void close(size_t which) {
    if (ends_[which] >= 0) ::close(ends_[which]);
    ends_[which] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

// Ends of pipes that a program gets as its streams. A negative stdin is empty; others are those of this program.
struct Streams {
  int in = -1, out = -1, err = -1;
};

// Starts a command in its own process group. Returns 0 if it cannot start.
pid_t spawn(const std::vector<std::string>& command, const Streams& streams) {
  const auto [in, out, err] = streams;
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  if (in >= 0)
    ::posix_spawn_file_actions_adddup2(&actions, in, 0);
  else
    ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  if (out >= 0) ::posix_spawn_file_actions_adddup2(&actions, out, 1);
  if (err >= 0) ::posix_spawn_file_actions_adddup2(&actions, err, 2);
  ::posix_spawn_file_actions_addclosefrom_np(&actions, 3);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int problem = ::posix_spawnp(&child, arguments[0], &actions, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  return problem == 0 ? child : 0;
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// A small program that kills a process group as soon as this program is gone, however it ended: its stdin is a pipe,
// which the system closes then.
class Guardian : NotCopied {
 public:
  explicit Guardian(pid_t group) {
    const std::string script = "read done || kill -s KILL -- \"-$1\"";
    shell_ = spawn({"/bin/sh", "-c", script, "sh", std::to_string(group)}, {line_.end(0), -1, -1});
    line_.close(0);
  }
  // Lets it end without killing anything.
  ~Guardian() {
    if (shell_ == 0) return;
    [[maybe_unused]] const ssize_t written = ::write(line_.end(1), "\n", 1);
    line_.close(1);
    wait_for(shell_);
  }

 private:
  Pipe line_;
  pid_t shell_ = 0;
};

// Passes on the available bytes. Returns false at the end.
template <class Take>
bool read_some(int from, const Take& take) {
  std::array<char, 65536> block{};
  const ssize_t count = ::read(from, block.data(), block.size());
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  take(std::string_view(block.data(), static_cast<size_t>(count)));
  return count > 0;
}

// Keeps the end of a text that grows.
void append_end(std::string& text, std::string_view piece) {
  constexpr size_t most = 64 << 10;
  text += piece;
  if (text.size() > 2 * most) text.erase(0, text.size() - most);
}

}  // namespace

bool start_program(const std::vector<std::string>& command) { return spawn(command, {}) != 0; }

ProgramOutput run_program(const std::vector<std::string>& command, const StopFlag& stop, size_t most_bytes,
                          const std::function<void(std::string_view)>& said) {
  Pipe out, err;
  const pid_t child = spawn(command, {-1, out.end(1), err.end(1)});
  if (child == 0) throw Error(Code::other_program, "cannot run " + command.front());
  const Guardian guardian(child);
  out.close(1);
  err.close(1);
  ProgramOutput output;
  const auto take_out = [&](std::string_view piece) { output.out += piece; };
  const auto take_err = [&](std::string_view piece) {
    if (said && !piece.empty()) said(piece);
    said ? append_end(output.err, piece) : void(output.err += piece);
  };
  std::array<pollfd, 2> ends{pollfd{out.end(0), POLLIN, 0}, pollfd{err.end(0), POLLIN, 0}};
  constexpr int patience_ms = 50;
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    const bool is_too_much = output.out.size() + output.err.size() > most_bytes;
    if (stop.requested() || is_too_much) {
      ::kill(-child, SIGKILL);
      wait_for(child);
      if (is_too_much) throw Error(Code::other_program, command.front() + " said too much");
      throw Cancelled();
    }
    if (::poll(ends.data(), ends.size(), patience_ms) <= 0) continue;
    if (ends[0].revents != 0 && !read_some(ends[0].fd, take_out)) ends[0].fd = -1;
    if (ends[1].revents != 0 && !read_some(ends[1].fd, take_err)) ends[1].fd = -1;
  }
  output.status = wait_for(child);
  return output;
}

}  // namespace ombre::studio
