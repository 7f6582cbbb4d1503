// Cells that fill space, and random numbers for them.
//
// A cell has an integer index, a position within it, and a distance to its border. Hexagons and triangles fill the
// plane; along z each has a single unbounded cell.
#include <cmath>

#include "base/system/assert.h"
#include "design/spec.h"
#include "nodes/common/field_math.h"
#include "nodes/common/lattice_noise.h"

namespace ombre::nodes {
namespace {

using namespace design;

constexpr double sqrt3 = 1.7320508075688772;

constexpr std::string_view index_doc = "Index of the cell, as whole numbers; the cell at the origin is 0, 0, 0";
constexpr std::string_view border_doc = "Distance to the nearest border of the cell, mm";

// A position in a hexagonal grid. The integers q and r count hexagons along x and along a direction at 60 degrees to
// it.
struct HexPlace {
  Field q, r;  // index of the hexagon
  Field x, y;  // position relative to its centre, in widths
};

// Finds the nearest centre by rounding cube coordinates: Amit Patel, "Hexagonal grids", 2013.
HexPlace hexagon_at(const Point& p, double width) {
  const Field v = p.y * (2 / (sqrt3 * width)), u = p.x / width - v * 0.5, w = -(u + v);
  const auto whole = [](Field f) { return floor_of(f + 0.5); };
  const Field a = whole(u), b = whole(v), c = whole(w);
  const Field off_a = abs(a - u), off_b = abs(b - v), off_c = abs(c - w);
  const Field mend_a = logical_and(less(off_b, off_a), less(off_c, off_a));
  const Field mend_b = logical_and(logical_not(mend_a), less(off_c, off_b));
  const Field q = select(mend_a, -(b + c), a), r = select(mend_b, -(a + c), b);
  return {q, r, limited(p.x / width - (q + r * 0.5), -0.58, 0.58), limited(p.y / width - r * (sqrt3 / 2), -0.58, 0.58)};
}

struct HexCells {
  double width = 10;

  static Spec<HexCells> spec() {
    return {"hex_cells",
            "The position of a point in a honeycomb of upright hexagons, one of which is centred on the origin. Two of "
            "their sides are perpendicular to x.",
            {{"size", &HexCells::width, "Distance from side to side", unit::positive_mm}},
            no_inputs,
            "cylinder(10, 4, mix(\"red\", \"blue\", hex_cells(5).distance));",
            {{"index", &HexCells::index, index_doc},
             {"local", &HexCells::local, "Position in the cell, in units of its size: x, y, and 0"},
             {"distance", &HexCells::distance, border_doc},
             {"corner", &HexCells::corner, "Distance to the nearest corner of the cell, mm"}}};
  }

  VectorField index(const Ask& ask) const {
    const HexPlace at = hexagon_at(ask.p, width);
    return {at.q, at.r, ask.p.constant(0)};
  }
  VectorField local(const Ask& ask) const {
    const HexPlace at = hexagon_at(ask.p, width);
    return {at.x, at.y, ask.p.constant(0)};
  }
  Field distance(const Ask& ask) const {
    const HexPlace at = hexagon_at(ask.p, width);
    const Field x = abs(at.x), slanted = x * 0.5 + abs(at.y) * (sqrt3 / 2);
    return max((0.5 - max(x, slanted)) * width, 0.0);
  }
  Field corner(const Ask& ask) const {
    const HexPlace at = hexagon_at(ask.p, width);
    // Distances to the corner at the top and to the one on the right, in a quarter of the hexagon.
    const Field x = abs(at.x), y = abs(at.y);
    return min(length(x, y - 1 / sqrt3), length(x - 0.5, y - 0.5 / sqrt3)) * width;
  }
};

// The position of a point along the three directions perpendicular to a triangle's sides, in heights.
struct TrianglePlace {
  std::array<Field, 3> across;
  std::array<Field, 3> strip;  // integers
};

TrianglePlace triangle_at(const Point& p, double side) {
  const double height = side * sqrt3 / 2;
  TrianglePlace at;
  // The three add up to 0, so that strips intersect in triangles.
  at.across[0] = p.y / height;
  at.across[1] = p.x * (sqrt3 / 2 / height) - p.y * (0.5 / height);
  at.across[2] = -(at.across[0] + at.across[1]);
  for (size_t n = 0; n < 3; ++n) at.strip[n] = floor_of(at.across[n]);
  return at;
}

struct TriangleCells {
  double side = 10;

  static Spec<TriangleCells> spec() {
    return {"triangle_cells",
            "The position of a point in a pattern of upright equilateral triangles, six of which meet at the origin.",
            {{"size", &TriangleCells::side, "Length of a side", unit::positive_mm}},
            no_inputs,
            "cylinder(10, 4, mix(\"red\", \"blue\", triangle_cells(6).distance));",
            {{"index", &TriangleCells::index,
              "Indices of the strips between parallel sides that intersect in the triangle"},
             {"local", &TriangleCells::local, "Distance from each side, in heights of the triangle, from 0 to 1"},
             {"distance", &TriangleCells::distance, border_doc}}};
  }

  VectorField index(const Ask& ask) const {
    const TrianglePlace at = triangle_at(ask.p, side);
    return {at.strip[0], at.strip[1], at.strip[2]};
  }
  VectorField local(const Ask& ask) const {
    const auto shares = from_sides(ask.p);
    return {shares[0], shares[1], shares[2]};
  }
  Field distance(const Ask& ask) const {
    const auto shares = from_sides(ask.p);
    const double height = side * sqrt3 / 2;
    return min(shares[0], min(shares[1], shares[2])) * height;
  }

 private:
  // In a triangle that points up, a strip's lower border is a side; in one that points down, its upper border is.
  std::array<Field, 3> from_sides(const Point& p) const {
    const TrianglePlace at = triangle_at(p, side);
    const Field lower = less(p.constant(-1.5), at.strip[0] + at.strip[1] + at.strip[2]);
    std::array<Field, 3> shares;
    for (size_t n = 0; n < 3; ++n) {
      const Field above = limited(at.across[n] - at.strip[n], 0, 1);
      shares[n] = select(lower, above, 1.0 - above);
    }
    return shares;
  }
};

struct TetrahedronCells {
  double size = 10;

  static Spec<TetrahedronCells> spec() {
    return {"tetrahedron_cells",
            "The position of a point in a pattern of tetrahedra: cubes, one of which has a corner at the origin, are "
            "cut in six along a diagonal (Kuhn, 1960).",
            {{"size", &TetrahedronCells::size, "Side of a cube", unit::positive_mm}},
            no_inputs,
            "sphere(8, mix(\"red\", \"blue\", tetrahedron_cells(6).distance));",
            {{"index", &TetrahedronCells::index, "Index of the cube along x, y and z"},
             {"which", &TetrahedronCells::which, "Index of the tetrahedron in its cube, from 0 to 5", Interval(0, 5)},
             {"local", &TetrahedronCells::local, "Position in the cube, from 0 to 1 along x, y and z"},
             {"distance", &TetrahedronCells::distance, border_doc}}};
  }

  VectorField index(const Ask& ask) const {
    return {floor_of(ask.p.x / size), floor_of(ask.p.y / size), floor_of(ask.p.z / size)};
  }
  VectorField local(const Ask& ask) const { return {place(ask.p.x), place(ask.p.y), place(ask.p.z)}; }
  Field which(const Ask& ask) const {
    const VectorField at = local(ask);
    const Field x_first = logical_and(less_equal(at.y, at.x), less_equal(at.z, at.x));
    const Field y_first = logical_and(logical_not(x_first), less_equal(at.z, at.y));
    // There are two tetrahedra for each axis along which the position is greatest.
    const Field zero = ask.p.constant(0), two = ask.p.constant(2), four = ask.p.constant(4);
    const Field second = select(x_first, less(at.y, at.z), select(y_first, less(at.x, at.z), less(at.x, at.y)));
    return limited(select(x_first, zero, select(y_first, two, four)) + second, 0, 5);
  }
  Field distance(const Ask& ask) const {
    const VectorField at = local(ask);
    const Field greatest = max(at.x, max(at.y, at.z)), least = min(at.x, min(at.y, at.z));
    const Field middle = at.x + at.y + at.z - greatest - least;
    // Two faces lie on faces of the cube, two on diagonal planes.
    const Field on_cube = min(1.0 - greatest, least);
    const Field inside = min(greatest - middle, middle - least) * std::sqrt(0.5);
    return max(min(on_cube, inside), 0.0) * size;
  }

 private:
  Field place(Field along) const { return limited(along / size - floor_of(along / size), 0, 1); }
};

struct VoronoiValues {
  double size = 10, jitter = 1;
  int seed = 0;
  program::SourceField cells;  // made with the node

  static Spec<VoronoiValues> spec() {
    return {"voronoi_cells",
            "The position of a point among the Voronoi cells of scattered points, one of which lies in each cube of a "
            "lattice.",
            {{"size", &VoronoiValues::size, "Side of the cubes, which is about the size of a cell", unit::positive_mm},
             {"seed", &VoronoiValues::seed, "Whole number that selects the pattern", from_to(0, 1e9)},
             {"jitter", &VoronoiValues::jitter,
              "Greatest offset of points from the centres of their cubes; 0: cells are cubes", from_to(0, 1)}},
            no_inputs,
            "sphere(9, mix(\"red\", \"blue\", voronoi_cells(6).distance));",
            {{"index", &VoronoiValues::index, "A whole number from 0 to 16777215 for each cell", Interval(0, 16777215)},
             {"local", &VoronoiValues::local, "Vector from the cell's point, mm"},
             {"distance", &VoronoiValues::distance, border_doc},
             {"point", &VoronoiValues::point, "Distance to the cell's point, mm"}}};
  }

  bool complete(const Reader&) {
    cells = make_voronoi_cells(static_cast<uint64_t>(seed), jitter);
    return true;
  }

  Field index(const Ask& ask) const { return read("index", ask.p); }
  VectorField local(const Ask& ask) const {
    return {read("x", ask.p) * size, read("y", ask.p) * size, read("z", ask.p) * size};
  }
  Field distance(const Ask& ask) const { return read("border", ask.p) * size; }
  Field point(const Ask& ask) const { return read("point", ask.p) * size; }

 private:
  Field read(const char* channel, const Point& p) const {
    const int number = cells->channel(channel);
    ASSERT(number >= 0);
    return p.builder().source(cells, number, p.x / size, p.y / size, p.z / size);
  }
};

// A random number for three integers, as channel "value".
class CellRandom final : public program::FieldSource {
 public:
  explicit CellRandom(uint64_t seed) : seed_(seed), content_(hash_bytes("cell random " + std::to_string(seed))) {}
  std::string name() const override { return "random numbers"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override { return channel_name == "value" ? 0 : -1; }
  Interval range(int, const Box&) const override { return {0, 1}; }
  double sample(int, Vec3 p) const override {
    const auto whole = [](double v) { return std::abs(v) < 1e15 ? static_cast<int64_t>(std::llround(v)) : 0; };
    return unit_of(cell_bits(whole(p.x), whole(p.y), whole(p.z), seed_), 0);
  }

 private:
  uint64_t seed_;
  Hash content_;
};

struct RandomOf {
  Numbers3 index;
  int seed = 0;
  double least = 0, greatest = 1;
  program::SourceField drawn;  // made with the node

  static Spec<RandomOf> spec() {
    return {"random",
            "A random number for each cell or part. Equal indices give equal numbers.",
            {{"index", &RandomOf::index,
              "One or three numbers, which are rounded, such as the index of a cell or the label of a part",
              required(one_or_three())},
             {"seed", &RandomOf::seed, "Whole number that selects the random numbers", from_to(0, 1e9)},
             {"lo", &RandomOf::least, "Least number"},
             {"hi", &RandomOf::greatest, "Greatest number"}},
            no_inputs,
            "sphere(8, mix(\"red\", \"blue\", random(cells((3, 3, 3)).index)));",
            {{"value", &RandomOf::value, "Number between the two, uniformly distributed"}}};
  }

  bool complete(const Reader&) {
    drawn = std::make_shared<CellRandom>(static_cast<uint64_t>(seed));
    return true;
  }

  Field value(const Ask& ask) const {
    const Field unit = ask.p.builder().source(drawn, 0, index.x(ask.p), index.y(ask.p), index.z(ask.p));
    return unit * (greatest - least) + least;
  }
};

}  // namespace

void add_value_cells(Registry& registry) {
  registry.add<HexCells, TriangleCells, TetrahedronCells, VoronoiValues, RandomOf>("values");
}

}  // namespace ombre::nodes
