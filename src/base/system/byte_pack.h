// Trivially copyable values as bytes, for another process of this program.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/text/error.h"

namespace ombre {

class BytePacker {
 public:
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add_text(std::string_view text) {
    add(uint64_t{text.size()});
    bytes_.append(text);
  }
  template <class T>
  void add_list(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_text({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Reads values that BytePacker wrote. Throws Error if the bytes end too early. The bytes must outlive this object.
class ByteUnpacker {
 public:
  explicit ByteUnpacker(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, next(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view get_text() { return next(get<uint64_t>()); }
  template <class T>
  std::vector<T> get_list() {
    const std::string_view text = get_text();
    std::vector<T> values(text.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), text.data(), values.size() * sizeof(T));
    return values;
  }

 private:
  std::string_view next(uint64_t size) {
    if (size > bytes_.size()) throw Error(Code::other_program, "a helper process sent too little");
    const std::string_view some = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return some;
  }

  std::string_view bytes_;
};

}  // namespace ombre
