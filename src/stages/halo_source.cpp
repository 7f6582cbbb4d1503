#include "stages/halo_source.h"

#include <algorithm>

#include "base/text/error.h"
#include "voxel/tile.h"

namespace ombre::compile {
namespace {

using design::StageValues;

// Least and greatest size of a block. A slice job goes through slabs of 8 layers in strips of 64 rows, and needs each
// block of the least size once.
constexpr std::array<int64_t, 3> least_block{64, 64, 8}, greatest_block{512, 512, 64};
// Limits for a range over several blocks. Beyond them it comes from the ranges of the blocks, or from the stage's
// declaration, so that no blocks need to be computed for it.
constexpr int64_t most_blocks_read = 4, most_blocks_queried = 64;

// Chooses the size of blocks so that the cells around a block are not many more than its own.
std::array<int64_t, 3> block_size(const design::HaloStage::Reach& reach) {
  std::array<int64_t, 3> block = least_block;
  for (size_t axis = 0; axis < 3; ++axis)
    while (block[axis] < reach.below[axis] + reach.above[axis] && block[axis] < greatest_block[axis]) block[axis] *= 2;
  return block;
}

CellIndex number_of(const CellIndex& cell, const std::array<int64_t, 3>& block) {
  CellIndex number;
  for (size_t axis = 0; axis < 3; ++axis) number[axis] = voxel::multiple_below(cell[axis], block[axis]) / block[axis];
  return number;
}

IndexBox block_at(const CellIndex& number, const std::array<int64_t, 3>& block) {
  IndexBox box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] = number[axis] * block[axis];
    box.hi[axis] = box.lo[axis] + block[axis];
  }
  return box;
}

template <class Visit>
void each_number(const IndexBox& box, const std::array<int64_t, 3>& block, const Visit& visit) {
  const CellIndex first = number_of(box.lo, block);
  const CellIndex last = number_of({box.hi[0] - 1, box.hi[1] - 1, box.hi[2] - 1}, block);
  for (int64_t k = first[2]; k <= last[2]; ++k)
    for (int64_t j = first[1]; j <= last[1]; ++j)
      for (int64_t i = first[0]; i <= last[0]; ++i) visit(CellIndex{i, j, k});
}

void copy_cells(const ValueBlock& from, StageValues& to) {
  const IndexBox box = intersect(from.box(), to.box());
  const auto width = static_cast<size_t>(box.size(0));
  for (size_t c = 0; c < to.channels(); ++c)
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j)
        from.copy_row(c, {box.lo[0], j, k}, std::span(to.channel(c)).subspan(to.offset(box.lo[0], j, k), width));
}

StageValues filled(const IndexBox& box, std::span<const float> values) {
  StageValues made(box, values.size());
  for (size_t c = 0; c < values.size(); ++c) std::ranges::fill(made.channel(c), values[c]);
  return made;
}

}  // namespace

double bytes_of_halo_block(const design::HaloStage::Reach& reach, size_t channels_read, size_t channels_made) {
  const std::array<int64_t, 3> block = block_size(reach);
  double made = 1, read = 1;
  for (size_t axis = 0; axis < 3; ++axis) {
    made *= static_cast<double>(block[axis]);
    read *= static_cast<double>(block[axis] + reach.below[axis] + reach.above[axis]);
  }
  // The factor 3 leaves room for intermediate sums of a stage.
  return 3 * sizeof(float) * (made * static_cast<double>(channels_made) + read * static_cast<double>(channels_read));
}

HaloSource::HaloSource(LatticeFrame frame, std::shared_ptr<const design::HaloStage> stage, StageInput input,
                       std::shared_ptr<SharedStageWork> shared)
    : LatticeSource(std::move(frame)),
      stage_(std::move(stage)),
      input_(std::move(input)),
      shared_(std::move(shared)),
      reach_(stage_->reach(LatticeSource::frame().lattice.voxel_mm())),
      block_(block_size(reach_)),
      filled_(LatticeSource::frame().cells),
      own_blocks_(shared_->blocks.new_owner()),
      input_blocks_(shared_->blocks.new_owner()) {
  for (size_t axis = 0; axis < 3; ++axis) {
    filled_.lo[axis] += reach_.above[axis];
    filled_.hi[axis] -= reach_.below[axis];
  }
}

void HaloSource::read_cells(size_t channel, const CellIndex& first, std::span<float> values) const {
  CellIndex at = first;
  for (size_t done = 0; done < values.size();) {
    const ValueBlockPtr block = block_with(at);
    const size_t count = std::min(values.size() - done, static_cast<size_t>(block->box().hi[0] - at[0]));
    block->copy_row(channel, at, values.subspan(done, count));
    at[0] += static_cast<int64_t>(count);
    done += count;
  }
}

// A reader that keeps the block that it read last.
class HaloSource::Reader final : public CellReader {
 public:
  explicit Reader(const HaloSource& source) : source_(source) {}
  std::optional<float> same_around(size_t channel, const CellIndex& first) override {
    if (!block_ || !holds(first) || !holds({first[0] + 1, first[1] + 1, first[2] + 1})) return std::nullopt;
    return block_->is_uniform(channel) ? std::optional(block_->first(channel)) : std::nullopt;
  }
  void read(size_t channel, const CellIndex& first, std::span<float> values) override {
    const CellIndex last{first[0] + static_cast<int64_t>(values.size()) - 1, first[1], first[2]};
    if (!block_ || !holds(first)) block_ = source_.block_with(first);
    if (holds(last)) return block_->copy_row(channel, first, values);
    source_.read_cells(channel, first, values);
  }

 private:
  bool holds(const CellIndex& cell) const {
    const IndexBox& box = block_->box();
    for (size_t a = 0; a < 3; ++a)
      if (cell[a] < box.lo[a] || cell[a] >= box.hi[a]) return false;
    return true;
  }

  const HaloSource& source_;
  ValueBlockPtr block_;
};

std::unique_ptr<CellReader> HaloSource::reader() const { return std::make_unique<Reader>(*this); }

Interval HaloSource::range_of_cells(size_t channel, const IndexBox& cells) const {
  int64_t count = 0;
  each_number(cells, block_, [&](const CellIndex&) { ++count; });
  const Interval declared = declared_range(channel);
  if (count > most_blocks_queried || declared.is_everything()) return declared;
  std::optional<Interval> range;
  each_number(cells, block_, [&](const CellIndex& number) {
    const ValueBlockPtr block = block_with(block_at(number, block_).lo);
    const Interval here = count <= most_blocks_read ? block->range(channel, cells) : block->range(channel);
    range = range ? hull(*range, here) : here;
  });
  return *range;
}

ValueBlockPtr HaloSource::block_with(const CellIndex& cell) const {
  const CellIndex number = number_of(cell, block_);
  return shared_->blocks.get({own_blocks_, number}, [&] { return known_or_computed(number); });
}

ValueBlock HaloSource::known_or_computed(const CellIndex& number) const {
  design::SubDesignMemory* memory = frame().made_from && shared_->keeps_blocks ? shared_->memory.load() : nullptr;
  if (!memory) return compute(block_at(number, block_));
  std::string text = "block of " + frame().made_from->hex();
  for (const int64_t n : number) text += ' ' + std::to_string(n);
  const Hash key = hash_bytes(text);
  if (const auto known = memory->find(key)) return *std::static_pointer_cast<const ValueBlock>(known);
  const auto made = std::make_shared<const ValueBlock>(compute(block_at(number, block_)));
  memory->keep(key, made, made->bytes());
  return *made;
}

// If all cells that a block reads have the same values, one cell is computed for all.
ValueBlock HaloSource::compute(const IndexBox& box) const {
  const Around around = around_cells(box);
  if (around.values) return ValueBlock(made_of(*around.values, box));
  const IndexBox one{box.lo, {box.lo[0] + 1, box.lo[1] + 1, box.lo[2] + 1}};
  const StageValues made = made_of(filled(grown(one), around.same), one);
  std::vector<float> values;
  for (size_t c = 0; c < made.channels(); ++c) values.push_back(made.channel(c)[0]);
  return ValueBlock(box, values);
}

StageValues HaloSource::made_of(const StageValues& read, const IndexBox& box) const {
  StageValues made(box, frame().channels.size());
  stage_->compute(read, made, frame().lattice.voxel_mm(), shared_->stop.load());
  return made;
}

HaloSource::Around HaloSource::around_cells(const IndexBox& box) const {
  Around around;
  each_number(grown(box), least_block, [&](const CellIndex& number) {
    const ValueBlockPtr block = input_block(number);
    if (!around.values && block->is_uniform()) {
      if (around.same.empty()) around.same = block->firsts();
      if (around.same == block->firsts()) return;
    }
    if (!around.values)
      around.values =
          around.same.empty() ? StageValues(grown(box), block->channels()) : filled(grown(box), around.same);
    copy_cells(*block, *around.values);
  });
  return around;
}

ValueBlockPtr HaloSource::input_block(const CellIndex& number) const {
  return shared_->blocks.get({input_blocks_, number}, [&] {
    const StopFlag* stop = shared_->stop.load();
    design::check_stop(stop);
    const IndexBox box = block_at(number, least_block);
    if (input_.is_zero_outside() && intersect(box, filled_).is_empty())
      return ValueBlock(box, input_.channels().size());
    return ValueBlock(input_.values(box, stop));
  });
}

IndexBox HaloSource::grown(const IndexBox& box) const {
  IndexBox grown = box;
  for (size_t axis = 0; axis < 3; ++axis) {
    grown.lo[axis] -= reach_.below[axis];
    grown.hi[axis] += reach_.above[axis];
  }
  return grown;
}

}  // namespace ombre::compile
