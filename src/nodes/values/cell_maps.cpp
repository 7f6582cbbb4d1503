// Maps of cells: in boxes, around axes and centres.
#include <cmath>
#include <numbers>

#include "base/math/math.h"
#include "nodes/common/frame.h"
#include "nodes/common/parameter_checks.h"
#include "nodes/common/shapes.h"
#include "nodes/values/cell_counts.h"
#include "nodes/values/cell_outputs.h"

namespace ombre::nodes {
namespace {

using namespace design;
using program::Op;

constexpr double radian = std::numbers::pi / 180;
constexpr double near_axis = 1e-9;  // mm; nearer to an axis, which is outside of all regions, cells keep their size
struct BoxCells : CellOutputs<BoxCells> {
  std::optional<Vec3> min, max, size;
  std::optional<Counts3> count;
  Vec3 step;  // set when the node is made

  static Spec<BoxCells> spec() {
    return {
        "box_cells",
        "A map of cells that are boxes, with borders along x, y and z.",
        {{"size", &BoxCells::size, cell_size_doc, unit::positive_mm},
         {"count", &BoxCells::count, cell_count_doc, whole_from_one()},
         {"min", &BoxCells::min, "Least corner of the region; none: cells fill all space from the origin", unit::point},
         {"max", &BoxCells::max, "Greatest corner of the region", unit::point}},
        no_inputs,
        "tpms(\"gyroid\", map=box_cells((5, 5, 5), min=(0, 0, 0), max=(20, 20, 10)), thickness=0.4, "
        "material=\"red\");",
        outputs()};
  }

  bool complete(const Reader& reader) {
    if (!is_box_or_none(reader, min, max)) return false;
    has_region = min.has_value();
    if (has_region) {
      if (!find_counts(reader, *max - *min, size, count, counts)) return false;
      for (int n = 0; n < 3; ++n) step[n] = ((*max)[n] - (*min)[n]) / counts[n];
      return true;
    }
    if (size) step = *size;
    return (size && !count) ||
           reader.refuse("box_cells needs the size of its cells, or corners and numbers",
                         "write for example " + spelled::call("box_cells", {{"size", "(5, 5, 5)"}}));
  }

  Slope cells_at(const Point& p) const {
    const Vec3 from = min.value_or(Vec3{});
    return {(p.x - from.x) / step.x, (p.y - from.y) / step.y, (p.z - from.z) / step.z};
  }
  Slope size_at(const Point& p) const { return {p.constant(step.x), p.constant(step.y), p.constant(step.z)}; }

  Field outside(const Ask& ask) const {
    const Point& p = ask.p;
    const Vec3 c = 0.5 * (*min + *max), h = 0.5 * (*max - *min);
    return corner(abs(p.x - c.x) - h.x, abs(p.y - c.y) - h.y, abs(p.z - c.z) - h.z);
  }
  Box region_within(const Box&) const { return {*min, *max}; }
};

// Base of maps around an axis, between two angles. The frame's x lies in the middle between them, so that the jump of
// the angle lies outside, or on a border of cells.
template <class T>
struct AroundAxis : CellOutputs<T> {
  std::optional<Vec3> size;
  std::optional<Counts3> count;
  double start = 0, sweep = 360;
  Vec3 origin, axis{0, 0, 1}, toward{1, 0, 0};
  Affine frame_from_space, turned_from_space;  // set when the node is made; the latter has its x in the middle

  // Returns these parameters followed by those that all maps around an axis have.
  static std::vector<Parameter<T>> with_frame(std::vector<Parameter<T>> parameters) {
    Domain turn = from_to(0, 360, "deg");
    turn.above_least = true;
    for (Parameter<T> one : std::vector<Parameter<T>>{
             {"size", of_base(&T::size), cell_size_doc, unit::positive_mm},
             {"count", of_base(&T::count), cell_count_doc, whole_from_one()},
             {"start", of_base(&T::start), "Angle around the axis at which the first cell begins", unit::degrees},
             {"sweep", of_base(&T::sweep), "Angle that all cells together take up", turn},
             {"origin", of_base(&T::origin), "Centre of the region", unit::point},
             {"axis", of_base(&T::axis), "Direction of the axis", unit::direction},
             {"toward", of_base(&T::toward), "Direction of the angle 0, as far as it is perpendicular to the axis",
              unit::direction}})
      parameters.push_back(std::move(one));
    return parameters;
  }

  // Returns a pointer to a member of a base as one to a member of T.
  template <class M, class Base>
  static M T::*of_base(M Base::*member) {
    return member;
  }

  bool find_frame(const Reader& reader) {
    const auto found = nodes::frame_from_space({origin, axis, toward}, reader);
    if (!found) return false;
    frame_from_space = *found;
    turned_from_space = Affine::rotation({0, 0, 1}, -(start + sweep / 2)) * frame_from_space;
    return true;
  }

  double half_angle() const { return sweep / 2 * radian; }
  Point turned(const Point& p) const { return p.mapped(turned_from_space); }
  // Returns the position between the two angles, from 0 to 1.
  Field share_around(const Point& q) const {
    return q.builder().apply(Op::atan2, q.y, q.x) * (0.5 / half_angle()) + 0.5;
  }
  Field cut_to_sector(Field g, const Point& q) const {
    if (sweep == 360) return g;
    const double sine = std::sin(half_angle()), cosine = std::cos(half_angle());
    const Field side = abs(q.y) * cosine - q.x * sine;
    if (sweep >= 180) return program::max(g, side);
    // Behind the axis, where the sides of the sector meet, the axis is nearest.
    const Field ahead = q.x * cosine + abs(q.y) * sine;
    return program::max(g, select(less(ahead, q.constant(0)), length(q.x, q.y), side));
  }
  // Returns a box around the part of the sector with these distances from the axis and these heights.
  Box sector_box(Interval rho, Interval z) const {
    const Interval angles{start * radian, (start + sweep) * radian};
    const Interval x = math::multiply(rho, math::cos(angles)), y = math::multiply(rho, math::sin(angles));
    return image(inverse(frame_from_space), Box{{x.lo, y.lo, z.lo}, {x.hi, y.hi, z.hi}}).expanded(1e-9);
  }
};

// Base of walls around an axis whose inner and outer radius change linearly along it. T has both radii at its top.
template <class T>
struct WallCells : AroundAxis<T> {
  double inner = 8, outer = 10, height = 20;

  bool complete(const Reader& reader) {
    const double inner_top = self().radii_at_top().lo, outer_top = self().radii_at_top().hi;
    if (!(inner < outer) || !(inner_top < outer_top))
      return reader.refuse(
          "outer radii of " + std::string(reader.node) + " must be greater than the inner ones",
          "write for example " + spelled::parameter("inner", "8") + ", " + spelled::parameter("outer", "10"));
    const double around = (inner + inner_top + outer + outer_top) / 4 * this->sweep * radian;
    const Vec3 lengths{around, height, (outer + outer_top - inner - inner_top) / 2};
    return find_counts(reader, lengths, this->size, this->count, this->counts) && this->find_frame(reader);
  }

  Slope cells_at(const Point& p) const {
    const Point q = this->turned(p);
    const Field from = inner_wall().at(q), thickness = outer_wall().at(q) - from;
    return {this->share_around(q) * this->counts.x, (q.z / height + 0.5) * this->counts.y,
            (length(q.x, q.y) - from) / thickness * this->counts.z};
  }

  Field outside(const Ask& ask) const {
    const Point q = this->turned(ask.p);
    const Field rho = length(q.x, q.y);
    const Field wall = program::max(outer_wall().away(rho, q), -inner_wall().away(rho, q));
    return this->cut_to_sector(program::max(wall, abs(q.z) - height / 2), q);
  }
  Box region_within(const Box&) const {
    const Interval top = self().radii_at_top();
    return this->sector_box({std::min(inner, top.lo), std::max(outer, top.hi)}, {-height / 2, height / 2});
  }

 private:
  // A cone, by its radius in the middle and the rate at which it changes with the height.
  struct Cone {
    double middle, rate;
    Field at(const Point& q) const { return rate == 0 ? q.constant(middle) : q.z * rate + middle; }
    Field away(Field rho, const Point& q) const { return (rho - at(q)) / std::hypot(1, rate); }
  };
  Cone between(double bottom, double top) const { return {(bottom + top) / 2, (top - bottom) / height}; }
  Cone inner_wall() const { return between(inner, self().radii_at_top().lo); }
  Cone outer_wall() const { return between(outer, self().radii_at_top().hi); }
  const T& self() const { return *static_cast<const T*>(this); }
};

struct CylinderCells : WallCells<CylinderCells> {
  static Spec<CylinderCells> spec() {
    return {"cylinder_cells",
            "A map of cells in the wall of a pipe, or in a sector of one: u runs around, v along the axis, w outward.",
            with_frame({{"inner", of_base(&CylinderCells::inner),
                         "Inner radius; cells around would all meet on the axis", unit::positive_mm},
                        {"outer", of_base(&CylinderCells::outer), "Outer radius", unit::radius},
                        {"height", of_base(&CylinderCells::height), "Length along the axis", unit::positive_mm}}),
            no_inputs,
            "tpms(\"gyroid\", map=cylinder_cells(7, 10, 16, count=(12, 4, 1)), thickness=0.4, material=\"red\");",
            outputs()};
  }

  Interval radii_at_top() const { return {inner, outer}; }
  Slope size_at(const Point& p) const {
    const Point q = turned(p);
    return {max(length(q.x, q.y), near_axis) * (2 * half_angle() / counts.x), q.constant(height / counts.y),
            q.constant((outer - inner) / counts.z)};
  }
};

struct FrustumCells : WallCells<FrustumCells> {
  double inner_top = 5, outer_top = 7;

  static Spec<FrustumCells> spec() {
    return {"frustum_cells",
            "A map of cells in the wall of a cone without its tip: u runs around, v along the axis, w outward.",
            with_frame({{"inner", of_base(&FrustumCells::inner), "Inner radius at the bottom", unit::radius},
                        {"outer", of_base(&FrustumCells::outer), "Outer radius at the bottom", unit::radius},
                        {"inner_top", &FrustumCells::inner_top, "Inner radius at the top", unit::radius},
                        {"outer_top", &FrustumCells::outer_top, "Outer radius at the top", unit::radius},
                        {"height", of_base(&FrustumCells::height), "Length along the axis", unit::positive_mm}}),
            no_inputs,
            "tpms(\"gyroid\", map=frustum_cells(7, 10, 4, 6, 16, count=(12, 4, 1)), thickness=0.4, material=\"red\");",
            outputs()};
  }

  Interval radii_at_top() const { return {inner_top, outer_top}; }
};

struct BallCells : AroundAxis<BallCells> {
  double inner = 8, outer = 10, south = -60, north = 60;

  static Spec<BallCells> spec() {
    constexpr double pole = 89.9;  // nearer to a pole, cells around would be slivers
    return {"ball_cells",
            "A map of cells in the wall of a hollow ball, between two latitudes: u runs around, v to the north, w "
            "outward.",
            with_frame(
                {{"inner", &BallCells::inner, "Inner radius; all cells would meet in the centre", unit::radius},
                 {"outer", &BallCells::outer, "Outer radius", unit::radius},
                 {"south", &BallCells::south, "Latitude where cells begin, above the south pole",
                  from_to(-pole, pole, "deg")},
                 {"north", &BallCells::north, "Latitude where cells end, below the north pole, where cells would meet",
                  from_to(-pole, pole, "deg")}}),
            no_inputs,
            "tpms(\"gyroid\", map=ball_cells(7, 10, -60, 60, count=(12, 5, 1)), thickness=0.4, material=\"red\");",
            outputs()};
  }

  bool complete(const Reader& reader) {
    if (!(inner < outer) || !(south < north))
      return reader.refuse(
          "ball_cells needs inner below outer and south below north",
          "write for example " + spelled::parameter("inner", "8") + ", " + spelled::parameter("outer", "10"));
    const double middle = (inner + outer) / 2,
                 widest = south * north <= 0 ? 0 : std::min(std::abs(south), std::abs(north));
    const Vec3 lengths{middle * std::cos(widest * radian) * sweep * radian, middle * (north - south) * radian,
                       outer - inner};
    return find_counts(reader, lengths, size, count, counts) && find_frame(reader);
  }

  Slope cells_at(const Point& p) const {
    const Point q = turned(p);
    const Field rho = length(q.x, q.y), latitude = q.builder().apply(Op::atan2, q.z, rho);
    return {share_around(q) * counts.x, (latitude - south * radian) * (counts.y / ((north - south) * radian)),
            (length(q.x, q.y, q.z) - inner) * (counts.z / (outer - inner))};
  }
  Slope size_at(const Point& p) const {
    const Point q = turned(p);
    return {max(length(q.x, q.y), near_axis) * (2 * half_angle() / counts.x),
            max(length(q.x, q.y, q.z), near_axis) * ((north - south) * radian / counts.y),
            q.constant((outer - inner) / counts.z)};
  }

  Field outside(const Ask& ask) const {
    const Point q = turned(ask.p);
    const Field rho = length(q.x, q.y), r = length(q.x, q.y, q.z);
    const auto beyond = [&](double latitude) {
      return q.z * std::cos(latitude * radian) - rho * std::sin(latitude * radian);
    };
    const Field wall = abs(r - (inner + outer) / 2) - (outer - inner) / 2;
    return cut_to_sector(program::max(wall, program::max(beyond(north), -beyond(south))), q);
  }
  Box region_within(const Box&) const {
    const Interval latitudes{south * radian, north * radian}, r{inner, outer};
    return sector_box(math::multiply(r, math::cos(latitudes)), math::multiply(r, math::sin(latitudes)));
  }
};

}  // namespace

void add_cell_maps(Registry& registry) { registry.add<BoxCells, CylinderCells, FrustumCells, BallCells>("cells"); }

}  // namespace ombre::nodes
