// Work in a separate process, with limits of time and memory.
#include "base/system/helper_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <mutex>
#include <sstream>

#include "base/system/byte_pack.h"
#include "base/system/stopwatch.h"

namespace ombre {
namespace {

constexpr int check_interval_ms = 50;

// Precedes the bytes of each request and answer.
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

// Returns false if the other end is closed.
bool write_all(int socket, const void* data, size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::send(socket, at, size, MSG_NOSIGNAL);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    at += written;
    size -= static_cast<size_t>(written);
  }
  return true;
}

bool send_message(int socket, const Header& header, const std::string& bytes) {
  return write_all(socket, &header, sizeof header) && write_all(socket, bytes.data(), bytes.size());
}

bool is_whole(const std::string& bytes, Header& header) {
  if (bytes.size() < sizeof header) return false;
  std::memcpy(&header, bytes.data(), sizeof header);
  return bytes.size() - sizeof header >= header.size;
}

// Appends the bytes that have arrived. Returns false at the end of the stream.
bool read_some(int socket, std::string& bytes) {
  static thread_local std::array<char, 1 << 16> some;
  const ssize_t count = ::read(socket, some.data(), some.size());
  if (count < 0) return errno == EINTR;
  bytes.append(some.data(), static_cast<size_t>(count));
  return count > 0;
}

void limit_memory(size_t bytes) {
  const rlimit core{0, 0};
  ::setrlimit(RLIMIT_CORE, &core);
  size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;  // the first number is the total size of mapped memory
  if (pages == 0 || bytes == 0) return;
  const rlim_t limit = static_cast<rlim_t>(pages) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + bytes;
  const rlimit memory{limit, limit};
  ::setrlimit(RLIMIT_AS, &memory);
}

// Returns the processor time in seconds that a process and the children that it has waited for have used, or 0 if the
// system does not say.
double processor_seconds(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(file, text, '\0');
  // The name of the program, which may hold blanks, is in parentheses. The times are fields 14 to 17 (proc(5)).
  const size_t end_of_name = text.rfind(')');
  if (end_of_name == std::string::npos) return 0;
  std::istringstream fields(text.substr(end_of_name + 1));
  constexpr int first_after_name = 3, first_time = 14, last_time = 17;
  std::string skipped;
  for (int field = first_after_name; field < first_time; ++field) fields >> skipped;
  double ticks = 0, time = 0;
  for (int field = first_time; field <= last_time && fields >> time; ++field) ticks += time;
  return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

using Answer = std::function<std::string(const std::string& request)>;

[[noreturn]] void be_the_child(int socket, pid_t parent, const Answer& answer, size_t memory_bytes) {
  for (const int signal : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) std::signal(signal, SIG_DFL);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(EXIT_FAILURE);
  limit_memory(memory_bytes);
  for (;;) {
    Header header;
    std::string bytes;
    while (!is_whole(bytes, header))
      if (!read_some(socket, bytes)) ::_exit(EXIT_SUCCESS);
    bytes.erase(0, sizeof header);
    header.is_error = 0;
    try {
      bytes = answer(bytes);
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
    if (!send_message(socket, header, bytes)) ::_exit(EXIT_FAILURE);
  }
}

// Serialises forks: a child that is forked meanwhile would keep the other child's end of the socket open, so that its
// crash would go unnoticed.
std::mutex& fork_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

class Helper::Child {
 public:
  Child(const Answer& answer, size_t memory_bytes) {
    std::array<int, 2> ends{};
    std::unique_lock lock(fork_mutex());
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      throw Error(Code::other_program, std::string("no socket to a helper process: ") + std::strerror(errno));
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ == 0) {
      lock.unlock();
      ::close(ends[0]);
      be_the_child(ends[1], parent, answer, memory_bytes);
    }
    const int failure = errno;
    ::close(ends[1]);
    socket_ = ends[0];
    if (pid_ > 0) return;
    ::close(socket_);
    throw Error(Code::other_program, std::string("no helper process could be started: ") + std::strerror(failure));
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    ::close(socket_);
    if (is_running_) end();
  }

  bool send(const std::string& bytes) { return send_message(socket_, {0, bytes.size()}, bytes); }

  // Waits up to 50 ms and appends the bytes that have arrived, if any. Returns false at the end of the stream.
  bool read(std::string& bytes) {
    pollfd wait{socket_, POLLIN, 0};
    return ::poll(&wait, 1, check_interval_ms) <= 0 || read_some(socket_, bytes);
  }

  double processor_seconds() const { return ombre::processor_seconds(pid_); }

  // Waits for the child to end, and kills it first if `by_force`. Returns the signal that ended it, or 0.
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
  int socket_ = -1;
  bool is_running_ = true;
};

Helper::Helper(Answer answer, const HelperLimits& limits, HelperExplain explain)
    : limits_(limits), explain_(std::move(explain)), child_(std::make_unique<Child>(answer, limits.memory_bytes)) {}

Helper::~Helper() = default;

std::string Helper::ask(const std::string& request, const StopFlag* stop, const std::function<void()>& waiting) {
  std::unique_ptr<Child> child = std::move(child_);
  if (!child) throw explain_(HelperFailure::crashed);
  const Stopwatch watch;
  const double used_before = child->processor_seconds();
  // Work in one thread uses no more processor time than the clock shows.
  const auto is_too_slow = [&] {
    const double seconds = watch.seconds();
    if (seconds <= limits_.seconds) return false;
    return seconds > HelperLimits::clock_factor * limits_.seconds ||
           child->processor_seconds() - used_before > limits_.seconds;
  };
  std::string bytes;
  Header header;
  bool is_there = child->send(request);
  while (is_there && !is_whole(bytes, header)) {
    is_there = child->read(bytes);
    if (stop && stop->requested()) throw Cancelled();
    if (is_too_slow()) throw explain_(HelperFailure::too_slow);
    if (waiting) waiting();
  }
  if (!is_whole(bytes, header)) {
    const int signal = child->end(false);
    if (signal == SIGINT || signal == SIGTERM) throw Cancelled();
    throw explain_(HelperFailure::crashed);
  }
  bytes.erase(0, sizeof header);
  child_ = std::move(child);
  if (header.is_error != 0) throw unpacked_error(bytes);
  return bytes;
}

std::string run_in_helper(const std::function<std::string()>& work, const HelperLimits& limits,
                          const HelperExplain& explain, const StopFlag* stop) {
  Helper helper([&](const std::string&) { return work(); }, limits, explain);
  return helper.ask({}, stop);
}

}  // namespace ombre
