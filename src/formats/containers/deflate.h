// Writes a deflate stream from literals and matches found by the caller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/system/assert.h"
#include "formats/containers/bit_writer.h"
#include "formats/containers/deflate_symbols.h"

namespace ombre::formats {

// Writes blocks with dynamic Huffman codes. The bytes depend only on the calls, not on the processor.
class DeflateWriter {
 public:
  static constexpr uint32_t window = 32768, shortest_match = 3;

  DeflateWriter();

  void literals(const uint8_t* bytes, size_t count);
  // Adds a match: the next `length` bytes repeat those `distance` earlier, at most `window`; source and copy may
  // overlap. The length may be anything from the shortest match on.
  void match(uint32_t length, uint32_t distance) {
    ASSERT(length >= shortest_match && distance - 1 < window);
    if (step_count_ == most_steps) end_block(false);
    const auto behind = static_cast<uint16_t>(distance - 1);
    if (goes_on(behind) || length > longest_match) return long_match(length, behind);
    add_step(length, behind);
  }
  void finish();

  // Returns the complete bytes of the stream. They grow with each block, and the caller clears what it has taken.
  const uint8_t* data() const { return out_.data(); }
  size_t size() const { return out_.size(); }
  void clear() { out_.clear(); }

 private:
  // Some literals, followed by a match.
  struct Step {
    uint32_t length;
    uint16_t literals, behind;  // number of literals; the distance minus one

    bool is_short_match() const { return literals == 0 && length <= longest_match; }
  };
  struct Codes;

  // Limits of a block: large enough to make headers cheap, small enough to adapt to regions of a layer.
  static constexpr size_t most_literals = UINT16_MAX, most_steps = size_t{1} << 15;
  static constexpr uint64_t most_matched = uint64_t{1} << 24;  // limits the number of bits in a block

  // Returns true if the previous match has the same distance and no literals follow it.
  bool goes_on(uint16_t behind) const { return literals_behind_ == 0 && steps_[step_count_].behind == behind; }
  void long_match(uint32_t length, uint16_t behind);
  void add_step(uint32_t length, uint16_t behind) {
    steps_[++step_count_] = {length, static_cast<uint16_t>(literals_behind_), behind};
    literals_behind_ = 0;
  }
  std::span<const Step> steps() const { return {&steps_[1], step_count_}; }
  void end_block(bool is_last);
  void write_steps(const Codes& codes);

  BitWriter out_;
  // The current block. Literals may follow its last step. A block ends only when more data arrives, so that the last
  // one is never empty.
  std::vector<uint8_t> literals_;
  std::vector<Step> steps_;  // preceded by one farther than any possible distance
  size_t step_count_ = 0;
  size_t literals_behind_ = 0;  // number of literals after the last step
  uint64_t matched_ = 0;        // bytes of long matches
};

}  // namespace ombre::formats
