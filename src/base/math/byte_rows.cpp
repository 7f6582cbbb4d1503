#include "base/math/byte_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "base/math/byte_row_set.h"
#include "base/system/instruction_sets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/math/byte_rows.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ombre::HWY_NAMESPACE {
namespace {

// The `..._in_front` functions process whole vectors from the front and advance `i`. Their callers process the
// remaining bytes one at a time, or all bytes if there are no vectors.
#if HWY_TARGET != HWY_SCALAR
namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<uint8_t>;
using V = hn::Vec<D>;

// Counts the positions where `is_counted` is true. `is_counted(at)` returns the mask of the lanes that start at `at`.
template <class IsCounted>
size_t count_in_front(size_t count, size_t& i, const IsCounted& is_counted) {
  constexpr size_t most_blocks = 255;  // a lane would overflow after more blocks
  const D d;
  const hn::Repartition<uint64_t, D> d64;
  const size_t lanes = hn::Lanes(d);
  size_t total = 0;
  while (count - i >= lanes) {
    V sums = hn::Zero(d);
    const size_t end = i + lanes * std::min(most_blocks, (count - i) / lanes);
    for (; i < end; i += lanes) sums = hn::Sub(sums, hn::VecFromMask(d, is_counted(i)));
    total += hn::GetLane(hn::SumOfLanes(d64, hn::SumsOf8(sums)));
  }
  return total;
}

size_t count_equal_in_front(const uint8_t* bytes, size_t count, uint8_t value, size_t& i) {
  const D d;
  const V wanted = hn::Set(d, value);
  return count_in_front(count, i, [&](size_t at) { return hn::Eq(hn::LoadU(d, bytes + at), wanted); });
}

size_t count_repeats_in_front(const uint8_t* bytes, size_t count, size_t& i) {
  const D d;
  return count_in_front(count, i,
                        [&](size_t at) { return hn::Eq(hn::LoadU(d, bytes + at), hn::LoadU(d, bytes + at + 1)); });
}

// A lookup table for values that all differ in their low four bits: each value and its number, indexed by these bits.
struct ByLowBits {
  HWY_ALIGN std::array<uint8_t, 16> values{}, numbers{};
  bool is_made = true;

  ByLowBits(const uint8_t* given, size_t count) {
    // Fills unused entries with a value whose low bits differ from the index, so that no byte matches them.
    for (size_t low = 0; low < values.size(); ++low) values[low] = static_cast<uint8_t>(~low);
    for (size_t n = 0; n < count && is_made; ++n) {
      const size_t low = given[n] % values.size();
      is_made = values[low] % values.size() != low;
      values[low] = given[n];
      numbers[low] = static_cast<uint8_t>(n);
    }
  }
};

V low_bits(V bytes) { return hn::And(bytes, hn::Set(D(), 15)); }

// Returns true if a byte in the whole vectors is not among `values`; false if all of them are.
bool others_in_front(const uint8_t* bytes, size_t count, const uint8_t* values, size_t value_count, size_t& i) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  if (count < lanes) return false;
  if (const ByLowBits table(values, value_count); table.is_made) {
    const V known = hn::LoadDup128(d, table.values.data());
    for (; i + lanes <= count; i += lanes) {
      const V at = hn::LoadU(d, bytes + i);
      if (!hn::AllTrue(d, hn::Eq(hn::TableLookupBytes(known, low_bits(at)), at))) return true;
    }
    return false;
  }
  for (; i + lanes <= count; i += lanes) {
    const V at = hn::LoadU(d, bytes + i);
    auto known = hn::Ne(at, at);  // an empty mask
    for (size_t n = 0; n < value_count; ++n) known = hn::Or(known, hn::Eq(at, hn::Set(d, values[n])));
    if (!hn::AllTrue(d, known)) return true;
  }
  return false;
}

// Returns true and sets `i` to the first byte that is not `value`; returns false if the whole vectors hold only
// `value`.
bool equal_in_front(const uint8_t* bytes, size_t count, uint8_t value, size_t& i) {
  const D d;
  const V wanted = hn::Set(d, value);
  const size_t lanes = hn::Lanes(d);
  for (; i + lanes <= count; i += lanes) {
    const intptr_t other = hn::FindFirstTrue(d, hn::Ne(hn::LoadU(d, bytes + i), wanted));
    if (other < 0) continue;
    i += static_cast<size_t>(other);
    return true;
  }
  return false;
}

// Moves `i` to 16 bytes that each equal the byte after them. Returns false if the whole vectors have none.
bool find_sixteen_in_front(const uint8_t* bytes, size_t count, size_t& i) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  for (; i + lanes + 1 <= count; i += lanes) {
    uint64_t bits = 0;
    hn::StoreMaskBits(d, hn::Eq(hn::LoadU(d, bytes + i), hn::LoadU(d, bytes + i + 1)),
                      reinterpret_cast<uint8_t*>(&bits));
    for (unsigned shift = 1; shift <= 8; shift *= 2) bits &= bits >> shift;
    bits &= 0x0001000100010001;
    if (bits == 0) continue;
    i += static_cast<size_t>(std::countr_zero(bits));
    return true;
  }
  return false;
}

void pack_front(const uint8_t* bytes, const DoubleBits& bits, uint8_t* packed, size_t count, size_t& i) {
  const D d;
  const hn::Repartition<uint32_t, D> d32;
  const hn::Rebind<uint8_t, decltype(d32)> d_packed;
  const size_t lanes = hn::Lanes(d32);
  // Multiplication by this factor gathers the low two bits of four bytes in the highest byte. No two products share a
  // bit.
  constexpr uint32_t factor = 0x40100401;
  const V from0 = hn::Set(d, bits.from[0]), from1 = hn::Set(d, bits.from[1]), from2 = hn::Set(d, bits.from[2]);
  const V to0 = hn::Set(d, bits.to[0]), to1 = hn::Set(d, bits.to[1]), to2 = hn::Set(d, bits.to[2]);
  for (; i + lanes <= count; i += lanes) {
    const V from = hn::LoadU(d, bytes + 4 * i);
    const V to =
        hn::Or(hn::Or(hn::IfThenElseZero(hn::Eq(from, from0), to0), hn::IfThenElseZero(hn::Eq(from, from1), to1)),
               hn::IfThenElseZero(hn::Eq(from, from2), to2));
    const auto gathered = hn::ShiftRight<24>(hn::Mul(hn::BitCast(d32, to), hn::Set(d32, factor)));
    hn::StoreU(hn::TruncateTo(d_packed, gathered), d_packed, packed + i);
  }
}

void number_front(const uint8_t* bytes, size_t count, const uint8_t* values, size_t value_count, uint8_t* numbers,
                  size_t& i) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  if (const ByLowBits table(values, value_count); table.is_made) {
    const V known = hn::LoadDup128(d, table.numbers.data());
    for (; i + lanes <= count; i += lanes)
      hn::StoreU(hn::TableLookupBytes(known, low_bits(hn::LoadU(d, bytes + i))), d, numbers + i);
    return;
  }
  for (; i + lanes <= count; i += lanes) {
    const V from = hn::LoadU(d, bytes + i);
    V to = hn::Zero(d);
    for (size_t n = 1; n < value_count; ++n)
      to = hn::IfThenElse(hn::Eq(from, hn::Set(d, values[n])), hn::Set(d, static_cast<uint8_t>(n)), to);
    hn::StoreU(to, d, numbers + i);
  }
}

void look_up_front(const uint8_t* numbers, size_t count, const FourBytes* table, uint8_t* bytes, size_t& i) {
  const D d;
  HWY_ALIGN uint8_t planes[4][16];
  for (size_t n = 0; n < 16; ++n)
    for (size_t k = 0; k < 4; ++k) planes[k][n] = table[n][k];
  const V table0 = hn::LoadDup128(d, planes[0]), table1 = hn::LoadDup128(d, planes[1]);
  const V table2 = hn::LoadDup128(d, planes[2]), table3 = hn::LoadDup128(d, planes[3]);
  const size_t lanes = hn::Lanes(d);
  for (; i + lanes <= count; i += lanes) {
    const V at = hn::LoadU(d, numbers + i);
    hn::StoreInterleaved4(hn::TableLookupBytes(table0, at), hn::TableLookupBytes(table1, at),
                          hn::TableLookupBytes(table2, at), hn::TableLookupBytes(table3, at), d, bytes + 4 * i);
  }
}
#endif

size_t count_equal(const uint8_t* bytes, size_t count, uint8_t value) {
  size_t total = 0, i = 0;
#if HWY_TARGET != HWY_SCALAR
  total = count_equal_in_front(bytes, count, value, i);
#endif
  for (; i < count; ++i) total += bytes[i] == value;
  return total;
}

size_t count_repeats(const uint8_t* bytes, size_t count) {
  size_t total = 0, i = 0;
#if HWY_TARGET != HWY_SCALAR
  total = count_repeats_in_front(bytes, count, i);
#endif
  for (; i < count; ++i) total += bytes[i] == bytes[i + 1];
  return total;
}

bool are_among(const uint8_t* bytes, size_t count, const uint8_t* values, size_t value_count) {
  size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  if (others_in_front(bytes, count, values, value_count, i)) return false;
#endif
  const uint8_t* const end = values + value_count;
  return std::all_of(bytes + i, bytes + count, [&](uint8_t byte) { return std::find(values, end, byte) != end; });
}

size_t equal_at_begin(const uint8_t* bytes, size_t count) {
  size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  if (equal_in_front(bytes, count, bytes[0], i)) return i;
#endif
  while (i < count && bytes[i] == bytes[0]) ++i;
  return i;
}

size_t find_sixteen_equal(const uint8_t* bytes, size_t count) {
  size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  if (find_sixteen_in_front(bytes, count, i)) return i;
#endif
  for (; i + 16 <= count; i += 16)
    if (std::memcmp(bytes + i, bytes + i + 1, 15) == 0) return i;
  return i;
}

void pack_double_bits(const uint8_t* bytes, const DoubleBits& bits, uint8_t* packed, size_t count) {
  size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  pack_front(bytes, bits, packed, count, i);
#endif
  for (; i < count; ++i) {
    unsigned byte = 0;
    for (size_t k = 0; k < 4; ++k) {
      unsigned two = 0;
      for (size_t n = 0; n < bits.from.size(); ++n)
        if (bytes[4 * i + k] == bits.from[n]) two |= bits.to[n];
      byte = byte << 2 | two;
    }
    packed[i] = static_cast<uint8_t>(byte);
  }
}

void number_bytes(const uint8_t* bytes, size_t count, const uint8_t* values, size_t value_count, uint8_t* numbers) {
  size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  number_front(bytes, count, values, value_count, numbers, i);
#endif
  for (; i < count; ++i) numbers[i] = static_cast<uint8_t>(std::find(values, values + value_count, bytes[i]) - values);
}

void look_up_four_bytes(const uint8_t* numbers, size_t count, const FourBytes* table, uint8_t* bytes) {
  size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  look_up_front(numbers, count, table, bytes, i);
#endif
  for (; i < count; ++i) std::memcpy(bytes + 4 * i, &table[numbers[i]], sizeof(FourBytes));
}

}  // namespace

ByteRowSet byte_rows_here() {
  return {count_equal,        count_repeats,    are_among,    equal_at_begin,
          find_sixteen_equal, pack_double_bits, number_bytes, look_up_four_bytes};
}

}  // namespace ombre::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ombre {

namespace {

const std::vector<ByteRowSet>& sets() {
  static const auto found = sets_for_processor<ByteRowSet>(
      {
#if HWY_ARCH_X86
        {&InstructionSets::avx512, N_AVX3::byte_rows_here}, {&InstructionSets::avx2, N_AVX2::byte_rows_here},
            {&InstructionSets::sse4, N_SSE4::byte_rows_here},
#endif
      },
      HWY_STATIC_DISPATCH(byte_rows_here));
  return found;
}

ByteRowSet& rows() {
  static ByteRowSet in_use = sets().front();
  return in_use;
}

}  // namespace

size_t byte_row_set_count() { return sets().size(); }

void use_byte_row_set(size_t set) { rows() = sets().at(set); }

size_t count_equal(std::span<const uint8_t> bytes, uint8_t value) {
  return rows().count_equal(bytes.data(), bytes.size(), value);
}

size_t count_repeats(std::span<const uint8_t> bytes) {
  return bytes.empty() ? 0 : rows().count_repeats(bytes.data(), bytes.size() - 1);
}

bool are_among(std::span<const uint8_t> bytes, std::span<const uint8_t> values) {
  return rows().are_among(bytes.data(), bytes.size(), values.data(), values.size());
}

size_t equal_at_begin(std::span<const uint8_t> bytes) { return rows().equal_at_begin(bytes.data(), bytes.size()); }

size_t find_sixteen_equal(std::span<const uint8_t> bytes) {
  return rows().find_sixteen_equal(bytes.data(), bytes.size());
}

void pack_double_bits(const uint8_t* bytes, const DoubleBits& bits, std::span<uint8_t> packed) {
  rows().pack_double_bits(bytes, bits, packed.data(), packed.size());
}

void number_bytes(std::span<const uint8_t> bytes, std::span<const uint8_t> values, uint8_t* numbers) {
  rows().number_bytes(bytes.data(), bytes.size(), values.data(), values.size(), numbers);
}

void look_up_four_bytes(std::span<const uint8_t> numbers, const std::array<FourBytes, 16>& table, uint8_t* bytes) {
  rows().look_up_four_bytes(numbers.data(), numbers.size(), table.data(), bytes);
}

}  // namespace ombre
#endif
