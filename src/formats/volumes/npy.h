// The header of NumPy's array files (.npy, version 1.0); the numbers follow it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

// `type` in NumPy's words, such as "<f4" or "|u1"; the last axis of the shape is the fastest.
std::string npy_header(std::string_view type, const std::vector<int64_t>& shape);

}  // namespace ombre::formats
