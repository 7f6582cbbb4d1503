// A library that is loaded before all others (LD_PRELOAD) and lets one call of the program fail, as a machine does that
// has no memory or no disk space left. tests/run_failures.py says which.
//
// OMBRE_FAIL_KIND   memory: malloc and its like; disk: write, pwrite, fsync, rename, mkdir, and open where it creates
// OMBRE_FAIL_AT     the number of the call that fails, from 1
// OMBRE_FAIL_FROM   calls count once a file whose path ends so is opened
// OMBRE_FAIL_REPORT a descriptor to which the number of calls is written at the end
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(size_t);            // NOLINT: glibc's names
void* __libc_calloc(size_t, size_t);    // NOLINT
void* __libc_realloc(void*, size_t);    // NOLINT
void* __libc_memalign(size_t, size_t);  // NOLINT
}

namespace {

enum class Kind { none, memory, disk };

Kind kind = Kind::none;
long fail_at = 0;
const char* begin_path = nullptr;
std::atomic<bool> counts{false};
std::atomic<long> calls{0};
thread_local int loading = 0;  // depth of calls of dlopen

// True if the code at the address belongs to OpenSSL, which crashes without memory; libzip has random numbers from it.
bool is_openssl(void* address) {
  Dl_info info{};
  return address && dladdr(address, &info) != 0 && info.dli_fname && std::strstr(info.dli_fname, "libcrypto");
}

// True for the one call that is to fail.
bool fails(Kind of, void* caller = nullptr) {
  if (kind != of || loading > 0 || !counts.load(std::memory_order_relaxed)) return false;
  return calls.fetch_add(1) + 1 == fail_at && !is_openssl(caller);
}

void note_opened(const char* path) {
  if (!begin_path || counts.load(std::memory_order_relaxed)) return;
  const size_t length = std::strlen(path), end = std::strlen(begin_path);
  if (length >= end && std::strcmp(path + length - end, begin_path) == 0) counts = true;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

__attribute__((constructor)) void read_environment() {
  const char *wanted = std::getenv("OMBRE_FAIL_KIND"), *at = std::getenv("OMBRE_FAIL_AT");
  begin_path = std::getenv("OMBRE_FAIL_FROM");
  if (at) fail_at = std::atol(at);
  if (wanted) kind = std::strcmp(wanted, "memory") == 0 ? Kind::memory : Kind::disk;
}

__attribute__((destructor)) void report() {
  const char* descriptor = std::getenv("OMBRE_FAIL_REPORT");
  if (!descriptor) return;
  const long made = calls.load();
  counts = false;
  [[maybe_unused]] const ssize_t written = ::write(std::atoi(descriptor), &made, sizeof made);
}

int open_file(const char* path, int flags, mode_t mode) {
  note_opened(path);
  if ((flags & O_CREAT) != 0 && fails(Kind::disk)) {
    errno = ENOSPC;
    return -1;
  }
  static auto* const real = next<int(int, const char*, int, ...)>("openat");
  return real(AT_FDCWD, path, flags, mode);
}

mode_t mode_of(int flags, va_list list) { return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(list, mode_t) : 0; }

}  // namespace

extern "C" {

void* malloc(size_t size) { return fails(Kind::memory, __builtin_return_address(0)) ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) {
  return fails(Kind::memory, __builtin_return_address(0)) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* memory, size_t size) {
  return fails(Kind::memory, __builtin_return_address(0)) ? nullptr : __libc_realloc(memory, size);
}
void* memalign(size_t alignment, size_t size) {
  return fails(Kind::memory) ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, size_t alignment, size_t size) {
  *memory = memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}

int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = mode_of(flags, list);
  va_end(list);
  return open_file(path, flags, mode);
}
int open64(const char* path, int flags, ...) __attribute__((alias("open")));
FILE* fopen(const char* path, const char* mode) {
  static auto* const real = next<FILE*(const char*, const char*)>("fopen");
  note_opened(path);
  return real(path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  static auto* const real = next<FILE*(const char*, const char*)>("fopen64");
  note_opened(path);
  return real(path, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  static auto* const real = next<ssize_t(int, const void*, size_t)>("write");
  if (descriptor > STDERR_FILENO && fails(Kind::disk)) {
    errno = ENOSPC;
    return -1;
  }
  return real(descriptor, bytes, count);
}
ssize_t pwrite(int descriptor, const void* bytes, size_t count, off_t place) {
  static auto* const real = next<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  if (fails(Kind::disk)) {
    errno = ENOSPC;
    return -1;
  }
  return real(descriptor, bytes, count, place);
}
int fsync(int descriptor) {
  static auto* const real = next<int(int)>("fsync");
  if (fails(Kind::disk)) {
    errno = EIO;
    return -1;
  }
  return real(descriptor);
}
int rename(const char* from, const char* to) {
  static auto* const real = next<int(const char*, const char*)>("rename");
  if (fails(Kind::disk)) {
    errno = EIO;
    return -1;
  }
  return real(from, to);
}
// What libraries do while they are loaded cannot be caught by anybody.
void* dlopen(const char* path, int flags) {
  static auto* const real = next<void*(const char*, int)>("dlopen");
  ++loading;
  void* const library = real(path, flags);
  --loading;
  return library;
}
int mkdir(const char* path, mode_t mode) {
  static auto* const real = next<int(const char*, mode_t)>("mkdir");
  if (fails(Kind::disk)) {
    errno = ENOSPC;
    return -1;
  }
  return real(path, mode);
}

}  // extern "C"
