// Large uninitialised arrays, whose memory is mapped when threads first write to it.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace ombre {

struct FreeLargeArray {
  void operator()(void* memory) const;
};

template <class T>
using LargeArray = std::unique_ptr<T[], FreeLargeArray>;

// Allocates memory in large pages where the system has them, since mapping small pages takes longer than filling them.
// Throws std::bad_alloc.
void* large_memory(size_t bytes);

template <class T>
LargeArray<T> unset_large_array(size_t count) {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  if (count > static_cast<size_t>(-1) / sizeof(T)) throw std::bad_alloc();
  return LargeArray<T>(static_cast<T*>(large_memory(count * sizeof(T))));
}

}  // namespace ombre
