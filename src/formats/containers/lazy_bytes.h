// The bytes of a file that is never whole in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

using ByteSink = std::function<void(std::string_view)>;

// Rows that are made when it is their turn, as often as somebody reads them. What rows refer to must live as long.
class LazyBytes {
 public:
  using Row = std::function<void(std::string& bytes, size_t index)>;  // appends

  void add(std::string bytes);
  void add_rows(size_t count, Row row);
  // The others, behind what is there.
  void add(const LazyBytes& others);

  // All of them in order, in pieces of some 64 KiB.
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

// Reads piece by piece.
class LazyBytesReader {
 public:
  explicit LazyBytesReader(const LazyBytes& bytes) : bytes_(bytes) {}

  // The next bytes, some 64 KiB of them; empty at the end. They stay until the next call.
  std::string_view next();

 private:
  const LazyBytes& bytes_;
  size_t part_ = 0, row_ = 0;
  std::string piece_;
};

}  // namespace ombre::formats
