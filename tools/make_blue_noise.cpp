// Makes data/blue_noise.bin, and with 2 data/blue_noise_long.bin for voxels that are twice as long along y as along x:
//   ninja -C build/dev make_blue_noise && build/dev/tools/make_blue_noise 1|2 FILE
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
// figures do both well: see docs/user/dithering.md. Lengths are sides of a square as large as a voxel in its layer, so
// that noise for long voxels is blue in millimetres.
//
// Of each 16 ranks that follow each other every layer has one. So each layer keeps every fraction to one of its voxels,
// and all of them together to one of theirs.
//
// The file holds each voxel's rank, 16 bits, the low byte first; x runs fastest, then y, then z.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr int width = 64, height = 64, depth = 16, in_a_layer = width * height, voxels = in_a_layer * depth;
constexpr double in_layer = 1.5, beside = 0.5, across = 1, coupling = 0.5;
constexpr int32_t one = 1 << 22;    // the energy of a voxel with itself
constexpr int32_t taken = 1 << 30;  // lies above every sum of energies

int place(int x, int y, int z) { return (z * height + y) * width + x; }
int layer_of(int voxel) { return voxel / in_a_layer; }

// What a voxel adds to the one at (dx, dy, dz) from it, the nearest way round the torus. `aspect` is a voxel's length
// along y for one along x.
std::vector<int32_t> energy_table(double aspect) {
  std::vector<int32_t> table(voxels);
  const auto squared = [](int d, int size) { return std::pow(std::min(d, size - d), 2); };
  for (int z = 0; z < depth; ++z)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double r2 = squared(x, width) / aspect + squared(y, height) * aspect;
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
  explicit Pattern(double aspect) : energy_(voxels) {
    const std::vector<int32_t> table = energy_table(aspect);
    for (int n = 0; n < voxels; ++n)
      if (table[static_cast<size_t>(n)] != 0)
        kernel_.push_back({n % width, n / width % height, n / in_a_layer, table[static_cast<size_t>(n)]});
    // Ties would otherwise go to the first voxel, again and again.
    std::mt19937 random(1);
    for (int32_t& value : energy_) value = static_cast<int32_t>(random() % 16);
  }

  // Of some layers.
  int tightest_cluster(const std::vector<int>& layers) const { return best(layers, std::greater<>()); }
  int largest_void(const std::vector<int>& layers) const { return best(layers, std::less<>()); }
  bool contains(int voxel) const { return energy_[static_cast<size_t>(voxel)] >= taken; }
  void add(int voxel) { change(voxel, 1); }
  void remove(int voxel) { change(voxel, -1); }

 private:
  struct Neighbour {
    int x, y, z;
    int32_t energy;
  };

  // The first voxel whose energy no other's comes before.
  template <class Before>
  int best(const std::vector<int>& layers, const Before& before) const {
    int found = layers.front() * in_a_layer;
    for (const int layer : layers)
      for (int voxel = layer * in_a_layer; voxel < (layer + 1) * in_a_layer; ++voxel)
        if (before(energy_[static_cast<size_t>(voxel)], energy_[static_cast<size_t>(found)])) found = voxel;
    return found;
  }

  void change(int voxel, int32_t sign) {
    const int x = voxel % width, y = voxel / width % height, z = layer_of(voxel);
    for (const Neighbour& n : kernel_) {
      const int at = place((x + n.x) % width, (y + n.y) % height, (z + n.z) % depth);
      energy_[static_cast<size_t>(at)] += sign * n.energy;
    }
    energy_[static_cast<size_t>(voxel)] += sign * taken;
  }

  std::vector<Neighbour> kernel_;
  std::vector<int32_t> energy_;
};

// Those layers whose turn has not come among the 16 ranks at hand.
class Turns {
 public:
  const std::vector<int>& left() {
    if (left_.empty())
      for (int z = 0; z < depth; ++z) left_.push_back(z);
    return left_;
  }
  void take(int layer) { std::erase(left_, layer); }

 private:
  std::vector<int> left_;
};

// As many voxels of each layer at random, then spread until each layer's tightest cluster fills its largest void.
Pattern spread_points(int in_each_layer, double aspect) {
  Pattern pattern(aspect);
  std::mt19937 random(2);
  for (int z = 0; z < depth; ++z)
    for (int n = 0; n < in_each_layer;) {
      const int voxel = z * in_a_layer + static_cast<int>(random() % in_a_layer);
      if (pattern.contains(voxel)) continue;
      pattern.add(voxel);
      ++n;
    }
  for (int z = 0, at_rest = 0; at_rest < depth; z = (z + 1) % depth) {
    const int from = pattern.tightest_cluster({z});
    pattern.remove(from);
    const int to = pattern.largest_void({z});
    pattern.add(to);
    at_rest = from == to ? at_rest + 1 : 0;
  }
  return pattern;
}

std::vector<uint16_t> ranks(double aspect) {
  constexpr int in_each_layer = in_a_layer / 10, start = in_each_layer * depth;
  const Pattern spread = spread_points(in_each_layer, aspect);
  std::vector<uint16_t> ranks(voxels);
  // Downwards: the tightest cluster goes first.
  Pattern pattern = spread;
  Turns down;
  for (int rank = start - 1; rank >= 0; --rank) {
    const int voxel = pattern.tightest_cluster(down.left());
    down.take(layer_of(voxel));
    pattern.remove(voxel);
    ranks[static_cast<size_t>(voxel)] = static_cast<uint16_t>(rank);
  }
  // Upwards: the largest void is filled. Past one half that is also the tightest cluster of what is
  // left, since the energies of a set and of the rest add up to a constant.
  pattern = spread;
  Turns up;
  for (int rank = start; rank < voxels; ++rank) {
    const int voxel = pattern.largest_void(up.left());
    up.take(layer_of(voxel));
    pattern.add(voxel);
    ranks[static_cast<size_t>(voxel)] = static_cast<uint16_t>(rank);
  }
  return ranks;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string aspect = argc == 3 ? argv[1] : "";
  if (aspect != "1" && aspect != "2") {
    std::cerr << "usage: make_blue_noise 1|2 FILE\n";
    return EXIT_FAILURE;
  }
  std::ofstream file(argv[2], std::ios::binary);
  for (const uint16_t rank : ranks(aspect == "2" ? 2 : 1)) {
    file.put(static_cast<char>(rank & 255));
    file.put(static_cast<char>(rank >> 8));
  }
  file.close();
  return file ? EXIT_SUCCESS : EXIT_FAILURE;
}
