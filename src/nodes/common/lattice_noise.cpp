#include "nodes/common/lattice_noise.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ombre::nodes {
namespace {

uint64_t split_mix(uint64_t z) {
  z += 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

// Beyond this index, double precision cannot distinguish cells.
constexpr double farthest_cell = 1e15;

bool is_near(Vec3 p) {
  return std::abs(p.x) < farthest_cell && std::abs(p.y) < farthest_cell && std::abs(p.z) < farthest_cell;
}

std::array<int64_t, 3> cell_of(Vec3 p) {
  return {static_cast<int64_t>(std::floor(p.x)), static_cast<int64_t>(std::floor(p.y)),
          static_cast<int64_t>(std::floor(p.z))};
}

// Sums octaves of noise to values from 0 to 1.
class Octaves : public program::FieldSource {
 public:
  Octaves(std::string_view name, uint64_t seed, const OctaveSum& sum, int period)
      : name_(name), seed_(seed), sum_(sum), period_(period) {
    std::string key = name_ + " " + std::to_string(seed) + " " + std::to_string(period);
    for (const double number : {static_cast<double>(sum.octaves), sum.gain, sum.lacunarity, sum.is_turbulent ? 1.0 : 0})
      key.append(reinterpret_cast<const char*>(&number), sizeof number);
    content_ = hash_bytes(key);
  }

  std::string name() const override { return name_; }
  Hash content() const override { return content_; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override { return channel_name == "value" ? 0 : -1; }
  Interval range(int, const Box&) const override { return {0, 1}; }

  double sample(int, Vec3 p) const override {
    double total = 0, weights = 0, weight = 1, finer = 1;
    for (int n = 0; n < sum_.octaves; ++n) {
      const Vec3 q = finer * p;
      if (!is_near(q)) return 0.5;
      const double from_mean = 2 * octave(q, seed_ + static_cast<uint64_t>(n), period_of(finer)) - 1;
      total += weight * (sum_.is_turbulent ? std::abs(from_mean) : from_mean);
      weights += weight;
      weight *= sum_.gain;
      finer *= sum_.lacunarity;
    }
    const double mean = weights > 0 ? total / weights : 0;
    return std::clamp(sum_.is_turbulent ? mean : 0.5 + 0.5 * mean, 0.0, 1.0);
  }

 private:
  virtual double octave(Vec3 p, uint64_t seed, int64_t period) const = 0;
  int64_t period_of(double finer) const { return std::llround(period_ * finer); }

  std::string name_;
  uint64_t seed_;
  OctaveSum sum_;
  int period_;
  Hash content_;
};

// Directions to the midpoints of a cube's twelve edges.
constexpr std::array<Vec3, 12> edge_middles{{{1, 1, 0},
                                             {-1, 1, 0},
                                             {1, -1, 0},
                                             {-1, -1, 0},
                                             {1, 0, 1},
                                             {-1, 0, 1},
                                             {1, 0, -1},
                                             {-1, 0, -1},
                                             {0, 1, 1},
                                             {0, -1, 1},
                                             {0, 1, -1},
                                             {0, -1, -1}}};

class SimplexNoise final : public Octaves {
 public:
  SimplexNoise(uint64_t seed, const OctaveSum& sum) : Octaves("simplex noise", seed, sum, 0) {}

 private:
  // Slightly more than the greatest sum for gradients of length sqrt(2), which is near 0.013.
  static constexpr double peak = 1.0 / 76;

  double octave(Vec3 p, uint64_t seed, int64_t) const override {
    const double skew = (p.x + p.y + p.z) / 3;
    const auto cell = cell_of(p + Vec3{skew, skew, skew});
    const Vec3 first = p - unskewed(cell);
    // The corners of the simplex follow the order of the coordinates in the cell, the greatest first.
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return first[a] > first[b]; });
    std::array<int64_t, 3> corner = cell;
    double total = influence(corner, p, seed);
    for (const int axis : order) {
      ++corner[static_cast<size_t>(axis)];
      total += influence(corner, p, seed);
    }
    return std::clamp(0.5 + 0.5 * total / peak, 0.0, 1.0);
  }

  static Vec3 unskewed(const std::array<int64_t, 3>& corner) {
    const Vec3 at{static_cast<double>(corner[0]), static_cast<double>(corner[1]), static_cast<double>(corner[2])};
    const double back = (at.x + at.y + at.z) / 6;
    return at - Vec3{back, back, back};
  }

  static double influence(const std::array<int64_t, 3>& corner, Vec3 p, uint64_t seed) {
    const Vec3 from = p - unskewed(corner);
    const double near = 0.5 - dot(from, from);
    if (near <= 0) return 0;
    const Vec3 gradient = edge_middles[cell_bits(corner[0], corner[1], corner[2], seed) % edge_middles.size()];
    return near * near * near * near * dot(gradient, from);
  }
};

int64_t wrapped_cell(int64_t cell, int64_t period) {
  if (period <= 0) return cell;
  const int64_t rest = cell % period;
  return rest < 0 ? rest + period : rest;
}

class CellularNoise final : public Octaves {
 public:
  CellularNoise(uint64_t seed, const OctaveSum& sum, int period) : Octaves("cellular noise", seed, sum, period) {}

 private:
  double octave(Vec3 p, uint64_t seed, int64_t period) const override {
    const auto cell = cell_of(p);
    double nearest = 1;
    for (int64_t k = cell[2] - 1; k <= cell[2] + 1; ++k)
      for (int64_t j = cell[1] - 1; j <= cell[1] + 1; ++j)
        for (int64_t i = cell[0] - 1; i <= cell[0] + 1; ++i) {
          const uint64_t bits =
              cell_bits(wrapped_cell(i, period), wrapped_cell(j, period), wrapped_cell(k, period), seed);
          const Vec3 point = Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)} +
                             Vec3{unit_of(bits, 0), unit_of(bits, 1), unit_of(bits, 2)};
          nearest = std::min(nearest, length(p - point));
        }
    return nearest;
  }
};

class VoronoiCells final : public program::FieldSource {
 public:
  VoronoiCells(uint64_t seed, double jitter) : seed_(seed), jitter_(jitter) {
    std::string key = "voronoi " + std::to_string(seed);
    key.append(reinterpret_cast<const char*>(&jitter), sizeof jitter);
    content_ = hash_bytes(key);
  }

  std::string name() const override { return "voronoi cells"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override {
    const auto found = std::find(std::begin(channels), std::end(channels), channel_name);
    return found == std::end(channels) ? -1 : static_cast<int>(found - std::begin(channels));
  }
  Interval range(int channel, const Box&) const override {
    if (channel == index) return {0, most_index};
    return channel == border || channel == point ? Interval(0, 3) : Interval(-3, 3);
  }

  double sample(int channel, Vec3 p) const override {
    if (!is_near(p)) return 0;
    const auto cell = cell_of(p);
    const Nearest found = nearest(p, cell);
    switch (channel) {
      case index:
        return static_cast<double>(found.bits >> 40);
      case border:
        return border_distance(found, p, cell);
      case point:
        return length(p - found.at);
      default:
        return (p - found.at)[channel - x];
    }
  }

 private:
  static constexpr std::string_view channels[] = {"index", "border", "point", "x", "y", "z"};
  static constexpr int index = 0, border = 1, point = 2, x = 3;
  static constexpr double most_index = (1 << 24) - 1;
  static constexpr int64_t reach = 2;  // number of cells searched on each side

  struct Nearest {
    Vec3 at;
    uint64_t bits = 0;
  };

  template <class Visit>
  void visit_points(const std::array<int64_t, 3>& cell, const Visit& visit) const {
    for (int64_t k = cell[2] - reach; k <= cell[2] + reach; ++k)
      for (int64_t j = cell[1] - reach; j <= cell[1] + reach; ++j)
        for (int64_t i = cell[0] - reach; i <= cell[0] + reach; ++i) {
          const uint64_t bits = cell_bits(i, j, k, seed_);
          const auto along = [&](int64_t at, int which) {
            return static_cast<double>(at) + 0.5 + jitter_ * (unit_of(bits, which) - 0.5);
          };
          visit(Nearest{{along(i, 0), along(j, 1), along(k, 2)}, bits});
        }
  }

  Nearest nearest(Vec3 p, const std::array<int64_t, 3>& cell) const {
    Nearest best;
    double least = Box::inf;
    visit_points(cell, [&](const Nearest& one) {
      const Vec3 way = p - one.at;
      if (dot(way, way) >= least) return;
      least = dot(way, way);
      best = one;
    });
    return best;
  }

  // Returns the distance to the nearest of the planes midway between the cell's point and other points.
  double border_distance(const Nearest& own, Vec3 p, const std::array<int64_t, 3>& cell) const {
    double least = 3;
    visit_points(cell, [&](const Nearest& other) {
      const Vec3 across = other.at - own.at;
      const double apart = length(across);
      if (other.bits == own.bits || !(apart > 0)) return;
      least = std::min(least, dot(0.5 * (own.at + other.at) - p, across) / apart);
    });
    return std::max(least, 0.0);
  }

  uint64_t seed_;
  double jitter_;
  Hash content_;
};

}  // namespace

uint64_t cell_bits(int64_t i, int64_t j, int64_t k, uint64_t seed) {
  uint64_t bits = split_mix(seed);
  for (const int64_t index : {i, j, k}) bits = split_mix(bits ^ static_cast<uint64_t>(index));
  return bits;
}

double unit_of(uint64_t bits, int which) {
  return static_cast<double>(split_mix(bits + static_cast<uint64_t>(which)) >> 11) * 0x1p-53;
}

program::SourceField make_simplex_noise(uint64_t seed, const OctaveSum& sum) {
  return std::make_shared<SimplexNoise>(seed, sum);
}

program::SourceField make_cellular_noise(uint64_t seed, const OctaveSum& sum, int period) {
  return std::make_shared<CellularNoise>(seed, sum, period);
}

program::SourceField make_voronoi_cells(uint64_t seed, double jitter) {
  return std::make_shared<VoronoiCells>(seed, jitter);
}

}  // namespace ombre::nodes
