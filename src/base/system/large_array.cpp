#include "base/system/large_array.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace ombre {
namespace {

constexpr size_t large_page = size_t{1} << 21;

}  // namespace

void FreeLargeArray::operator()(void* memory) const { std::free(memory); }

void* large_memory(size_t bytes) {
  const size_t alignment = bytes < large_page ? alignof(std::max_align_t) : large_page;
  const size_t size = (std::max<size_t>(bytes, 1) + alignment - 1) / alignment * alignment;
  void* const memory = size < bytes ? nullptr : std::aligned_alloc(alignment, size);
  if (!memory) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // The result is ignored: without large pages the memory is slower to fill, but works.
  if (alignment == large_page) static_cast<void>(madvise(memory, size, MADV_HUGEPAGE));
#endif
  return memory;
}

}  // namespace ombre
