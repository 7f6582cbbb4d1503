// Memory that other programs leave.
#pragma once

#include <cstdint>

namespace ombre {

// Bytes that can be had without pushing others out; 0 where the system does not say.
uint64_t free_memory_bytes();

}  // namespace ombre
