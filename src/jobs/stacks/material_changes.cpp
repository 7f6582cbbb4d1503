#include "jobs/stacks/material_changes.h"

#include <algorithm>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "jobs/stacks/marked_layer.h"

namespace ombre::compile {
namespace {

// The numbers of a solid's materials among the names of both.
using Numbers = std::array<size_t, 256>;

Numbers add_names(const ComparedSolid& solid, MaterialChanges& changes) {
  Numbers numbers{};
  for (const SliceMaterial& material : solid.materials) {
    const auto found = std::ranges::find(changes.names, material.name);
    numbers[material.id] = static_cast<size_t>(found - changes.names.begin());
    if (found != changes.names.end()) continue;
    changes.names.push_back(material.name);
    changes.colours.push_back(material.rgba);
  }
  return numbers;
}

void begin_names(MaterialChanges& changes) {
  changes.names = {"void"};
  changes.colours = {{0, 0, 0, 0}};
}

size_t number_of(const Numbers& numbers, uint32_t id) { return numbers[id < numbers.size() ? id : 0]; }

struct LayerCounts {
  std::map<std::pair<size_t, size_t>, uint64_t> voxels;  // pairs of equal numbers, too
  IndexBox box;
  uint64_t changed = 0;
};

LayerCounts compare(const Shown& a, const Shown& b, const Numbers& of_a, const Numbers& of_b, int64_t width,
                    int64_t layer) {
  LayerCounts counts;
  counts.box = {{INT64_MAX, INT64_MAX, layer}, {0, 0, layer + 1}};
  std::pair<size_t, size_t> last{};
  uint64_t* count = nullptr;
  for (size_t n = 0; n < a.size(); ++n) {
    const std::pair pair(number_of(of_a, a[n]), number_of(of_b, b[n]));
    if (!count || pair != last) count = &counts.voxels[last = pair];
    ++*count;
    if (pair.first == pair.second) continue;
    ++counts.changed;
    const std::array<int64_t, 2> at{static_cast<int64_t>(n) % width, static_cast<int64_t>(n) / width};
    for (size_t axis = 0; axis < 2; ++axis) {
      counts.box.lo[axis] = std::min(counts.box.lo[axis], at[axis]);
      counts.box.hi[axis] = std::max(counts.box.hi[axis], at[axis] + 1);
    }
  }
  return counts;
}

void add(MaterialChanges& changes, int64_t layer, const LayerCounts& counts) {
  for (const auto& [pair, count] : counts.voxels) {
    if (pair.first > 0) changes.inside[0] += count;
    if (pair.second > 0) changes.inside[1] += count;
    if (pair.first != pair.second) changes.voxels[pair] += count;
  }
  if (counts.changed == 0) return;
  const bool is_first = changes.layers.empty();
  for (size_t axis = 0; axis < 3; ++axis) {
    changes.box.lo[axis] = is_first ? counts.box.lo[axis] : std::min(changes.box.lo[axis], counts.box.lo[axis]);
    changes.box.hi[axis] = is_first ? counts.box.hi[axis] : std::max(changes.box.hi[axis], counts.box.hi[axis]);
  }
  changes.layers.push_back({layer, counts.changed});
}

template <class Wanted>
uint64_t sum(const MaterialChanges& changes, const Wanted& wanted) {
  uint64_t voxels = 0;
  for (const auto& [pair, count] : changes.voxels) voxels += wanted(pair.first, pair.second) ? count : 0;
  return voxels;
}

}  // namespace

uint64_t MaterialChanges::lost() const {
  return sum(*this, [](size_t, size_t after) { return after == 0; });
}
uint64_t MaterialChanges::gained() const {
  return sum(*this, [](size_t before, size_t) { return before == 0; });
}
uint64_t MaterialChanges::changed() const {
  return sum(*this, [](size_t before, size_t after) { return before > 0 && after > 0; });
}

MaterialChanges material_changes(const ComparedSolid& a, const ComparedSolid& b, const voxel::Lattice& lattice,
                                 const CheckWork& work) {
  MaterialChanges changes;
  begin_names(changes);
  const Numbers of_a = add_names(a, changes), of_b = add_names(b, changes);
  const auto count = static_cast<size_t>(lattice.count[2]);
  const auto produce = [&](size_t n) {
    if (work.stop && work.stop->requested()) throw Cancelled();
    const auto layer = static_cast<int64_t>(n);
    return compare(a.layer(layer), b.layer(layer), of_a, of_b, lattice.count[0], layer);
  };
  const auto consume = [&](size_t n, LayerCounts& counts) {
    add(changes, static_cast<int64_t>(n), counts);
    if (work.progress) work.progress->update({n + 1, count});
  };
  constexpr size_t window = 64;
  run_ordered<LayerCounts>(count, work.threads, window, produce, consume);
  std::ranges::stable_sort(changes.layers, std::ranges::greater(), &LayerChanges::voxels);
  return changes;
}

std::string picture_of_changes(const ComparedSolid& a, const ComparedSolid& b, const MaterialChanges& changes,
                               const voxel::Lattice& lattice, int64_t layer) {
  MaterialChanges names;
  begin_names(names);
  const Numbers of_a = add_names(a, names), of_b = add_names(b, names);
  const Shown before = a.layer(layer), after = b.layer(layer);
  std::vector<uint8_t> flags(before.size());
  for (size_t n = 0; n < before.size(); ++n) {
    const size_t first = number_of(of_a, before[n]), second = number_of(of_b, after[n]);
    if (first != second) flags[n] = second == 0 ? 1 : first == 0 ? 2 : 3;
  }
  return marked_layer(
      lattice, [&](size_t n) { return changes.colours[number_of(of_a, before[n])]; }, flags);
}

}  // namespace ombre::compile
