#include "voxel/part_rows.h"

#include <cmath>

#include "base/assert.h"

namespace ombre::voxel {

using program::Instruction;
using program::Op;
using program::PartTable;
using program::SlotKind;
using program::ValueId;

namespace {

class NoSources : public eval::SourceRows {
 public:
  bool has(const program::Read&) const override { return false; }
  void fill(const program::Read&, size_t, size_t, std::span<float>) const override {}
};

}  // namespace

bool PartRows::suits(const program::Program& program) {
  const auto is_input = [&](ValueId id, int axis) {
    return program.code[id].op == Op::input && program.code[id].value == axis;
  };
  for (const Instruction& in : program.code)
    if (in.op == Op::parts && !(is_input(in.a, 0) && is_input(in.b, 1) && is_input(in.c, 2))) return false;
  return true;
}

void PartRows::begin(const program::Program& program, const TileBox& tile) {
  tile_ = tile;
  stride_ = (static_cast<size_t>(tile.size(0)) + eval::batch_lanes - 1) / eval::batch_lanes * eval::batch_lanes;
  first_set_.clear();
  for (const auto& set : program.part_sets) {
    const auto known = std::find(program.part_sets.begin(), program.part_sets.end(), set);
    first_set_.push_back(static_cast<uint32_t>(known - program.part_sets.begin()));
  }
  size_t used = 0;
  for (const Instruction& in : program.code) {
    if (in.op != Op::parts) continue;
    if (slots_.size() == used) slots_.emplace_back();
    SlotRows& rows = slots_[used++];
    rows.set = first_set_[in.aux];
    rows.slot = static_cast<size_t>(in.value);
    rows.values.assign(stride_ * static_cast<size_t>(tile.size(1) * tile.size(2)), 0.0F);
  }
  slots_.resize(used);

  const Box region = centers(job_.lattice, tile);
  for (uint32_t n = 0; n < program.part_sets.size(); ++n) {
    if (first_set_[n] != n) continue;
    const program::PartSet& set = *program.part_sets[n];
    wanted_.clear();
    for (SlotRows& rows : slots_)
      if (rows.set == n) wanted_.push_back(&rows);
    set.index.find(region, found_);
    // What is set first stands: the first part comes last.
    if (set.slots.back() == SlotKind::first) std::reverse(found_.begin(), found_.end());
    for (const auto& entry : found_) {
      const TileBox box = voxels_in(entry.box);
      if (box.size(0) > 0 && box.size(1) > 0 && box.size(2) > 0) add_part(set, entry.part, box);
    }
  }
}

const float* PartRows::row(uint32_t set, size_t slot, size_t j, size_t k) const {
  for (const SlotRows& rows : slots_)
    if (rows.set == first_set_[set] && rows.slot == slot)
      return rows.values.data() + (k * static_cast<size_t>(tile_.size(1)) + j) * stride_;
  ASSERT(false && "the program's slots are known");
  return nullptr;
}

float* PartRows::at(SlotRows& rows, int64_t i, int64_t j, int64_t k) const {
  const int64_t row = (k - tile_.lo[2]) * tile_.size(1) + (j - tile_.lo[1]);
  return rows.values.data() + static_cast<size_t>(row) * stride_ + (i - tile_.lo[0]);
}

// The tile's voxels with centres in [lo, hi): boxes of one part that share a face share no voxel.
TileBox PartRows::voxels_in(const Box& box) const {
  TileBox voxels = tile_;
  for (size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    const double pitch = job_.lattice.pitch[axis].mm();
    const auto first = [&](double mm) {
      const double index = std::ceil((mm - job_.lattice.origin[a]) / pitch - 0.5);
      return static_cast<int64_t>(std::clamp(index, -1e15, 1e15));
    };
    voxels.lo[axis] = std::max(voxels.lo[axis], first(box.lo[a]));
    voxels.hi[axis] = std::min(voxels.hi[axis], first(box.hi[a]));
  }
  return voxels;
}

void PartRows::add_part(const program::PartSet& set, uint32_t part, const TileBox& box) {
  body_.code.clear();
  body_.outputs.clear();
  for (int axis = 0; axis < 3; ++axis) {
    Instruction in;
    in.op = Op::input;
    in.value = axis;
    body_.code.push_back(in);
  }
  set.batch.append(part, body_, {0, 1, 2}, body_slots_);
  body_.outputs.push_back(body_slots_[0]);
  body_output_.clear();
  for (const SlotRows* rows : wanted_) {
    const bool has = rows->slot < body_slots_.size() && body_slots_[rows->slot] != PartTable::none;
    body_output_.push_back(has ? body_.outputs.size() : 0);
    if (has) body_.outputs.push_back(body_slots_[rows->slot]);
  }
  descend(set, box);
}

// Halves boxes until the part fills a good share of what is left.
void PartRows::descend(const program::PartSet& set, const TileBox& box) {
  constexpr int64_t widest = 32, highest = 12;
  evaluate_intervals(body_, centers(job_.lattice, box), ranges_, nullptr, program::Precision::batch);
  const Interval inside = ranges_[body_.outputs[0]];
  if (inside == Interval(0)) return;
  const bool is_small = box.size(0) <= widest && box.size(1) <= highest;
  if (is_small || inside == Interval(1)) return evaluate(set, box);
  const size_t axis = box.size(0) * highest > box.size(1) * widest ? 0 : 1;
  TileBox low = box, high = box;
  low.hi[axis] = high.lo[axis] = (box.lo[axis] + box.hi[axis]) / 2;
  descend(set, low);
  descend(set, high);
}

void PartRows::evaluate(const program::PartSet& set, const TileBox& box) {
  points_.place(job_.lattice, box);
  const NoSources none;
  points_.evaluate(batch_, kernels_, body_, ranges_, none, [&](int64_t k) {
    for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) merge_row(set, box, j, box.lo[2] + k);
  });
}

void PartRows::merge_row(const program::PartSet& set, const TileBox& box, int64_t j, int64_t k) {
  static constexpr float zero = 0;
  const auto row = static_cast<size_t>(j - box.lo[1]);
  const auto width = static_cast<size_t>(box.size(0));
  const eval::Values inside = points_.row(batch_.output(0), row);
  for (size_t n = 0; n < wanted_.size(); ++n) {
    float* slot = at(*wanted_[n], box.lo[0], j, k);
    const bool has = body_output_[n] > 0;
    const eval::Values values = has ? points_.row(batch_.output(body_output_[n]), row) : eval::Values{&zero, true};
    switch (set.slots[wanted_[n]->slot]) {
      case SlotKind::any:
        if (has) kernels_.merge_any(values, slot, width);
        break;
      case SlotKind::sum:
        if (has) kernels_.merge_sum(values, slot, width);
        break;
      case SlotKind::first:
      case SlotKind::last:
        kernels_.merge_where(inside, values, slot, width);
        break;
    }
  }
}

}  // namespace ombre::voxel
