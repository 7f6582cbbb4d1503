// The method of the 2023 paper, rebuilt to be timed beside ombre in one sitting: a tree of virtual nodes is
// evaluated for each voxel in double precision on one thread, a random number picks the material
// (Algorithm 1), and libpng writes RGBA layers.
//
//   bench_baseline DESIGN.json NX NY NZ SECONDS FOLDER
//
// Works on layers spread over the height until about SECONDS are spent, and prints what it measured as JSON.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "scene_reader.h"

namespace baseline {
namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct Lattice {
  Counts count;
  Point origin, pitch;

  Lattice(const Box& box, const Counts& counts) : count(counts), origin(box.lo) {
    pitch = {(box.hi.x - box.lo.x) / static_cast<double>(count[0]),
             (box.hi.y - box.lo.y) / static_cast<double>(count[1]),
             (box.hi.z - box.lo.z) / static_cast<double>(count[2])};
  }

  Point centre(int64_t i, int64_t j, int64_t k) const {
    return {origin.x + (static_cast<double>(i) + 0.5) * pitch.x, origin.y + (static_cast<double>(j) + 0.5) * pitch.y,
            origin.z + (static_cast<double>(k) + 0.5) * pitch.z};
  }
};

struct Measured {
  double evaluate_seconds = 0, write_seconds = 0;
  int64_t voxels = 0, bytes = 0;
  std::vector<int64_t> counts;  // voxels of each material, void first
};

class Sampler {
 public:
  Sampler(const Scene& scene, const Lattice& lattice)
      : scene_(scene), lattice_(lattice), shares_(scene.materials.size()) {}

  // Every `stride`-th row of layer k.
  std::vector<uint8_t> layer(int64_t k, int64_t stride) {
    const int64_t nx = lattice_.count[0], ny = lattice_.count[1];
    std::vector<uint8_t> voxels(static_cast<size_t>(nx * ((ny + stride - 1) / stride)));
    uint8_t* next = voxels.data();
    for (int64_t j = 0; j < ny; j += stride)
      for (int64_t i = 0; i < nx; ++i) *next++ = voxel(lattice_.centre(i, j, k));
    return voxels;
  }

 private:
  uint8_t voxel(const Point& p) {
    if (!(scene_.root->distance(p) <= 0)) return 0;
    std::fill(shares_.begin(), shares_.end(), 0.0);
    scene_.root->add_composition(p, shares_);
    return pick();
  }

  // Algorithm 1; the last material with a share takes what rounding leaves over.
  uint8_t pick() {
    double rest = uniform_(random_) * std::accumulate(shares_.begin(), shares_.end(), 0.0);
    size_t last = 0;
    for (size_t m = 1; m < shares_.size(); ++m) {
      if (shares_[m] <= 0) continue;
      if (rest < shares_[m]) return static_cast<uint8_t>(m);
      rest -= shares_[m];
      last = m;
    }
    return static_cast<uint8_t>(last);
  }

  const Scene& scene_;
  const Lattice& lattice_;
  Composition shares_;
  std::mt19937 random_{0};
  std::uniform_real_distribution<double> uniform_{0, 1};
};

// Visits all layers once, and every beginning of the visit is spread over the height.
int64_t spread_step(int64_t layers) {
  int64_t step = std::max<int64_t>(1, std::llround(static_cast<double>(layers) * 0.6180339887));
  while (std::gcd(step, layers) != 1) ++step;
  return step;
}

// How many rows to leave out so that a layer takes at most an eighth of the time that is given.
int64_t choose_stride(Sampler& sampler, const Lattice& lattice, double seconds) {
  constexpr int64_t tried_rows = 8;
  const double began = now();
  sampler.layer(lattice.count[2] / 2, std::max<int64_t>(1, lattice.count[1] / tried_rows));
  const double layer_seconds = (now() - began) / tried_rows * static_cast<double>(lattice.count[1]);
  return std::clamp<int64_t>(std::llround(std::ceil(layer_seconds / (seconds / 8))), 1, lattice.count[1]);
}

Measured measure(const Scene& scene, const Lattice& lattice, double seconds, const std::string& folder) {
  Sampler sampler(scene, lattice);
  Measured measured;
  measured.counts.resize(scene.materials.size());
  const int64_t stride = choose_stride(sampler, lattice, seconds), step = spread_step(lattice.count[2]);
  for (int64_t n = 0; n < lattice.count[2] && measured.evaluate_seconds + measured.write_seconds < seconds; ++n) {
    const int64_t k = n * step % lattice.count[2];
    const double began = now();
    const std::vector<uint8_t> voxels = sampler.layer(k, stride);
    const double evaluated = now();
    const std::string path = folder + "/" + std::to_string(k) + ".png";
    measured.bytes +=
        static_cast<int64_t>(write_png(path, voxels, static_cast<size_t>(lattice.count[0]), scene.colours));
    measured.write_seconds += now() - evaluated;
    measured.evaluate_seconds += evaluated - began;
    measured.voxels += static_cast<int64_t>(voxels.size());
    for (const uint8_t material : voxels) ++measured.counts[material];
    std::filesystem::remove(path);
  }
  return measured;
}

nlohmann::json report(const Scene& scene, const Lattice& lattice, const Measured& measured, double build_seconds) {
  std::map<std::string, int64_t> counts;
  for (size_t m = 1; m < measured.counts.size(); ++m)
    if (measured.counts[m] > 0) counts[scene.materials[m]] = measured.counts[m];
  return {{"voxels", lattice.count[0] * lattice.count[1] * lattice.count[2]},
          {"measured_voxels", measured.voxels},
          {"build_seconds", build_seconds},
          {"evaluate_seconds", measured.evaluate_seconds},
          {"write_seconds", measured.write_seconds},
          {"bytes", measured.bytes},
          {"inside", measured.voxels - measured.counts[0]},
          {"materials", counts}};
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() != 6) {
    std::fprintf(stderr, "usage: bench_baseline DESIGN.json NX NY NZ SECONDS FOLDER\n");
    return 1;
  }
  const Counts counts{std::stoll(arguments[1]), std::stoll(arguments[2]), std::stoll(arguments[3])};
  const double began = now();
  const Scene scene = read_scene(arguments[0], counts);
  const double build_seconds = now() - began;
  const Lattice lattice(scene.box, counts);
  const Measured measured = measure(scene, lattice, std::stod(arguments[4]), arguments[5]);
  std::printf("%s\n", report(scene, lattice, measured, build_seconds).dump().c_str());
  return 0;
}

}  // namespace
}  // namespace baseline

int main(int argc, char** argv) {
  try {
    return baseline::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_baseline: %s\n", error.what());
    return 1;
  }
}
