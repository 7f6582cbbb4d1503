// The program `ombre`, and its use of memory.
#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "base/system/large_array.h"
#include "ombre/command_line.h"
#include "ombre/python_designs.h"
#include "sources/source_cache.h"

namespace {

// Greatest block that the allocator keeps; larger ones go back to the system as soon as they are freed.
constexpr int most_kept_bytes = 32 << 20;

}  // namespace

// Sanitizers have an allocator of their own.
#ifndef OMBRE_SANITIZED
// Large blocks come in large pages; meshes of millions of triangles take up to a quarter less time by this.
void* operator new(std::size_t bytes) {
  if (bytes >= most_kept_bytes) return ombre::large_memory(bytes);
  void* const memory = std::malloc(std::max<std::size_t>(bytes, 1));
  if (!memory) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif

int main(int argc, char** argv) {
  // Slabs come and go by the megabyte, and returning their pages each time costs more than filling them.
  mallopt(M_MMAP_THRESHOLD, most_kept_bytes);
  mallopt(M_TRIM_THRESHOLD, 8 * most_kept_bytes);
  if (ombre::cli::needs_python(argc, argv)) return ombre::cli::become_python(argc, argv);
  ombre::sources::SourceCache cache;
  ombre::cli::Host host;
  host.cache = &cache;
  return ombre::cli::run(argc, argv, host);
}
