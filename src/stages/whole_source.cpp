#include "stages/whole_source.h"

#include <algorithm>

#include "base/system/byte_pack.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "voxel/tile.h"

namespace ombre::compile {
namespace {

using design::StageValues;

constexpr int64_t slab_layers = 8;
// Limit of cells that are searched value by value; larger boxes are not.
constexpr int64_t most_cells_queried = 1 << 15;

}  // namespace

double WholeSource::cell_count() const {
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) count *= static_cast<double>(frame().cells.size(axis));
  return count;
}

double WholeSource::least_bytes() const {
  const auto channels = static_cast<double>(input().channels().size() + frame().channels.size());
  return cell_count() * (channels * sizeof(float) + stage_->bytes_of_cell());
}

double WholeSource::kept_bytes() const {
  return cell_count() * static_cast<double>(frame().channels.size()) * sizeof(float);
}

// Reads all cells slab by slab; progress goes to one half.
StageValues WholeSource::read_all(const StageLoan& loan, const design::StageWork& work) const {
  const IndexBox& cells = frame().cells;
  StageValues read(cells, input().channels().size(), loan.stop);
  const auto slabs = static_cast<size_t>((cells.size(2) + slab_layers - 1) / slab_layers);
  run_ordered<StageValues>(
      slabs, loan.threads, 2 * static_cast<size_t>(loan.threads > 0 ? loan.threads : core_count()),
      [&](size_t n) {
        IndexBox box = cells;
        box.lo[2] += static_cast<int64_t>(n) * slab_layers;
        box.hi[2] = std::min(box.lo[2] + slab_layers, cells.hi[2]);
        return input().values(box, loan.stop);
      },
      [&](size_t n, StageValues& slab) {
        design::check_stop(loan.stop);
        for (size_t c = 0; c < slab.channels(); ++c)
          std::ranges::copy(slab.channel(c),
                            read.channel(c).begin() +
                                static_cast<ptrdiff_t>(read.offset(cells.lo[0], cells.lo[1], slab.box().lo[2])));
        work.tell(0.5 * static_cast<double>(n + 1) / static_cast<double>(slabs));
      });
  return read;
}

void WholeSource::compute(const StageLoan& loan, const design::StageWork& work) const {
  const StageValues read = read_all(loan, work);
  const auto made = std::make_shared<StageValues>(frame().cells, frame().channels.size(), loan.stop);
  design::StageWork rest = work;
  rest.tell = [&](double share) { work.tell(0.5 + 0.5 * share); };
  stage_->compute(read, *made, {frame().lattice.origin, frame().lattice.pitch}, rest);
  made_ = made;
}

std::string WholeSource::pack() const {
  BytePacker packer;
  for (size_t n = 0; n < made_->channels(); ++n) packer.add_list(made_->channel(n));
  return packer.take();
}

bool WholeSource::unpack(std::string_view values) const {
  ByteUnpacker unpacker(values);
  const auto made = std::make_shared<StageValues>(frame().cells, frame().channels.size());
  for (size_t n = 0; n < made->channels(); ++n) {
    std::vector<float> channel = unpacker.get_list<float>();
    if (channel.size() != made->channel(n).size()) return false;
    made->channel(n) = std::move(channel);
  }
  made_ = made;
  return true;
}

void WholeSource::read_made(size_t channel, const CellIndex& first, std::span<float> values) const {
  const auto from =
      made_->channel(channel).begin() + static_cast<ptrdiff_t>(made_->offset(first[0], first[1], first[2]));
  std::copy_n(from, values.size(), values.begin());
}

Interval WholeSource::range_of_made(size_t channel, const IndexBox& cells) const {
  if (cells.voxels() > most_cells_queried) return declared_range(channel);
  std::optional<Interval> range;
  for (int64_t k = cells.lo[2]; k < cells.hi[2]; ++k)
    for (int64_t j = cells.lo[1]; j < cells.hi[1]; ++j) {
      const auto row = made_->channel(channel).begin() + static_cast<ptrdiff_t>(made_->offset(cells.lo[0], j, k));
      const auto [least, greatest] = std::minmax_element(row, row + cells.size(0));
      const Interval here(*least, *greatest);
      range = range ? hull(*range, here) : here;
    }
  return *range;
}

}  // namespace ombre::compile
