// Makes data/blue_noise.bin: ninja -C build/dev make_blue_noise && build/dev/tools/make_blue_noise FILE
//
// Void and cluster (R. Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE
// 1913, 1993) on a torus of three dimensions. Printers put down one layer after the other, so each layer
// alone must be blue. Layers of plain three-dimensional blue noise are not; so the energy is split into
// a term within layers and one across them, after A. Wolfe et al., "Spatiotemporal blue noise masks",
// EGSR 2022. Between voxels that differ by (dx, dy, dz) it is, with r^2 = dx^2 + dy^2,
//
//   exp(-r^2 / (2 * in_layer^2))                                      in the same layer,
//   coupling * exp(-r^2 / (2 * beside^2) - dz^2 / (2 * across^2))     in two layers.
//
// The second keeps voxels of one material from standing on each other. With coupling 0 the layers know
// nothing of each other; with coupling 1 and `beside` as wide as `in_layer` they lose their own blue. The
// figures do both well: see docs/user/dithering.md.
//
// The file holds each voxel's rank, 16 bits, the low byte first; x runs fastest, then y, then z.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>
#include <vector>

namespace {

constexpr int width = 64, height = 64, depth = 16, voxels = width * height * depth;
constexpr double in_layer = 1.5, beside = 0.5, across = 1, coupling = 0.5;
constexpr int32_t one = 1 << 22;    // the energy of a voxel with itself
constexpr int32_t taken = 1 << 30;  // lies above every sum of energies

int place(int x, int y, int z) { return (z * height + y) * width + x; }

// What a voxel adds to the one at (dx, dy, dz) from it, the nearest way round the torus.
std::vector<int32_t> energy_table() {
  std::vector<int32_t> table(voxels);
  const auto squared = [](int d, int size) { return std::pow(std::min(d, size - d), 2); };
  for (int z = 0; z < depth; ++z)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double r2 = squared(x, width) + squared(y, height);
        const double value =
            z == 0 ? std::exp(-r2 / (2 * in_layer * in_layer))
                   : coupling * std::exp(-r2 / (2 * beside * beside) - squared(z, depth) / (2 * across * across));
        // Whole numbers, so that sums do not depend on their order.
        table[static_cast<size_t>(place(x, y, z))] = static_cast<int32_t>(std::lround(one * value));
      }
  return table;
}

// A set of voxels with the energy that it gives each voxel. Members carry `taken` on top, so the
// tightest cluster is the greatest energy and the largest void the least.
class Pattern {
 public:
  Pattern() : energy_(voxels) {
    const std::vector<int32_t> table = energy_table();
    for (int n = 0; n < voxels; ++n)
      if (table[static_cast<size_t>(n)] != 0)
        kernel_.push_back({n % width, n / width % height, n / (width * height), table[static_cast<size_t>(n)]});
    // Ties would otherwise go to the first voxel, again and again.
    std::mt19937 random(1);
    for (int32_t& value : energy_) value = static_cast<int32_t>(random() % 16);
  }

  int tightest_cluster() const { return index_of(*std::max_element(energy_.begin(), energy_.end())); }
  int largest_void() const { return index_of(*std::min_element(energy_.begin(), energy_.end())); }
  bool contains(int voxel) const { return energy_[static_cast<size_t>(voxel)] >= taken; }
  void add(int voxel) { change(voxel, 1); }
  void remove(int voxel) { change(voxel, -1); }

 private:
  struct Neighbour {
    int x, y, z;
    int32_t energy;
  };

  int index_of(int32_t value) const {
    return static_cast<int>(std::find(energy_.begin(), energy_.end(), value) - energy_.begin());
  }

  void change(int voxel, int32_t sign) {
    const int x = voxel % width, y = voxel / width % height, z = voxel / (width * height);
    for (const Neighbour& n : kernel_) {
      const int at = place((x + n.x) % width, (y + n.y) % height, (z + n.z) % depth);
      energy_[static_cast<size_t>(at)] += sign * n.energy;
    }
    energy_[static_cast<size_t>(voxel)] += sign * taken;
  }

  std::vector<Neighbour> kernel_;
  std::vector<int32_t> energy_;
};

// A tenth of the voxels, at random, then spread until the tightest cluster fills the largest void.
Pattern spread_points(int count) {
  Pattern pattern;
  std::mt19937 random(2);
  for (int n = 0; n < count;) {
    const int voxel = static_cast<int>(random() % voxels);
    if (pattern.contains(voxel)) continue;
    pattern.add(voxel);
    ++n;
  }
  for (int from = -1, to = 0; from != to;) {
    from = pattern.tightest_cluster();
    pattern.remove(from);
    to = pattern.largest_void();
    pattern.add(to);
  }
  return pattern;
}

std::vector<uint16_t> ranks() {
  constexpr int start = voxels / 10;
  const Pattern spread = spread_points(start);
  std::vector<uint16_t> ranks(voxels);
  // Downwards: the tightest cluster goes first.
  Pattern pattern = spread;
  for (int rank = start - 1; rank >= 0; --rank) {
    const int voxel = pattern.tightest_cluster();
    pattern.remove(voxel);
    ranks[static_cast<size_t>(voxel)] = static_cast<uint16_t>(rank);
  }
  // Upwards: the largest void is filled. Past one half that is also the tightest cluster of what is
  // left, since the energies of a set and of the rest add up to a constant.
  pattern = spread;
  for (int rank = start; rank < voxels; ++rank) {
    const int voxel = pattern.largest_void();
    pattern.add(voxel);
    ranks[static_cast<size_t>(voxel)] = static_cast<uint16_t>(rank);
  }
  return ranks;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make_blue_noise FILE\n";
    return EXIT_FAILURE;
  }
  std::ofstream file(argv[1], std::ios::binary);
  for (const uint16_t rank : ranks()) {
    file.put(static_cast<char>(rank & 255));
    file.put(static_cast<char>(rank >> 8));
  }
  file.close();
  return file ? EXIT_SUCCESS : EXIT_FAILURE;
}
