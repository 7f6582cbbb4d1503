// A deflate stream from literals and matches that the caller has found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/bit_writer.h"

namespace ombre::formats {

// Writes blocks with Huffman codes of their own. The bytes depend on the calls alone, not on the processor.
class DeflateWriter {
 public:
  static constexpr uint32_t window = 32768, shortest_match = 3;

  DeflateWriter();

  void literals(const uint8_t* bytes, size_t count);
  // The next `length` bytes repeat those `distance` back, which lie at most `window` behind; they may overlap.
  // Any length from the shortest match on.
  void match(uint32_t length, uint32_t distance);
  void finish();

  // Whole bytes of the stream; they grow with each block, and the caller clears what it has taken.
  const uint8_t* data() const { return out_.data(); }
  size_t size() const { return out_.size(); }
  void clear() { out_.clear(); }

 private:
  struct Step {
    uint32_t literals, length, distance;
  };
  struct Codes;

  void make_room();
  void end_block(bool is_last);
  void write_steps(const Codes& codes);

  BitWriter out_;
  // The block so far: each step is some literals, then a match; literals after the last one follow.
  std::vector<uint8_t> literals_;
  std::vector<Step> steps_;
  size_t literals_in_steps_ = 0;
  uint64_t matched_ = 0;  // bytes
};

}  // namespace ombre::formats
