// The memory that other programs leave free.
#pragma once

#include <cstdint>

namespace ombre {

// Returns the bytes that can be allocated without swapping; 0 if the system does not say.
uint64_t free_memory_bytes();

}  // namespace ombre
