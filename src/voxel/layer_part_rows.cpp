#include "voxel/layer_part_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/system/assert.h"
#include "program/evaluate.h"

namespace ombre::voxel {

using program::Instruction;
using program::Op;
using program::PartTable;
using program::SlotKind;
using program::ValueId;

namespace {

// Size of the boxes that are evaluated at once: large enough to make starting an op cheap, small enough for the
// first-level cache.
constexpr int64_t most_points = 512, most_layers = 16;
// Smaller boxes are evaluated without first checking by intervals whether the part is there.
constexpr int64_t least_voxels_of_query = 2048;
constexpr size_t most_bodies = 64;

size_t padded_width(const TileBox& box) { return eval::padded(static_cast<size_t>(box.size(0))); }

class NoSources : public eval::SourceRows {
 public:
  bool has(const program::Read&) const override { return false; }
  void fill(const program::Read&, const eval::RowsToFill&) const override {}
};
const NoSources no_sources;

}  // namespace

PartBody::PartBody(const program::PartSet& set, uint32_t body, const std::vector<size_t>& slots,
                   const eval::KernelSet& kernels)
    : program_(set.batch.body(body).code), batch_(kernels) {
  const PartTable& table = set.batch;
  const std::vector<int>& outputs = table.body(body).slots;
  const std::vector<ValueId> ids = std::move(program_.outputs);
  const auto id_of = [&](size_t slot) { return ids[static_cast<size_t>(outputs[slot])]; };
  program_.outputs = {id_of(0), id_of(set.held_slot)};
  for (const size_t slot : slots) {
    const bool has = slot < outputs.size() && outputs[slot] >= 0;
    output_.push_back(has ? program_.outputs.size() : none);
    if (has) program_.outputs.push_back(id_of(slot));
  }
  for (ValueId id = 0; id < program_.code.size(); ++id)
    if (program_.code[id].op == Op::constant) constants_.push_back(id);
  const bool may_be_unknown = table.body(body).may_be_unknown;
  const std::vector<Interval> ranges(program_.code.size(), may_be_unknown ? Interval::everything() : Interval(0));
  batch_.compile(program_, ranges, most_points, most_layers, no_sources);
}

void PartBody::take(const PartTable& table, uint32_t part) {
  for (size_t n = 0; n < constants_.size(); ++n) {
    const double value = table.parameter(part, n);
    program_.code[constants_[n]].value = value;
    batch_.set_constant(constants_[n], static_cast<float>(value));
  }
}

PartRows::PartRows(const VoxelJob& job, const eval::KernelSet& kernels)
    : job_(job), batch_kernels_(kernels), kernels_(row_kernels(kernels.name)) {
  const program::Program& program = job.selector.batch;
  for (const Instruction& in : program.code) {
    if (in.op != Op::parts) continue;
    const program::PartSet* parts = program.part_sets[in.aux].get();
    const auto known = std::find_if(sets_.begin(), sets_.end(), [&](const Set& set) { return set.parts == parts; });
    Set& set = known == sets_.end() ? sets_.emplace_back() : *known;
    set.parts = parts;
    const auto slot = static_cast<size_t>(in.value);
    if (std::find(set.slots.begin(), set.slots.end(), slot) != set.slots.end()) continue;
    set.numbers.resize(std::max(set.numbers.size(), slot + 1));
    set.numbers[slot] = set.slots.size();
    set.slots.push_back(slot);
  }
}

bool PartRows::suits(const program::Program& program) {
  const auto is_input = [&](ValueId id, int axis) {
    return program.code[id].op == Op::input && program.code[id].value == axis;
  };
  for (const Instruction& in : program.code)
    if (in.op == Op::parts && !(is_input(in.a, 0) && is_input(in.b, 1) && is_input(in.c, 2))) return false;
  return true;
}

void PartRows::begin(const program::Program& program, const TileBox& tile, const TilePoints& points) {
  tile_ = tile;
  points_ = &points;
  stride_ = padded_width(tile);
  ASSERT(stride_ / eval::batch_lanes <= 64);
  touched_.assign(static_cast<size_t>(tile.size(1) * tile.size(2)), 0);
  place_sets(program);
  const Box region = centers(job_.lattice, tile);
  for (Set* set : read_) {
    set->parts->index.find(region, found_);
    // Later parts overwrite earlier ones.
    if (set->parts->is_backwards()) std::reverse(found_.begin(), found_.end());
    for (const auto& entry : found_) {
      const TileBox box = voxels_in(entry.box);
      if (box.voxels() > 0) add_part(*set, entry.part, box);
    }
  }
}

// Assigns a plane of values to each slot that the program reads.
void PartRows::place_sets(const program::Program& program) {
  read_.clear();
  by_number_.clear();
  plane_count_ = 0;
  for (const auto& parts : program.part_sets) {
    const auto found = std::find_if(sets_.begin(), sets_.end(), [&](const Set& s) { return s.parts == parts.get(); });
    ASSERT(found != sets_.end() && "programs of tiles come from the job's");
    by_number_.push_back(&*found);
    if (std::find(read_.begin(), read_.end(), &*found) != read_.end()) continue;
    read_.push_back(&*found);
    found->first_plane = plane_count_;
    plane_count_ += found->slots.size();
  }
  const size_t floats = plane_count_ * plane_floats() + eval::batch_lanes;
  if (values_.size() < floats) values_.resize(floats);
}

void PartRows::touch_all() {
  const auto blocks = static_cast<unsigned>(stride_ / eval::batch_lanes);
  const uint64_t all = ~uint64_t{0} >> (64 - blocks);
  for (size_t row = 0; row < touched_.size(); ++row) touch(row, all);
}

// Returns the tile's voxels with centres in [lo, hi), so that adjacent boxes of a part share no voxels.
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
    voxels.hi[axis] = std::max(voxels.lo[axis], std::min(voxels.hi[axis], first(box.hi[a])));
  }
  return voxels;
}

void PartRows::add_part(Set& set, uint32_t part, const TileBox& box) {
  const PartTable& table = set.parts->batch;
  const uint32_t number = table.body_of(part);
  set.bodies.resize(std::min(table.body_count(), most_bodies));
  KeptBody& kept = set.bodies[number % most_bodies];
  if (!kept.body || kept.number != number)
    kept = {number, std::make_unique<PartBody>(*set.parts, number, set.slots, batch_kernels_)};
  kept.body->take(table, part);
  descend(set, *kept.body, box, true);
}

// Halves boxes until they are small, and drops those in which intervals show that the part is absent.
void PartRows::descend(const Set& set, PartBody& body, const TileBox& box, bool ask) {
  if (ask && box.voxels() >= least_voxels_of_query) {
    evaluate_intervals(body.program(), centers(job_.lattice, box), ranges_, nullptr, program::Precision::batch);
    const Interval reached = ranges_[body.program().outputs[0]];
    if (reached == Interval(0)) return;
    ask = reached != Interval(1);
  }
  const int64_t width = static_cast<int64_t>(padded_width(box)), height = box.size(1), depth = box.size(2);
  if (width * height <= most_points && depth <= most_layers) return evaluate(set, body, box);
  const size_t axis = depth > most_layers && depth >= std::max(width, height) ? 2 : width > 2 * height ? 0 : 1;
  TileBox low = box, high = box;
  low.hi[axis] = high.lo[axis] = (box.lo[axis] + box.hi[axis]) / 2;
  descend(set, body, low, ask);
  descend(set, body, high, ask);
}

void PartRows::evaluate(const Set& set, PartBody& body, const TileBox& box) {
  const auto width = static_cast<size_t>(box.size(0));
  rows_.clear();
  for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) rows_.push_back(points_->row({box.lo[0], j}));
  eval::BatchEvaluator& batch = body.batch();
  batch.place({rows_, points_->layers(box.lo[2], box.hi[2]), width});
  const size_t row_floats = padded_width(box);
  for (int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
    batch.begin_layer(static_cast<size_t>(k - box.lo[2]));
    batch.begin_row(0);
    if (!kernels_.any(batch.output(0), row_floats * rows_.size())) continue;
    batch.finish_row();
    for (size_t row = 0; row < rows_.size(); ++row)
      merge_row(set, body, row * row_floats, {box.lo[0], box.lo[1] + static_cast<int64_t>(row)}, k, width);
  }
}

void PartRows::merge_row(const Set& set, const PartBody& body, size_t lane, RowPlace at, int64_t k, size_t width) {
  const RowSpan span = kernels_.nonzero(body.reached().from(lane), width);
  if (span.begin == span.end) return;
  const auto first = static_cast<size_t>(at.i - tile_.lo[0]) + span.begin, last = first + (span.end - span.begin) - 1;
  const uint64_t up_to_last = ~uint64_t{0} >> (63 - last / eval::batch_lanes);
  touch(row_number(at.j, k), up_to_last & ~uint64_t{0} << (first / eval::batch_lanes));

  static constexpr float zero = 0;
  const eval::Values held = body.held().from(lane + span.begin);
  const size_t count = span.end - span.begin;
  for (size_t n = 0; n < set.slots.size(); ++n) {
    float* slot = values_.data() + offset(set.first_plane + n, at.i + static_cast<int64_t>(span.begin), at.j, k);
    const bool has = body.has(n);
    const eval::Values values = has ? body.output(n).from(lane + span.begin) : eval::Values{&zero, true};
    switch (set.parts->slots[set.slots[n]]) {
      case SlotKind::any:
        if (has) kernels_.merge_any(values, slot, count);
        break;
      case SlotKind::sum:
        if (has) kernels_.merge_sum(values, slot, count);
        break;
      case SlotKind::first:
      case SlotKind::last:
        kernels_.merge_where(held, values, slot, count);
        break;
    }
  }
}

// Sets blocks to zero when they are first touched.
void PartRows::touch(size_t row, uint64_t blocks) {
  uint64_t fresh = blocks & ~touched_[row];
  touched_[row] |= blocks;
  for (; fresh != 0; fresh &= fresh - 1) {
    const size_t first = row * stride_ + static_cast<size_t>(std::countr_zero(fresh)) * eval::batch_lanes;
    for (size_t plane = 0; plane < plane_count_; ++plane)
      std::fill_n(values_.data() + plane * plane_floats() + first, eval::batch_lanes, 0.0F);
  }
}

}  // namespace ombre::voxel
