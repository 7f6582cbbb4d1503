// Gradient noise as a value.
//
// Ken Perlin, "Improving Noise", SIGGRAPH 2002: each lattice corner has one of twelve gradients. A point gets the
// weighted mean of the eight linear functions around it, with weights whose first and second derivatives are 0 at the
// corners. Gradients are chosen by the permutation polynomial (34 v + 1) v mod 289 of McEwan, Sheets, Richardson and
// Gustavson, "Efficient computational noise in GLSL", Journal of Graphics Tools 16, 2012. Its integers stay below 2^24,
// so that single precision is exact and every evaluator finds the same gradients.
#include <array>
#include <cmath>

#include "design/spec.h"
#include "nodes/common/lattice_noise.h"

namespace ombre::nodes {
namespace {

using namespace design;
using program::Op;

constexpr double noise_period = 289;  // number of cells after which the noise repeats
// The greatest possible sum of the gradients, near (0.355, 0.481, 0.5) of a cell, if each corner has its best gradient.
constexpr double noise_peak = 1.0363538112118031;

// Exact for integers from 0 to 2^24, also in single precision.
Field remainder(Field v, double divisor) { return v - v.builder->apply(Op::floor, v / divisor) * divisor; }

// Returns the permutation of v. Any integer gives the same result as its remainder, negative ones included.
Field permuted(Field v) { return remainder((v * 34 + 1) * v, noise_period); }

Field mixed(Field a, Field b, Field weight) { return a + weight * (b - a); }

using Corners = std::array<Field, 8>;  // values of the eight corners, indexed by x + 2 y + 4 z

// A coordinate in units of cells.
struct CellAxis {
  std::array<Field, 2> corner;  // integers
  std::array<Field, 2> from;    // distance from each corner
  Field weight, slope;          // weight of the upper corner, and its derivative

  // Repeats after `period` cells.
  CellAxis(Field at, double offset, double period) {
    program::Builder& builder = *at.builder;
    const Field cell = builder.apply(Op::floor, at);
    // The bounds inform intervals, which cannot see how `at` and `cell` are related.
    const Field t = min(max(at - cell, 0.0), builder.constant(1));
    if (period == noise_period) {
      corner[0] = remainder(cell + offset, noise_period);
      corner[1] = corner[0] + 1;
    } else {
      for (size_t n = 0; n < 2; ++n)
        corner[n] = remainder(remainder(cell + static_cast<double>(n), period) + offset, noise_period);
    }
    from = {t, t - 1};
    weight = t * t * t * (t * (t * 6 - 15) + 10);
    slope = 30 * square(t * (1.0 - t));
  }
};

struct Noise {
  double size = 5;
  int seed = 0;
  Choice kind = "gradient";
  int octaves = 1;
  double gain = 0.5, lacunarity = 2;
  bool turbulence = false;
  int period = 0;
  program::SourceField source;  // source of kinds without a formula; made with the node

  static Spec<Noise> spec() {
    return {"noise",
            "Smooth random values that vary over lengths of about its size. The same seed gives the same values.",
            {{"size", &Noise::size, "Distance from one random gradient to the next", unit::positive_mm},
             {"seed", &Noise::seed, "Whole number that selects the noise", from_to(0, 1e9)},
             {"kind", &Noise::kind,
              "gradient (Perlin's), simplex (whose grid is less visible), or cellular (the distance to the nearest of "
              "scattered points)",
              one_of({"gradient", "simplex", "cellular"})},
             {"octaves", &Noise::octaves, "Number of noises that are summed, each finer and weaker than the one before",
              from_to(1, 12)},
             {"gain", &Noise::gain, "Strength of each noise relative to the one before", from_to(0, 1)},
             {"lacunarity", &Noise::lacunarity, "Fineness of each noise relative to the one before", from_to(1, 8)},
             {"turbulence", &Noise::turbulence, "Sums the noises' distances from their mean, which gives creases"},
             {"period", &Noise::period,
              "Number of sizes after which it repeats along x, y and z, so that tiles match; 0: 289 for gradient "
              "noise, none for others",
              from_to(0, 289)}},
            no_inputs,
            "sphere(8 + 2*noise(size=4));",
            {{"value", &Noise::value,
              "Number from 0 to 1; 0.5 on average, except with turbulence and for cellular noise", Interval(0, 1)},
             {"slope", &Noise::slope, "Derivatives of gradient noise along x, y and z, in 1/mm"}}};
  }

  bool complete(const Reader& reader) {
    if (period > 0 && kind == "simplex")
      return reader.refuse("simplex noise does not repeat along x, y and z",
                           "leave out period, or choose another kind");
    if (period > 0 && octaves > 1 && lacunarity != std::floor(lacunarity))
      return reader.refuse("noise that repeats needs a whole lacunarity",
                           "write for example " + spelled::parameter("lacunarity", "2"));
    if (kind == "gradient" && period * std::pow(lacunarity, octaves - 1) > noise_period)
      return reader.refuse("noise repeats after at most 289 sizes of its finest octave",
                           "choose a shorter period, fewer octaves or a smaller lacunarity");
    const OctaveSum sum{octaves, gain, lacunarity, turbulence};
    if (kind == "simplex") source = make_simplex_noise(static_cast<uint64_t>(seed), sum);
    if (kind == "cellular") source = make_cellular_noise(static_cast<uint64_t>(seed), sum, period);
    return true;
  }

  bool gives(size_t output) const { return output == 0 || (output == 1 && kind == "gradient" && !turbulence); }

  Field value(const Ask& ask) const {
    const Point& p = ask.p;
    if (source) return p.builder().source(source, 0, p.x / size, p.y / size, p.z / size);
    if (octaves == 1 && !turbulence) return octave(p, 0);
    Field total = p.constant(0);
    for (int n = 0; n < octaves; ++n) {
      const Field from_mean = octave(p, n) * 2.0 - 1;
      total = total + (turbulence ? abs(from_mean) : from_mean) * share(n);
    }
    return min(max(turbulence ? total : total * 0.5 + 0.5, 0.0), p.constant(1));
  }

  VectorField slope(const Ask& ask) const {
    std::array<Field, 3> total;
    for (int n = 0; n < octaves; ++n) {
      const double finer = size_of(n);
      const Lattice lattice(*this, ask.p, n);
      for (size_t axis = 0; axis < 3; ++axis) {
        const Field along =
            (trilinear(lattice, lattice.gradients[axis]) + lattice.axes[axis].slope * rise(lattice, axis)) *
            (scale / finer);
        total[axis] = octaves == 1 ? along : n == 0 ? along * share(n) : total[axis] + along * share(n);
      }
    }
    return {total[0], total[1], total[2]};
  }

 private:
  static constexpr double scale = 0.5 / noise_peak;

  double size_of(int n) const { return n == 0 ? size : size / std::pow(lacunarity, n); }
  double period_of(int n) const { return period == 0 ? noise_period : std::round(period * std::pow(lacunarity, n)); }
  // Returns an octave's share of the total weight.
  double share(int n) const {
    double sum = 0;
    for (int k = 0; k < octaves; ++k) sum += std::pow(gain, k);
    return std::pow(gain, n) / sum;
  }

  Field octave(const Point& p, int n) const {
    const Lattice lattice(*this, p, n);
    return min(max(trilinear(lattice, lattice.heights) * scale + 0.5, 0.0), p.constant(1));
  }

  struct Lattice {
    std::array<CellAxis, 3> axes;
    std::array<Corners, 3> gradients;  // gradients at the corners, by axis
    Corners heights;                   // values of the corners' linear functions at the point

    Lattice(const Noise& noise, const Point& p, int octave)
        : axes{axis_of(noise, p.x, 0, octave), axis_of(noise, p.y, 1, octave), axis_of(noise, p.z, 2, octave)} {
      for (size_t n = 0; n < heights.size(); ++n) add_corner(n, n & 1, n >> 1 & 1, n >> 2);
    }

    static CellAxis axis_of(const Noise& noise, Field along, int axis, int octave) {
      return {along / noise.size_of(octave), noise.offset(axis, octave), noise.period_of(octave)};
    }

    void add_corner(size_t n, size_t i, size_t j, size_t k) {
      const Field in_row = permuted(axes[0].corner[i]), in_layer = permuted(in_row + axes[1].corner[j]);
      const Field direction = remainder(permuted(in_layer + axes[2].corner[k]), 12);
      // A gradient is 1 or -1 along two axes and 0 along the third. Directions 0 to 3 use x and y, 4 to 7 use x and z,
      // 8 to 11 use y and z.
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

  // Returns the interpolated difference between upper and lower corners along an axis.
  static Field rise(const Lattice& lattice, size_t axis) {
    const size_t step = size_t{1} << axis;
    Corners rises;
    for (size_t n = 0; n < rises.size(); ++n) rises[n] = lattice.heights[n | step] - lattice.heights[n & ~step];
    return trilinear(lattice, rises);
  }

  // A seed moves the lattice by whole cells, differently for each octave.
  double offset(int axis, int n) const {
    // SplitMix64 of Steele, Lea and Flood, 2014.
    uint64_t z = static_cast<uint64_t>(seed) + static_cast<uint64_t>(n + 1) * 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    z ^= z >> 31;
    return static_cast<double>((z >> (20 * axis)) % static_cast<uint64_t>(noise_period));
  }
};

}  // namespace

void add_noise(Registry& registry) { registry.add<Noise>("values"); }

}  // namespace ombre::nodes
