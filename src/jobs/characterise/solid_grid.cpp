#include "jobs/characterise/solid_grid.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "base/math/disjoint_sets.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "jobs/printable/print_checks.h"
#include "jobs/slice/slice_work.h"

namespace ombre::compile {
namespace {

struct CountedLayer {
  BitLayer solid;
  std::map<MaterialId, uint64_t> of_material;
  std::vector<uint64_t> along_x;  // solid voxels of each column i
};

CountedLayer counted(const voxel::LayerResult& layer, const std::array<int64_t, 3>& count) {
  CountedLayer result{BitLayer(count[0], count[1]), {}, std::vector<uint64_t>(static_cast<size_t>(count[0]))};
  std::vector<MaterialId> row(static_cast<size_t>(count[0]));
  const auto& voxels = std::get<RunLayer>(layer.channels.front());
  for (int64_t j = 0; j < count[1]; ++j) {
    voxels.row(static_cast<uint32_t>(j)).unpack(row.data());
    for (size_t i = 0; i < row.size();) {
      size_t end = i + 1;
      while (end < row.size() && row[end] == row[i]) ++end;
      if (row[i] != 0) {
        result.solid.set(j, static_cast<int64_t>(i), static_cast<int64_t>(end));
        result.of_material[row[i]] += end - i;
        for (size_t n = i; n < end; ++n) ++result.along_x[n];
      }
      i = end;
    }
  }
  return result;
}

uint64_t row_count(const BitLayer& layer, int64_t j) {
  uint64_t sum = 0;
  for (int64_t n = 0; n < layer.words(); ++n) sum += static_cast<uint64_t>(std::popcount(layer.row(j)[n]));
  return sum;
}

// Returns the layer moved by one voxel along x towards 0; what comes in is void, or the first column.
BitLayer next_along_x(const BitLayer& layer, bool wraps) {
  BitLayer moved(layer.width(), layer.height());
  for (int64_t j = 0; j < layer.height(); ++j) {
    const uint64_t* from = layer.row(j);
    uint64_t* to = moved.row(j);
    for (int64_t n = 0; n < layer.words(); ++n)
      to[n] = from[n] >> 1 | (n + 1 < layer.words() ? from[n + 1] << 63 : uint64_t{0});
    if (wraps && layer.get(0, j)) moved.set(layer.width() - 1, j);
  }
  return moved;
}

BitLayer next_along_y(const BitLayer& layer, bool wraps) {
  BitLayer moved(layer.width(), layer.height());
  for (int64_t j = 0; j < layer.height(); ++j) {
    if (j + 1 == layer.height() && !wraps) continue;
    const uint64_t* from = layer.row((j + 1) % layer.height());
    std::copy(from, from + layer.words(), moved.row(j));
  }
  return moved;
}

int64_t count_of(const BitLayer& layer) { return static_cast<int64_t>(layer.count()); }

BitLayer both(BitLayer a, const BitLayer& b) {
  a &= b;
  return a;
}

// A layer with its neighbours: the solids of pairs and squares within it.
struct LayerCells {
  BitLayer voxels, pairs_x, pairs_y, squares;

  LayerCells(const BitLayer& layer, const Periodic& periodic)
      : voxels(layer),
        pairs_x(both(layer, next_along_x(layer, periodic[0]))),
        pairs_y(both(layer, next_along_y(layer, periodic[1]))),
        squares(both(pairs_x, next_along_y(pairs_x, periodic[1]))) {}

  int64_t euler() const { return count_of(voxels) - count_of(pairs_x) - count_of(pairs_y) + count_of(squares); }
  // Euler's number of what stands between this layer and the next one.
  int64_t euler_to(const LayerCells& next) const {
    return count_of(both(voxels, next.voxels)) - count_of(both(pairs_x, next.pairs_x)) -
           count_of(both(pairs_y, next.pairs_y)) + count_of(both(squares, next.squares));
  }
};

// Connected pieces of runs along x (two-pass labelling of runs; Rosenfeld and Pfaltz, 1966).
class RunPieces {
 public:
  RunPieces(const std::vector<BitLayer>& layers, const Periodic& periodic, bool diagonal)
      : layers_(layers), periodic_(periodic), by_corners_(diagonal ? 1 : 0) {
    for (size_t k = 0; k < layers.size(); ++k) {
      rows_.emplace_back();
      for (int64_t j = 0; j < layers[k].height(); ++j) rows_.back().push_back(runs_of(k, j));
    }
    join_all();
  }

  GridPieces pieces() {
    std::map<uint32_t, uint64_t> sizes;
    std::map<uint32_t, bool> at_border;
    for (size_t k = 0; k < rows_.size(); ++k)
      for (size_t j = 0; j < rows_[k].size(); ++j)
        for (const Run& run : rows_[k][j]) {
          const uint32_t label = pieces_.root(run.label);
          sizes[label] += static_cast<uint64_t>(run.end - run.begin);
          at_border[label] = at_border[label] || is_at_border(k, j, run);
        }
    GridPieces found;
    found.count = sizes.size();
    for (const auto& [label, size] : sizes) found.largest = std::max(found.largest, size);
    for (const auto& [label, reaches] : at_border) found.enclosed += reaches ? 0 : 1;
    return found;
  }

 private:
  struct Run {
    int64_t begin = 0, end = 0;
    uint32_t label = 0;
  };

  std::vector<Run> runs_of(size_t k, int64_t j) {
    std::vector<Run> runs;
    each_run(layers_[k], j, [&](int64_t begin, int64_t end) { runs.push_back({begin, end, pieces_.add()}); });
    return runs;
  }

  void merge(const Run& a, const Run& b) { pieces_.join(a.label, b.label); }

  // Joins the runs of two neighbouring rows.
  void join(const std::vector<Run>& a, const std::vector<Run>& b) {
    size_t next = 0;
    for (const Run& run : a) {
      while (next < b.size() && b[next].end + by_corners_ <= run.begin) ++next;
      for (size_t n = next; n < b.size() && b[n].begin < run.end + by_corners_; ++n) merge(run, b[n]);
    }
    if (!periodic_[0] || a.empty() || b.empty() || by_corners_ == 0) return;
    // Runs at opposite ends meet by a corner where the row is closed to a ring.
    const int64_t width = layers_.front().width();
    if (a.front().begin == 0 && b.back().end == width) merge(a.front(), b.back());
    if (b.front().begin == 0 && a.back().end == width) merge(b.front(), a.back());
  }

  const std::vector<Run>* row_at(int64_t j, int64_t k) const {
    const auto height = static_cast<int64_t>(rows_.front().size()), depth = static_cast<int64_t>(rows_.size());
    if ((j < 0 || j >= height) && !periodic_[1]) return nullptr;
    if ((k < 0 || k >= depth) && !periodic_[2]) return nullptr;
    return &rows_[static_cast<size_t>((k + depth) % depth)][static_cast<size_t>((j + height) % height)];
  }

  void join_all() {
    for (int64_t k = 0; k < static_cast<int64_t>(rows_.size()); ++k)
      for (int64_t j = 0; j < static_cast<int64_t>(rows_.front().size()); ++j) {
        const std::vector<Run>& row = *row_at(j, k);
        if (periodic_[0] && !row.empty() && row.front().begin == 0 && row.back().end == layers_.front().width())
          merge(row.front(), row.back());
        if (const auto* other = row_at(j + 1, k)) join(row, *other);
        for (int64_t dj = -by_corners_; dj <= by_corners_; ++dj)
          if (const auto* other = row_at(j + dj, k + 1)) join(row, *other);
      }
  }

  bool is_at_border(size_t k, size_t j, const Run& run) const {
    const bool ends_x = !periodic_[0] && (run.begin == 0 || run.end == layers_[k].width());
    const bool ends_y = !periodic_[1] && (j == 0 || j + 1 == rows_[k].size());
    const bool ends_z = !periodic_[2] && (k == 0 || k + 1 == rows_.size());
    return ends_x || ends_y || ends_z;
  }

  const std::vector<BitLayer>& layers_;
  Periodic periodic_;
  int64_t by_corners_;
  std::vector<std::vector<std::vector<Run>>> rows_;
  DisjointSets pieces_;
};

// Returns the layers with a margin along all axes: copies of the other side where the box repeats, else void.
BitLayers with_margin(const SolidGrid& grid, const Periodic& periodic, int64_t margin) {
  const auto& count = grid.lattice.count;
  const auto wrapped = [](int64_t n, int64_t size) { return ((n % size) + size) % size; };
  BitLayers wide{-margin, {}};
  for (int64_t k = -margin; k < count[2] + margin; ++k) {
    BitLayer layer(count[0] + 2 * margin, count[1] + 2 * margin);
    const bool is_there = periodic[2] || (k >= 0 && k < count[2]);
    for (int64_t j = -margin; is_there && j < count[1] + margin; ++j) {
      if (!periodic[1] && (j < 0 || j >= count[1])) continue;
      const BitLayer& from = grid.layers[static_cast<size_t>(wrapped(k, count[2]))];
      for (int64_t i = -margin; i < count[0] + margin; ++i) {
        if (!periodic[0] && (i < 0 || i >= count[0])) continue;
        if (from.get(wrapped(i, count[0]), wrapped(j, count[1]))) layer.set(i + margin, j + margin);
      }
    }
    wide.layers.push_back(std::move(layer));
  }
  return wide;
}

// Returns the first voxel of layers [0, count) without their margin that is thinner than the diameter, or nothing.
std::optional<std::array<int64_t, 3>> thin_voxel(const SolidGrid& grid, const Periodic& periodic, bool of_void,
                                                 double diameter_mm, const StopFlag* stop) {
  if (stop && stop->requested()) throw Cancelled();
  const Vec3 voxel = grid.lattice.voxel_mm();
  const int64_t margin = reach_of_thin_places(diameter_mm, voxel) + 1;
  BitLayers region = with_margin(grid, periodic, margin);
  if (of_void) region = inverted(std::move(region));
  const auto& count = grid.lattice.count;
  const BitLayers thin = thin_places(region, diameter_mm, voxel, 0, count[2]);
  for (int64_t k = 0; k < count[2]; ++k)
    for (int64_t j = 0; j < count[1]; ++j)
      for (int64_t i = 0; i < count[0]; ++i)
        if (thin.at(k).get(i + margin, j + margin)) return std::array{i, j, k};
  return std::nullopt;
}

}  // namespace

uint64_t SolidGrid::solid() const { return std::accumulate(sections[2].begin(), sections[2].end(), uint64_t{0}); }

SolidGrid solid_grid(const Plan& plan, int threads, size_t memory_bytes, Progress* progress, const StopFlag* stop) {
  SolidGrid grid;
  grid.lattice = plan.request.lattice;
  const auto& count = grid.lattice.count;
  for (size_t axis = 0; axis < 3; ++axis) grid.sections[axis].assign(static_cast<size_t>(count[axis]), 0);
  std::map<MaterialId, uint64_t> voxels;
  SliceOptions options;
  options.threads = threads;
  options.memory_bytes = memory_bytes;
  const WorkSize work = size_work(plan.request, options);
  const int64_t step = work.slab_layers;
  run_ordered<std::vector<CountedLayer>>(
      static_cast<size_t>((count[2] + step - 1) / step), work.threads, work.window,
      [&](size_t n) {
        const int64_t begin = static_cast<int64_t>(n) * step;
        std::vector<CountedLayer> made;
        for (const voxel::LayerResult& layer : plan.producer(begin, std::min(count[2], begin + step), stop))
          made.push_back(counted(layer, count));
        return made;
      },
      [&](size_t, std::vector<CountedLayer>& made) {
        for (CountedLayer& layer : made) {
          const size_t k = grid.layers.size();
          grid.sections[2][k] = layer.solid.count();
          for (size_t i = 0; i < layer.along_x.size(); ++i) grid.sections[0][i] += layer.along_x[i];
          for (int64_t j = 0; j < count[1]; ++j) grid.sections[1][static_cast<size_t>(j)] += row_count(layer.solid, j);
          for (const auto& [id, number] : layer.of_material) voxels[id] += number;
          grid.layers.push_back(std::move(layer.solid));
        }
        if (progress) progress->update({grid.layers.size(), static_cast<uint64_t>(count[2])});
      });
  for (const SliceMaterial& material : plan.request.materials)
    if (voxels.contains(material.id)) grid.of_material[material.name] = voxels[material.id];
  for (size_t axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (size_t n = 0; n < grid.sections[axis].size(); ++n)
      sum += static_cast<double>(grid.sections[axis][n]) * grid.lattice.center(axis, static_cast<int64_t>(n));
    grid.mean_place[axis] = grid.solid() > 0 ? sum / static_cast<double>(grid.solid()) : 0;
  }
  return grid;
}

int64_t euler_number(const SolidGrid& grid, const Periodic& periodic) {
  int64_t sum = 0;
  const LayerCells first(grid.layers.front(), periodic);
  LayerCells below = first;
  for (size_t k = 0; k < grid.layers.size(); ++k) {
    sum += below.euler();
    const bool is_last = k + 1 == grid.layers.size();
    if (is_last && !periodic[2]) break;
    LayerCells above = is_last ? first : LayerCells(grid.layers[k + 1], periodic);
    sum -= below.euler_to(above);
    below = std::move(above);
  }
  return sum;
}

GridPieces solid_pieces(const SolidGrid& grid, const Periodic& periodic) {
  return RunPieces(grid.layers, periodic, false).pieces();
}

GridPieces void_pieces(const SolidGrid& grid, const Periodic& periodic) {
  std::vector<BitLayer> layers = grid.layers;
  for (BitLayer& layer : layers) layer.invert();
  return RunPieces(layers, periodic, true).pieces();
}

ThinPlace thinnest_place(const SolidGrid& grid, const Periodic& periodic, bool of_void, const StopFlag* stop) {
  constexpr int most = 24;  // voxels; balls grow with their square
  const Vec3 voxel = grid.lattice.voxel_mm();
  const double size = std::min({voxel.x, voxel.y, voxel.z});
  const auto found_at = [&](int voxels) { return thin_voxel(grid, periodic, of_void, voxels * size, stop); };
  int thick = 1, thin = 2;  // no place is thinner than `thick` voxels
  auto place = found_at(thin);
  while (!place && thin < most) {
    thick = thin;
    thin = std::min(2 * thin, most);
    place = found_at(thin);
  }
  if (!place) return {thin * size, false, {}};
  while (thin - thick > 1) {
    const int middle = (thick + thin) / 2;
    const auto here = found_at(middle);
    if (here) place = here;
    (here ? thin : thick) = middle;
  }
  return {thick * size, true, grid.lattice.center((*place)[0], (*place)[1], (*place)[2])};
}

}  // namespace ombre::compile
