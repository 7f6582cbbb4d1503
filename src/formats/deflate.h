// A deflate stream from literals and matches that the caller has found.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/assert.h"
#include "formats/bit_writer.h"
#include "formats/deflate_symbols.h"

namespace ombre::formats {

// Writes blocks with Huffman codes of their own. The bytes depend on the calls alone, not on the processor.
class DeflateWriter {
 public:
  static constexpr uint32_t window = 32768, shortest_match = 3;

  DeflateWriter();

  void literals(const uint8_t* bytes, size_t count);
  // The next `length` bytes repeat those `distance` back, which lie at most `window` behind; they may overlap.
  // Any length from the shortest match on.
  void match(uint32_t length, uint32_t distance) {
    ASSERT(length >= shortest_match && distance - 1 < window);
    make_room();
    matched_ += length;
    const auto literal_count = static_cast<uint32_t>(literals_.size() - literals_in_steps_);
    Step* const last = &steps_[step_count_];
    if (literal_count == 0 && last->distance == distance) {
      last->length += length;
      return;
    }
    last[1] = {literal_count, length, distance, distance_symbol(distance)};
    ++step_count_;
    literals_in_steps_ = literals_.size();
  }
  void finish();

  // Whole bytes of the stream; they grow with each block, and the caller clears what it has taken.
  const uint8_t* data() const { return out_.data(); }
  size_t size() const { return out_.size(); }
  void clear() { out_.clear(); }

 private:
  struct Step {
    uint32_t literals, length, distance;
    Symbol far;  // of the distance

    bool is_short_match() const { return literals == 0 && length <= longest_match; }
  };
  struct Codes;

  // Large enough to make headers cheap, small enough to follow a design from layer region to region.
  static constexpr size_t most_literals = size_t{1} << 16, most_steps = size_t{1} << 14;
  static constexpr uint64_t most_matched = uint64_t{1} << 24;  // so that a block's bits stay small too

  // Ahead of what comes next, so that the last block is never an empty one.
  void make_room() {
    if (step_count_ == most_steps || literals_.size() == most_literals || matched_ >= most_matched) end_block(false);
  }
  std::span<const Step> steps() const { return {&steps_[1], step_count_}; }
  void end_block(bool is_last);
  void write_steps(const Codes& codes);

  BitWriter out_;
  // The block so far: each step is some literals, then a match; literals after the last one follow.
  std::vector<uint8_t> literals_;
  std::vector<Step> steps_;  // behind one that is not meant
  size_t step_count_ = 0;
  size_t literals_in_steps_ = 0;
  uint64_t matched_ = 0;  // bytes
};

}  // namespace ombre::formats
