// Bytes of volumes for tests.
#pragma once

#include <string>
#include <vector>

namespace ombre::formats {

template <class T>
std::string bytes_of_numbers(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace ombre::formats
