#include "voxel/row_kernels.h"

#include <algorithm>
#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "voxel/row_kernels.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ombre::voxel {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DU = hn::RebindToUnsigned<D>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VU = hn::Vec<DU>;

// Vectorised version of scramble() in quantise.h.
HWY_INLINE VU scramble(VU h) {
  const DU d;
  h = hn::Xor(h, hn::ShiftRight<16>(h));
  h = hn::Mul(h, hn::Set(d, 0x7FEB352Du));
  h = hn::Xor(h, hn::ShiftRight<15>(h));
  h = hn::Mul(h, hn::Set(d, 0x846CA68Bu));
  return hn::Xor(h, hn::ShiftRight<16>(h));
}

struct HashDraws {
  explicit HashDraws(const ChoiceRow& row)
      : next(hn::Add(hn::Set(DU(), row.draws.hash),
                     hn::Mul(hn::Iota(DU(), static_cast<uint32_t>(row.i_begin)), hn::Set(DU(), 0xC2B2AE35u)))),
        step(hn::Set(DU(), 0xC2B2AE35u * static_cast<uint32_t>(hn::Lanes(DU())))) {}
  HWY_INLINE VU take(size_t) {
    const VU draw = hn::ShiftRight<8>(scramble(next));
    next = hn::Add(next, step);
    return draw;
  }
  VU next, step;
};

struct TableDraws {
  static constexpr size_t period = 64;
  // Rotates the table so that it begins with the row's first voxel.
  explicit TableDraws(const ChoiceRow& row) {
    const size_t first = (static_cast<uint32_t>(row.i_begin) + row.draws.offset) % period;
    std::memcpy(table, row.draws.table + first, (period - first) * sizeof *table);
    std::memcpy(table + period - first, row.draws.table, first * sizeof *table);
  }
  HWY_INLINE VU take(size_t n) const { return hn::Load(DU(), table + n % period); }
  HWY_ALIGN uint32_t table[period];
};

HWY_INLINE V values_at(const eval::Values& values, size_t n) {
  return values.is_number ? hn::Set(D(), *values.row) : hn::Load(D(), values.row + n);
}

// Returns the materials of one vector of voxels, one number per lane.
template <class Source>
HWY_INLINE VU chosen(const ChoiceRow& row, Source& draws, size_t n) {
  VU id = hn::Set(DU(), row.materials[0]);
  if (!row.thresholds.empty()) {
    const V u = hn::Mul(hn::ConvertTo(D(), hn::BitCast(DI(), draws.take(n))), hn::Set(D(), 0x1p-24f));
    for (size_t t = 0; t < row.thresholds.size(); ++t) {
      const auto beyond = hn::Ge(u, values_at(row.thresholds[t], n));
      id = hn::IfThenElse(hn::RebindMask(DU(), beyond), hn::Set(DU(), row.materials[t + 1]), id);
    }
  }
  if (row.inside.is_number) return id;
  // A comparison with NaN is false, so NaN counts as outside.
  const auto inside = hn::Gt(hn::Abs(hn::Load(D(), row.inside.row + n)), hn::Zero(D()));
  return hn::IfThenElseZero(hn::RebindMask(DU(), inside), id);
}

HWY_INLINE void store(VU ids, MaterialId* out) {
  const hn::Rebind<uint8_t, DU> bytes;
  hn::StoreU(hn::U8FromU32(ids), bytes, out);
}

template <class Source>
void choose_with(const ChoiceRow& row, MaterialId* voxels) {
  Source draws(row);
  const size_t lanes = hn::Lanes(DU());
  size_t n = 0;
  for (; n + lanes <= row.count; n += lanes) store(chosen(row, draws, n), voxels + n);
  if (n == row.count) return;
  MaterialId rest[64];
  store(chosen(row, draws, n), rest);
  std::memcpy(voxels + n, rest, row.count - n);
}

void choose(const ChoiceRow& row, MaterialId* voxels) {
  if (row.inside.is_number && !(*row.inside.row != 0)) {
    std::memset(voxels, 0, row.count);
  } else if (row.inside.is_number && row.thresholds.empty()) {
    std::memset(voxels, row.materials[0], row.count);
  } else if (row.draws.table) {
    choose_with<TableDraws>(row, voxels);
  } else {
    choose_with<HashDraws>(row, voxels);
  }
}

bool any(const eval::Values& all, size_t count) {
  if (all.is_number) return *all.row != 0;
  const float* values = all.row;
  size_t n = 0;
  const size_t lanes = hn::Lanes(D());
  for (; n + lanes <= count; n += lanes)
    if (!hn::AllTrue(D(), hn::Eq(hn::Load(D(), values + n), hn::Zero(D())))) return true;
  for (; n < count; ++n)
    if (values[n] != 0) return true;
  return false;
}

bool unknown(const eval::Values& inside, const eval::Values& values, size_t count) {
  const auto found = [&](size_t n) {
    const V holds = values_at(inside, n);
    const auto matters = hn::Not(hn::Eq(holds, hn::Zero(D())));
    return hn::Or(hn::IsNaN(holds), hn::And(matters, hn::IsNaN(values_at(values, n))));
  };
  const size_t lanes = hn::Lanes(D());
  size_t n = 0;
  for (; n + lanes <= count; n += lanes)
    if (!hn::AllFalse(D(), found(n))) return true;
  return n < count && !hn::AllFalse(D(), hn::And(found(n), hn::FirstN(D(), count - n)));
}

RowSpan nonzero(const eval::Values& all, size_t count) {
  if (all.is_number) return {0, *all.row != 0 ? count : 0};
  const float* values = all.row;
  RowSpan span{count, 0};
  for (size_t n = 0; n < count; n += hn::Lanes(D())) {
    const auto is = hn::And(hn::Not(hn::Eq(hn::Load(D(), values + n), hn::Zero(D()))), hn::FirstN(D(), count - n));
    if (hn::AllFalse(D(), is)) continue;
    HWY_ALIGN uint8_t bits[8] = {};
    hn::StoreMaskBits(D(), is, bits);
    uint64_t set = 0;
    std::memcpy(&set, bits, sizeof set);
    span.begin = std::min(span.begin, n + static_cast<size_t>(std::countr_zero(set)));
    span.end = n + static_cast<size_t>(std::bit_width(set));
  }
  return span.end == 0 ? RowSpan{} : span;
}

HWY_INLINE V anywhere(const eval::Values& values, size_t n) {
  return values.is_number ? hn::Set(D(), *values.row) : hn::LoadU(D(), values.row + n);
}

template <class Merge>
void merge(float* slot, size_t count, Merge merged) {
  const D d;
  for (size_t n = 0; n < count; n += hn::Lanes(d)) {
    const V values = merged(hn::LoadU(d, slot + n), n);
    if (n + hn::Lanes(d) <= count)
      hn::StoreU(values, d, slot + n);
    else
      hn::BlendedStore(values, hn::FirstN(d, count - n), d, slot + n);
  }
}

// Combines truth values by `or`. The result is NaN if neither is 1 and one is NaN.
void merge_any(const eval::Values& values, float* slot, size_t count) {
  const V one = hn::Set(D(), 1.0F);
  merge(slot, count, [&](V old, size_t n) {
    const V value = anywhere(values, n);
    return hn::IfThenElse(hn::Or(hn::Eq(old, one), hn::Eq(value, one)), one, hn::Add(old, value));
  });
}

void merge_sum(const eval::Values& values, float* slot, size_t count) {
  merge(slot, count, [&](V old, size_t n) { return hn::Add(old, anywhere(values, n)); });
}

void merge_where(const eval::Values& condition, const eval::Values& values, float* slot, size_t count) {
  merge(slot, count, [&](V old, size_t n) {
    const V holds = anywhere(condition, n);
    const V chosen = hn::IfThenElse(hn::Eq(holds, hn::Zero(D())), old, anywhere(values, n));
    return hn::IfThenElse(hn::IsNaN(holds), holds, chosen);
  });
}

}  // namespace
RowKernels row_kernels_here() { return {choose, any, unknown, nonzero, merge_any, merge_sum, merge_where}; }
}  // namespace HWY_NAMESPACE
}  // namespace ombre::voxel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ombre::voxel {

RowKernels row_kernels([[maybe_unused]] std::string_view instruction_set) {
#if HWY_ARCH_X86
  if (instruction_set == "avx512") return N_AVX3::row_kernels_here();
  if (instruction_set == "avx2") return N_AVX2::row_kernels_here();
#endif
  return HWY_STATIC_DISPATCH(row_kernels_here)();
}

}  // namespace ombre::voxel
#endif
