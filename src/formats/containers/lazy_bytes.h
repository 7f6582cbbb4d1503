// The bytes of a file that is never completely in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

using ByteSink = std::function<void(std::string_view)>;

// A sequence of rows, each generated whenever it is read. Objects that rows refer to must outlive it.
class LazyBytes {
 public:
  using Row = std::function<void(std::string& bytes, size_t index)>;  // appends the row's bytes

  void add(std::string bytes);
  void add_rows(size_t count, Row row);
  // Appends the rows of another sequence.
  void add(const LazyBytes& others);

  // Writes all bytes in order, in pieces of about 64 KiB.
  void write(const ByteSink& sink) const;
  uint64_t size() const;

 private:
  friend class LazyBytesReader;
  struct Rows {
    size_t count = 0;
    Row row;
  };
  std::vector<Rows> parts_;
};

// Reads the bytes piece by piece.
class LazyBytesReader {
 public:
  explicit LazyBytesReader(const LazyBytes& bytes) : bytes_(bytes) {}

  // Returns the next bytes, about 64 KiB, or none at the end. They are valid until the next call.
  std::string_view next();

 private:
  const LazyBytes& bytes_;
  size_t part_ = 0, row_ = 0;
  std::string piece_;
};

}  // namespace ombre::formats
