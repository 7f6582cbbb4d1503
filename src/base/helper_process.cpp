// Work in a process of its own, with limits of time and memory: for libraries that files can crash or hang.
#include "base/helper_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "base/byte_pack.h"
#include "base/stopwatch.h"

namespace ombre {
namespace {

constexpr int check_interval_ms = 50;

// The child sends this before its bytes.
struct Header {
  uint64_t is_error = 0, size = 0;
};

std::string packed_error(const Error& error) {
  BytePacker packer;
  packer.add(error.code());
  packer.add_text(error.what());
  packer.add(uint64_t{error.values().size()});
  for (const auto& [name, value] : error.values()) {
    packer.add_text(name);
    packer.add_text(value);
  }
  return packer.take();
}

Error unpacked_error(const std::string& bytes) {
  ByteUnpacker unpacker(bytes);
  const Code code = unpacker.get<Code>();
  const std::string message(unpacker.get_text());
  CodeValues values(unpacker.get<uint64_t>());
  for (auto& [name, value] : values) {
    name = unpacker.get_text();
    value = unpacker.get_text();
  }
  return {code, message, values};
}

void write_all(int pipe, const void* data, size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(pipe, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(EXIT_FAILURE);
    at += written;
    size -= static_cast<size_t>(written);
  }
}

void limit_memory(size_t bytes) {
  size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;  // the first number: all that is mapped
  if (pages == 0) return;
  const rlim_t limit = static_cast<rlim_t>(pages) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + bytes;
  const rlimit memory{limit, limit}, core{0, 0};
  ::setrlimit(RLIMIT_AS, &memory);
  ::setrlimit(RLIMIT_CORE, &core);
}

[[noreturn]] void be_the_child(int pipe, pid_t parent, const std::function<std::string()>& work,
                               const HelperLimits& limits) {
  for (const int signal : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) std::signal(signal, SIG_DFL);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(EXIT_FAILURE);
  limit_memory(limits.memory_bytes);
  Header header;
  std::string bytes;
  try {
    bytes = work();
  } catch (const Error& error) {
    header.is_error = 1;
    bytes = packed_error(error);
  } catch (const std::bad_alloc& error) {
    header.is_error = 1;
    bytes = packed_error(Error(Code::memory, error.what()));
  } catch (const std::exception& error) {
    header.is_error = 1;
    bytes = packed_error(Error(error.what()));
  }
  header.size = bytes.size();
  write_all(pipe, &header, sizeof header);
  write_all(pipe, bytes.data(), bytes.size());
  ::_exit(EXIT_SUCCESS);
}

class Child {
 public:
  Child(const std::function<std::string()>& work, const HelperLimits& limits) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw Error(Code::other_program, std::string("no pipe to a helper process: ") + std::strerror(errno));
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ == 0) {
      ::close(ends[0]);
      be_the_child(ends[1], parent, work, limits);
    }
    ::close(ends[1]);
    pipe_ = ends[0];
    if (pid_ < 0) {
      ::close(pipe_);
      throw Error(Code::other_program, std::string("no helper process could be started: ") + std::strerror(errno));
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    ::close(pipe_);
    if (is_running_) end();
  }

  // Appends what has come. False at the end.
  bool read(std::string& bytes) {
    pollfd wait{pipe_, POLLIN, 0};
    if (::poll(&wait, 1, check_interval_ms) <= 0) return true;
    static thread_local std::array<char, 1 << 16> some;
    const ssize_t count = ::read(pipe_, some.data(), some.size());
    if (count < 0) return errno == EINTR;
    bytes.append(some.data(), static_cast<size_t>(count));
    return count > 0;
  }

  // The signal that ended it, if one did.
  int end(bool by_force = true) {
    if (by_force) ::kill(pid_, SIGKILL);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    is_running_ = false;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

 private:
  pid_t pid_ = -1;
  int pipe_ = -1;
  bool is_running_ = true;
};

bool is_whole(const std::string& bytes, Header& header) {
  if (bytes.size() < sizeof header) return false;
  std::memcpy(&header, bytes.data(), sizeof header);
  return bytes.size() - sizeof header >= header.size;
}

}  // namespace

std::string run_in_helper(const std::function<std::string()>& work, const HelperLimits& limits,
                          const std::function<Error(HelperFailure)>& explain, const StopFlag* stop) {
  Child child(work, limits);
  const Stopwatch watch;
  std::string bytes;
  Header header;
  while (!is_whole(bytes, header)) {
    if (!child.read(bytes)) break;
    if (stop && stop->requested()) throw Cancelled();
    if (watch.seconds() > limits.seconds) throw explain(HelperFailure::too_slow);
  }
  if (!is_whole(bytes, header)) {
    const int signal = child.end(false);
    if (signal == SIGINT || signal == SIGTERM) throw Cancelled();
    throw explain(HelperFailure::crashed);
  }
  bytes.erase(0, sizeof header);
  if (header.is_error != 0) throw unpacked_error(bytes);
  return bytes;
}

}  // namespace ombre
