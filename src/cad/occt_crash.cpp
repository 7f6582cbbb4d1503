#ifdef OMBRE_CAD

#include "cad/occt_crash.h"

#include <csetjmp>
#include <csignal>

namespace ombre::cad {
namespace {

thread_local sigjmp_buf* way_back = nullptr;

void leave(int signal) {
  if (way_back) siglongjmp(*way_back, signal);
  // Another thread's: it crashes as it would have.
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// Signals of bad memory accesses, for as long as this lives.
class Signals {
 public:
  Signals() {
    struct sigaction action {};
    action.sa_handler = leave;
    sigaction(SIGSEGV, &action, &segv_);
    sigaction(SIGBUS, &action, &bus_);
  }
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  ~Signals() {
    way_back = nullptr;
    sigaction(SIGSEGV, &segv_, nullptr);
    sigaction(SIGBUS, &bus_, nullptr);
  }

 private:
  struct sigaction segv_ {
  }, bus_{};
};

}  // namespace

bool survives(const std::function<void()>& f) {
  const Signals signals;
  sigjmp_buf here;
  if (sigsetjmp(here, 1) != 0) return false;
  way_back = &here;
  f();
  return true;
}

}  // namespace ombre::cad

#endif
