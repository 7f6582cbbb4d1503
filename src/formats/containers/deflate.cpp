#include "formats/containers/deflate.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/system/assert.h"
#include "formats/containers/deflate_symbols.h"
#include "formats/containers/huffman.h"

namespace ombre::formats {
namespace {

// With codes of at most 14 bits, four literals can be written at once; compared with 15 bits the loss is negligible.
constexpr unsigned longest_literal_code = 14, longest_distance_code = 15, longest_header_code = 7;

// If a block has many short steps, every eighth is enough to estimate its statistics, and faster.
constexpr size_t many_steps = 4096, long_step = 64;  // bytes of long matches per step, on average
constexpr uint32_t counted_of_many = 8;

// A sequence of bits to write.
struct Bits {
  uint32_t bits = 0;
  uint32_t count = 0;
};

Bits joined(Bits a, Bits b) { return {a.bits | b.bits << a.count, a.count + b.count}; }

// Returns the index of a distance, minus one, in the table of symbols; a lookup is faster than calculating the symbol.
constexpr uint32_t distance_slot(uint32_t behind) { return behind < 256 ? behind : 256 + behind / 128; }
constexpr uint32_t distance_slot_count = distance_slot(DeflateWriter::window - 1) + 1;

struct DistanceSymbols {
  std::array<uint8_t, distance_slot_count> in_slot{};
  std::array<uint32_t, distance_symbol_count> first{};  // by symbol: its first distance, minus one
};

constexpr DistanceSymbols distance_symbols = [] {
  DistanceSymbols symbols;
  const auto add = [&](uint32_t behind) {
    const uint8_t index = distance_symbol(behind + 1).index;
    symbols.in_slot[distance_slot(behind)] = index;
    symbols.first[index] = behind;
  };
  for (uint32_t behind = DeflateWriter::window; behind > 256;) add(behind -= 128);
  for (uint32_t behind = 256; behind > 0;) add(--behind);
  return symbols;
}();

constexpr uint8_t distance_index(uint32_t behind) { return distance_symbols.in_slot[distance_slot(behind)]; }

// The pieces of a long step: as many of the longest matches as leave the last one long enough.
struct Pieces {
  uint32_t longest = 0, first = 0, last = 0;  // number of longest matches; lengths of two shorter ones, or 0

  explicit Pieces(uint32_t length) : longest(length / longest_match), last(length % longest_match) {
    if (last == 0 || last >= DeflateWriter::shortest_match) return;
    if (longest > 0) --longest;
    first = longest_match - DeflateWriter::shortest_match;
    last += DeflateWriter::shortest_match;
  }
};

// Incrementing a counter twice in a row waits for memory, and neighbouring matches are often equal. So neighbours use
// separate tables alternately.
struct MatchCounts {
  std::array<uint32_t, longest_match + 1> lengths{};
  std::array<uint32_t, distance_symbol_count> distances{};

  void add(uint32_t length, uint32_t behind) {
    uint32_t& count = distances[distance_index(behind)];
    if (length <= longest_match) {
      ++lengths[length];
      ++count;
      return;
    }
    const Pieces pieces(length);
    lengths[longest_match] += pieces.longest;
    ++lengths[pieces.first];
    ++lengths[pieces.last];
    count += pieces.longest + (pieces.first > 0) + (pieces.last > 0);
  }
};

struct SymbolCounts {
  std::array<uint32_t, literal_symbol_count> literals{};
  std::array<uint32_t, distance_symbol_count> distances{};

  void add_matches(const MatchCounts& counts, uint32_t times) {
    for (uint32_t length = DeflateWriter::shortest_match; length <= longest_match; ++length)
      literals[first_length_symbol + length_symbol(length).index] += times * counts.lengths[length];
    for (size_t i = 0; i < distances.size(); ++i) distances[i] += times * counts.distances[i];
  }
  // Counts every symbol once more, so that any match has a code.
  void add_every_match() {
    for (size_t i = 0; i < length_symbol_count; ++i) ++literals[first_length_symbol + i];
    for (uint32_t& distance : distances) ++distance;
  }
  void add_literals(std::span<const uint8_t> bytes) {
    std::array<std::array<uint32_t, 256>, 4> tables{};
    size_t i = 0;
    for (; i + 4 <= bytes.size(); i += 4)
      for (size_t k = 0; k < 4; ++k) ++tables[k][bytes[i + k]];
    for (; i < bytes.size(); ++i) ++tables[0][bytes[i]];
    for (size_t byte = 0; byte < 256; ++byte)
      for (const auto& table : tables) literals[byte] += table[byte];
  }
};

// --- the header of a block: its code lengths, run-length coded (RFC 1951, 3.2.7) ---

constexpr unsigned header_symbol_count = 19;

struct HeaderItem {
  uint8_t symbol, extra, extra_count;
};

// Appends `count` times the same length.
void add_repeats(std::vector<HeaderItem>& items, uint8_t length, size_t count) {
  if (length > 0) {
    items.push_back({length, 0, 0});
    --count;
  }
  while (count >= 3) {
    const size_t most = length > 0 ? 6 : count <= 10 ? 10 : 138;
    const size_t now = std::min(count, most);
    if (length > 0)
      items.push_back({16, static_cast<uint8_t>(now - 3), 2});
    else if (most == 10)
      items.push_back({17, static_cast<uint8_t>(now - 3), 3});
    else
      items.push_back({18, static_cast<uint8_t>(now - 11), 7});
    count -= now;
  }
  items.insert(items.end(), count, {length, 0, 0});
}

std::vector<HeaderItem> header_items(std::span<const uint8_t> lengths) {
  std::vector<HeaderItem> items;
  for (size_t i = 0; i < lengths.size();) {
    size_t end = i + 1;
    while (end < lengths.size() && lengths[end] == lengths[i]) ++end;
    add_repeats(items, lengths[i], end - i);
    i = end;
  }
  return items;
}

size_t used(std::span<const uint8_t> lengths, size_t least) {
  size_t count = lengths.size();
  while (count > least && lengths[count - 1] == 0) --count;
  return count;
}

void write_code_lengths(BitWriter& out, std::span<const uint8_t> literals, std::span<const uint8_t> distances) {
  constexpr std::array<uint8_t, header_symbol_count> order = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                              11, 4,  12, 3, 13, 2, 14, 1, 15};
  const size_t literal_count = used(literals, first_length_symbol), distance_count = used(distances, 1);
  std::vector<uint8_t> all(literals.begin(), literals.begin() + static_cast<std::ptrdiff_t>(literal_count));
  all.insert(all.end(), distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(distance_count));
  const std::vector<HeaderItem> items = header_items(all);

  std::array<uint32_t, header_symbol_count> counts{};
  for (const HeaderItem& item : items) ++counts[item.symbol];
  std::array<uint8_t, header_symbol_count> lengths{};
  std::array<uint16_t, header_symbol_count> codes{};
  choose_code_lengths(counts, longest_header_code, lengths);
  assign_codes(lengths, codes);
  size_t kept = header_symbol_count;
  while (kept > 4 && lengths[order[kept - 1]] == 0) --kept;

  out.put(literal_count - first_length_symbol, 5);
  out.put(distance_count - 1, 5);
  out.put(kept - 4, 4);
  for (size_t i = 0; i < kept; ++i) out.put(lengths[order[i]], 3);
  for (const HeaderItem& item : items) {
    out.put(codes[item.symbol], lengths[item.symbol]);
    out.put(item.extra, item.extra_count);
  }
}

}  // namespace

struct DeflateWriter::Codes {
  std::array<Bits, literal_symbol_count> literals{};
  std::array<Bits, longest_match + 1> lengths{};  // including the extra bits

  Codes(BitWriter& out, const SymbolCounts& counts) {
    std::array<uint8_t, literal_symbol_count> literal_lengths{};
    std::array<uint16_t, literal_symbol_count> literal_codes{};
    choose_code_lengths(counts.literals, longest_literal_code, literal_lengths);
    assign_codes(literal_lengths, literal_codes);
    std::array<uint8_t, distance_symbol_count> distance_lengths{};
    std::array<uint16_t, distance_symbol_count> distance_codes{};
    choose_code_lengths(counts.distances, longest_distance_code, distance_lengths);
    assign_codes(distance_lengths, distance_codes);
    write_code_lengths(out, literal_lengths, distance_lengths);

    for (size_t i = 0; i < literals.size(); ++i) literals[i] = {literal_codes[i], literal_lengths[i]};
    for (size_t i = 0; i < distances_.size(); ++i) {
      const uint32_t first = distance_symbols.first[i], shift = distance_lengths[i];
      distances_[i] = {distance_codes[i] - (first << shift), shift, shift + distance_symbol(first + 1).extra_count};
    }
    for (uint32_t length = shortest_match; length <= longest_match; ++length) {
      const Symbol symbol = length_symbol(length);
      lengths[length] = joined(literals[first_length_symbol + symbol.index], {symbol.extra, symbol.extra_count});
    }
  }

  // Inlining keeps the cursor in registers, which halves the time for streams of short matches.
  [[gnu::always_inline]] void put_literals(BitCursor& out, const uint8_t* at, const uint8_t* end) const {
    for (; end - at >= 4; at += 4) {
      uint64_t bits = 0;
      unsigned count = 0;
      for (size_t i = 0; i < 4; ++i) {
        const Bits literal = literals[at[i]];
        bits |= uint64_t{literal.bits} << count;
        count += literal.count;
      }
      out.put(bits, count);
    }
    for (; at != end; ++at) out.put(literals[*at].bits, literals[*at].count);
  }

  [[gnu::always_inline]] void put_match(BitCursor& out, const Step& step) const {
    if (step.length <= longest_match) return put(out, match(step.length, step.behind));
    const Pieces pieces(step.length);
    const LongBits longest = match(longest_match, step.behind);
    for (uint32_t i = 0; i < pieces.longest; ++i) put(out, longest);
    if (pieces.first > 0) put(out, match(pieces.first, step.behind));
    if (pieces.last > 0) put(out, match(pieces.last, step.behind));
  }

  // Each write depends on the previous one, so most short matches are written in pairs.
  [[gnu::always_inline]] void put_short_matches(BitCursor& out, const Step& a, const Step& b) const {
    const LongBits first = match(a.length, a.behind), second = match(b.length, b.behind);
    if (first.count + second.count <= BitCursor::most_bits)
      return put(out, {first.bits | second.bits << first.count, first.count + second.count});
    put(out, first);
    put(out, second);
  }

 private:
  struct LongBits {
    uint64_t bits;
    uint32_t count;
  };

  static void put(BitCursor& out, LongBits bits) { out.put(bits.bits, bits.count); }
  [[gnu::always_inline]] LongBits match(uint32_t length, uint32_t behind) const {
    const Bits bits = lengths[length];
    const Distances& distances = distances_[distance_index(behind)];
    const uint32_t far = (behind << distances.shift) + distances.offset;
    return {bits.bits | uint64_t{far} << bits.count, bits.count + distances.count};
  }

  // The distances of a symbol: the symbol's code, followed by the offset from its first distance.
  struct Distances {
    uint32_t offset, shift, count;
  };
  std::array<Distances, distance_symbol_count> distances_{};
};

DeflateWriter::DeflateWriter() : steps_(most_steps + 1) {
  literals_.reserve(most_literals);
  steps_[0].behind = window;
}

void DeflateWriter::literals(const uint8_t* bytes, size_t count) {
  while (count > 0) {
    if (literals_.size() == most_literals) end_block(false);
    const size_t now = std::min(count, most_literals - literals_.size());
    literals_.insert(literals_.end(), bytes, bytes + now);
    literals_behind_ += now;
    bytes += now;
    count -= now;
  }
}

// Adds a match longer than any symbol's, or extends the previous match if the distance is the same.
void DeflateWriter::long_match(uint32_t length, uint16_t behind) {
  if (matched_ >= most_matched) end_block(false);
  matched_ += length;
  if (goes_on(behind))
    steps_[step_count_].length += length;
  else
    add_step(length, behind);
}

void DeflateWriter::finish() {
  end_block(true);
  out_.reserve(1);
  out_.fill_byte();
}

void DeflateWriter::end_block(bool is_last) {
  SymbolCounts counts;
  counts.add_literals(literals_);
  const uint32_t stride = step_count_ >= many_steps && matched_ < long_step * step_count_ ? counted_of_many : 1;
  std::array<MatchCounts, 2> turns;
  size_t turn = 0;
  for (size_t i = 0; i < step_count_; i += stride) turns[turn++ % 2].add(steps()[i].length, steps()[i].behind);
  for (const MatchCounts& matches : turns) counts.add_matches(matches, stride);
  if (stride > 1) counts.add_every_match();
  counts.literals[end_of_block] = 1;

  constexpr size_t largest_header = 512, largest_literal = 2, largest_match = 6;
  const size_t most_matches = 2 * step_count_ + matched_ / longest_match;  // including the pieces of long steps
  out_.reserve(largest_header + literals_.size() * largest_literal + most_matches * largest_match);
  out_.put(is_last, 1);
  out_.put(2, 2);  // dynamic Huffman codes
  const Codes codes(out_, counts);
  write_steps(codes);
  out_.put(codes.literals[end_of_block].bits, codes.literals[end_of_block].count);
  literals_.clear();
  step_count_ = 0;
  literals_behind_ = 0;
  matched_ = 0;
}

void DeflateWriter::write_steps(const Codes& codes) {
  const uint8_t* literal = literals_.data();
  BitCursor out = out_.begin();
  for (std::span<const Step> left = steps(); !left.empty();) {
    if (left.size() >= 2 && left[0].is_short_match() && left[1].is_short_match()) {
      codes.put_short_matches(out, left[0], left[1]);
      left = left.subspan(2);
      continue;
    }
    const Step& step = left[0];
    codes.put_literals(out, literal, literal + step.literals);
    literal += step.literals;
    codes.put_match(out, step);
    left = left.subspan(1);
  }
  codes.put_literals(out, literal, literals_.data() + literals_.size());
  out_.end(out);
}

}  // namespace ombre::formats
