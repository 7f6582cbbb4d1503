#include "stages/sweep_source.h"

#include <algorithm>

#include "base/system/tasks.h"
#include "base/text/error.h"

namespace ombre::compile {
namespace {

using design::StageValues;

constexpr int64_t most_sweep_slab = 8;        // greatest number of layers in a slab
constexpr double most_slab_bytes = 64 << 20;  // bounds slabs so that a stop flag is seen soon

// Returns one layer of a slab.
StageValues layer_of(const StageValues& slab, int64_t k) {
  IndexBox box = slab.box();
  box.lo[2] = k;
  box.hi[2] = k + 1;
  StageValues layer(box, slab.channels());
  for (size_t c = 0; c < slab.channels(); ++c)
    std::copy_n(slab.channel(c).begin() + static_cast<ptrdiff_t>(slab.offset(box.lo[0], box.lo[1], k)),
                static_cast<size_t>(box.voxels()), layer.channel(c).begin());
  return layer;
}

}  // namespace

SweepSource::SweepSource(LatticeFrame frame, std::shared_ptr<const design::SweepStage> stage, StageInput input,
                         std::shared_ptr<SharedStageWork> shared)
    : PreparedSource(std::move(frame), std::move(input), std::move(shared)),
      stage_(std::move(stage)),
      table_(
          std::make_shared<const ColumnTable>(LatticeSource::frame().cells, LatticeSource::frame().channels.size())) {}

double SweepSource::bytes_of_slab(int64_t layers) const {
  const IndexBox& cells = frame().cells;
  return static_cast<double>(cells.size(0)) * static_cast<double>(cells.size(1)) * static_cast<double>(layers) *
         sizeof(float) * static_cast<double>(input().channels().size());
}

// Returns the memory that slabs take: those that wait for their turn hold values, those that are being made hold them
// twice.
double SweepSource::bytes(int64_t layers, size_t window, size_t threads) const {
  const IndexBox& cells = frame().cells;
  const auto columns = static_cast<double>(cells.size(0)) * static_cast<double>(cells.size(1));
  const double layer = bytes_of_slab(1);
  const double table = columns * sizeof(uint32_t) * static_cast<double>(frame().channels.size());
  return columns * stage_->bytes_of_column() + table + layer +
         layer * static_cast<double>(layers) * static_cast<double>(window + threads);
}

SweepSource::Slabs SweepSource::slabs_for(const StageLoan& loan) const {
  Slabs slabs;
  slabs.threads = static_cast<size_t>(loan.threads > 0 ? loan.threads : core_count());
  slabs.window = 2 * slabs.threads;
  slabs.layers = most_sweep_slab;
  const auto allowed = static_cast<double>(loan.memory_bytes);
  const auto is_too_much = [&] { return bytes(slabs.layers, slabs.window, slabs.threads) > allowed; };
  while (slabs.layers > 1 && bytes_of_slab(slabs.layers) > most_slab_bytes) --slabs.layers;
  while (slabs.window > slabs.threads && is_too_much()) --slabs.window;
  while (slabs.layers > 1 && is_too_much()) --slabs.layers;
  while (slabs.window > 1 && is_too_much()) slabs.threads = --slabs.window;
  return slabs;
}

void SweepSource::compute(const StageLoan& loan, const design::StageWork& work) const {
  const IndexBox& cells = frame().cells;
  const Slabs slabs = slabs_for(loan);
  const auto& lattice = frame().lattice;
  const auto table = std::make_shared<ColumnTable>(cells, frame().channels.size());
  table->set_limit(static_cast<double>(loan.memory_bytes) - bytes(slabs.layers, slabs.window, slabs.threads), name());
  const auto sweep = stage_->begin({lattice.origin, lattice.pitch}, cells, work);
  const int64_t count = (cells.size(2) + slabs.layers - 1) / slabs.layers;
  const auto slab_box = [&](size_t n) {
    IndexBox box = cells;
    box.lo[2] = cells.lo[2] + (count - 1 - static_cast<int64_t>(n)) * slabs.layers;
    box.hi[2] = std::min(box.lo[2] + slabs.layers, cells.hi[2]);
    return box;
  };
  run_ordered<StageValues>(
      static_cast<size_t>(count), static_cast<int>(slabs.threads), slabs.window,
      [&](size_t n) { return input().values(slab_box(n), loan.stop); },
      [&](size_t n, StageValues& slab) {
        for (int64_t k = slab.box().hi[2]; k-- > slab.box().lo[2];) {
          if (loan.stop && loan.stop->requested()) throw Cancelled();
          sweep->take(layer_of(slab, k), *table);
        }
        work.tell(static_cast<double>(n + 1) / static_cast<double>(count));
      });
  sweep->finish(*table);
  table->finish();
  table_ = table;
}

bool SweepSource::unpack(std::string_view values) const {
  const auto table = std::make_shared<ColumnTable>(frame().cells, frame().channels.size());
  if (!table->unpack(values)) return false;
  table_ = table;
  return true;
}

void SweepSource::read_made(size_t channel, const CellIndex& first, std::span<float> values) const {
  for (size_t n = 0; n < values.size(); ++n)
    values[n] = table_->at(channel, first[0] + static_cast<int64_t>(n), first[1], first[2]);
}

Interval SweepSource::range_of_made(size_t channel, const IndexBox& cells) const {
  return table_->range(channel, cells, declared_range(channel));
}

}  // namespace ombre::compile
