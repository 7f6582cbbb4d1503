// Gradient noise as a value.
//
// Ken Perlin, "Improving Noise", SIGGRAPH 2002: in each corner of a lattice stands one of twelve gradients, and a point
// gets the mean of the eight linear functions around it, with weights whose first and second derivatives are 0 in the
// corners. The corners' gradients come from the permutation polynomial (34 v + 1) v mod 289 of McEwan, Sheets,
// Richardson and Gustavson, "Efficient computational noise in GLSL", Journal of Graphics Tools 16, 2012: its whole
// numbers stay below 2^24, so that single precision holds them and every evaluator finds the same gradients.
#include <array>

#include "design/spec.h"
#include "nodes/all_nodes.h"

namespace ombre::nodes {
namespace {

using namespace design;
using program::Op;

constexpr double noise_period = 289;  // cells
// The greatest sum that twelve gradients can make: near (0.355, 0.481, 0.5) of a cell, when each corner has its best.
constexpr double noise_peak = 1.0363538112118031;

// Exact for whole numbers from 0 to 2^24, also in single precision.
Field remainder(Field v, double divisor) { return v - v.builder->apply(Op::floor, v / divisor) * divisor; }

// Also of -v, which is the same class of remainders.
Field permuted(Field v) { return remainder((v * 34 + 1) * v, noise_period); }

Field mixed(Field a, Field b, Field weight) { return a + weight * (b - a); }

using Corners = std::array<Field, 8>;  // by x + 2 y + 4 z

// A coordinate in cells.
struct CellAxis {
  std::array<Field, 2> corner;  // whole numbers
  std::array<Field, 2> from;    // the way from each corner
  Field weight, slope;          // of the upper corner, and how fast that grows

  CellAxis(Field at, double offset) {
    program::Builder& builder = *at.builder;
    const Field cell = builder.apply(Op::floor, at);
    // The bounds are for intervals, which see no more than that both may be anything.
    const Field t = min(max(at - cell, 0.0), builder.constant(1));
    corner[0] = remainder(cell + offset, noise_period);
    corner[1] = corner[0] + 1;
    from = {t, t - 1};
    weight = t * t * t * (t * (t * 6 - 15) + 10);
    slope = 30 * square(t * (1.0 - t));
  }
};

struct Noise {
  double size = 5;
  int seed = 0;

  static Spec<Noise> spec() {
    return {
        "noise",
        "values",
        "Smooth random values: gradient noise, which varies over lengths of its size and repeats after 289 of them. "
        "The same seed gives the same values.",
        {{"size", &Noise::size, "How far it is from one random gradient to the next", unit::positive_mm},
         {"seed", &Noise::seed, "Whole number that tells noises apart", from_to(0, 1e9)}},
        no_inputs,
        "sphere(8 + 2*noise(size=4));",
        {{"value", &Noise::value, "From 0 to 1, 0.5 on the average", Interval(0, 1)},
         {"slope", &Noise::slope, "How fast the value grows along x, y and z, in 1/mm"}}};
  }

  Field value(const Ask& ask) const {
    const Lattice lattice(*this, ask.p);
    return min(max(trilinear(lattice, lattice.heights) * scale + 0.5, 0.0), ask.p.constant(1));
  }

  VectorField slope(const Ask& ask) const {
    const Lattice lattice(*this, ask.p);
    const auto along = [&](size_t axis) {
      return (trilinear(lattice, lattice.gradients[axis]) + lattice.axes[axis].slope * rise(lattice, axis)) *
             (scale / size);
    };
    return {along(0), along(1), along(2)};
  }

 private:
  static constexpr double scale = 0.5 / noise_peak;

  struct Lattice {
    std::array<CellAxis, 3> axes;
    std::array<Corners, 3> gradients;  // by axis
    Corners heights;                   // of the corners' linear functions at the point

    Lattice(const Noise& noise, const Point& p)
        : axes{CellAxis(p.x / noise.size, noise.offset(0)), CellAxis(p.y / noise.size, noise.offset(1)),
               CellAxis(p.z / noise.size, noise.offset(2))} {
      for (size_t n = 0; n < heights.size(); ++n) add_corner(n, n & 1, n >> 1 & 1, n >> 2);
    }

    void add_corner(size_t n, size_t i, size_t j, size_t k) {
      const Field in_row = permuted(axes[0].corner[i]), in_layer = permuted(in_row + axes[1].corner[j]);
      const Field direction = remainder(permuted(in_layer + axes[2].corner[k]), 12);
      // Along two of the axes it is 1 or -1, along the third 0: x and y for 0 to 3, x and z to 7, y and z to 11.
      const Field in_xy = direction < 4, in_x = direction < 8, zero = direction.builder->constant(0);
      const Field first = 1 - 2.0 * remainder(direction, 2);
      const Field second = 1 - 2.0 * less_equal(direction.builder->constant(2), remainder(direction, 4));
      gradients[0][n] = select(in_x, first, zero);
      gradients[1][n] = select(in_xy, second, select(in_x, zero, first));
      gradients[2][n] = select(in_xy, zero, second);
      const Field x = axes[0].from[i], y = axes[1].from[j], z = axes[2].from[k];
      heights[n] = first * select(in_x, x, y) + second * select(in_xy, y, z);
    }
  };

  static Field trilinear(const Lattice& lattice, const Corners& v) {
    std::array<Field, 4> rows;
    for (size_t n = 0; n < 4; ++n) rows[n] = mixed(v[2 * n], v[2 * n + 1], lattice.axes[0].weight);
    return mixed(mixed(rows[0], rows[1], lattice.axes[1].weight), mixed(rows[2], rows[3], lattice.axes[1].weight),
                 lattice.axes[2].weight);
  }

  // The heights of the upper corners along an axis over those of the lower ones.
  static Field rise(const Lattice& lattice, size_t axis) {
    const size_t step = size_t{1} << axis;
    Corners rises;
    for (size_t n = 0; n < rises.size(); ++n) rises[n] = lattice.heights[n | step] - lattice.heights[n & ~step];
    return trilinear(lattice, rises);
  }

  // A seed moves the lattice by whole cells.
  double offset(int axis) const {
    // SplitMix64 of Steele, Lea and Flood, 2014.
    uint64_t z = static_cast<uint64_t>(seed) + 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    z ^= z >> 31;
    return static_cast<double>((z >> (20 * axis)) % static_cast<uint64_t>(noise_period));
  }
};

}  // namespace

void add_noise(Registry& registry) { registry.add<Noise>(); }

}  // namespace ombre::nodes
