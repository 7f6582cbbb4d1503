// Writes the header of NumPy's array files (.npy, version 1.0); the numbers follow it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

// Returns a header; `type` is in NumPy's notation, such as "<f4" or "|u1". The last axis of the shape varies fastest.
std::string npy_header(std::string_view type, const std::vector<int64_t>& shape);

}  // namespace ombre::formats
