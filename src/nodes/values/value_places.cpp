// Values of position: coordinates in frames, distances to solids, points and paths, values at other positions.
#include <cmath>

#include "base/system/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/common/child_distance.h"
#include "nodes/common/curve_frames.h"
#include "nodes/common/field_math.h"
#include "nodes/common/frame.h"
#include "nodes/common/solid_values.h"

namespace ombre::nodes {
namespace {

using namespace design;
using program::Op;

struct Coordinates {
  Vec3 origin, axis{0, 0, 1}, toward{1, 0, 0};
  Affine frame_from_here;  // set when the node is made

  static Spec<Coordinates> spec() {
    return {"coordinates",
            "The position of a point in another frame: as a vector, in cylindrical and in spherical coordinates.",
            {{"origin", &Coordinates::origin, "Origin of the frame", unit::points},
             {"axis", &Coordinates::axis, "Direction of the frame's z", unit::direction},
             {"toward", &Coordinates::toward, "Direction of the frame's x, as far as it is perpendicular to z",
              unit::direction}},
            no_inputs,
            "sphere(8, mix(\"red\", \"blue\", coordinates(axis=(0, 1, 1)).rho / 8));",
            {{"place", &Coordinates::place, "x, y and z in the frame, mm"},
             {"rho", &Coordinates::rho, "Distance from its z axis, mm"},
             {"azimuth", &Coordinates::azimuth, "Angle around that axis from its x, degrees from -180 to 180",
              Interval(-180, 180)},
             {"height", &Coordinates::height, "z in the frame, mm"},
             {"r", &Coordinates::r, "Distance from the origin, mm"},
             {"polar", &Coordinates::polar, "Angle from the axis, degrees from 0 to 180", Interval(0, 180)}}};
  }

  bool complete(const Reader& reader) {
    const auto frame = frame_from_space({origin, axis, toward}, reader);
    if (frame) frame_from_here = *frame;
    return frame.has_value();
  }

  VectorField place(const Ask& ask) const {
    const Point q = ask.p.mapped(frame_from_here);
    return {q.x, q.y, q.z};
  }
  Field rho(const Ask& ask) const {
    const Point q = ask.p.mapped(frame_from_here);
    return length(q.x, q.y);
  }
  Field azimuth(const Ask& ask) const {
    const Point q = ask.p.mapped(frame_from_here);
    return limited(to_degrees(q.builder().apply(Op::atan2, q.y, q.x)), -180, 180);
  }
  Field height(const Ask& ask) const { return ask.p.mapped(frame_from_here).z; }
  Field r(const Ask& ask) const {
    const Point q = ask.p.mapped(frame_from_here);
    return length(q.x, q.y, q.z);
  }
  Field polar(const Ask& ask) const {
    const Point q = ask.p.mapped(frame_from_here);
    return limited(to_degrees(q.builder().apply(Op::atan2, length(q.x, q.y), q.z)), 0, 180);
  }
};

struct At {
  NumberOrMaterial what;
  Numbers3 place;

  static Spec<At> spec() {
    return {"at",
            "A value at another point, which may vary. This warps, repeats or projects values.",
            {{"value", &At::what, "A number, an expression, a material or a mixture", required()},
             {"place", &At::place, "Point where it is evaluated", required(unit::point)}},
            no_inputs,
            "sphere(8, mix(\"red\", \"blue\", at(noise(size=4), [\"x\", \"y\", \"z + 2*sin(x)\"])));",
            {{"value", &At::value, "Number at that point"}, {"mixture", &At::mixture, "Mixture at that point"}}};
  }

  bool gives(size_t output) const { return output == (what.material.is_given() ? 1 : 0); }
  // The value is evaluated at other points than the node itself.
  Traits traits() const { return {.most_evaluations_of_input = 2}; }

  Field value(const Ask& ask) const { return what.number(moved(ask.p)); }
  Composition mixture(const Ask& ask) const { return ask.in.composition_of(what.material, moved(ask.p)); }

 private:
  Point moved(const Point& p) const { return p.moved_to(place.x(p), place.y(p), place.z(p)); }
};

void warn_of_sign_alone(const Reader& reader, const SolidName& solid, const std::string& use) {
  warn_of_implicit_distance(reader, *solid.node, use);
}

struct DistanceTo {
  SolidName solid;
  double step = 0.01;

  static Spec<DistanceTo> spec() {
    return {"distance_to",
            "The distance to the surface of a solid, and the nearest point of the surface.",
            {{"solid", &DistanceTo::solid,
              "A solid, such as sphere(5), translate([4, 0, 0], cube(2)) or mesh(\"a.stl\")", required()},
             {"step", &DistanceTo::step, "Step of the differences that give normal and nearest", unit::positive_mm}},
            no_inputs,
            "sphere(8, mix(\"red\", \"blue\", distance_to(cube(6)) / 4));",
            {{"distance", &DistanceTo::distance, "Distance in mm, negative inside"},
             {"inside", &DistanceTo::is_inside, "1 inside and on the surface, else 0", Interval(0, 1)},
             {"normal", &DistanceTo::normal, "Direction away from the solid, of length 1"},
             {"nearest", &DistanceTo::nearest_place, "Nearest point on the surface, mm"}}};
  }

  bool complete(const Reader& reader) const {
    warn_of_sign_alone(reader, solid, "distance_to");
    return true;
  }

  Field distance(const Ask& ask) const { return ask.in.distance_to(solid, ask.p); }
  Field is_inside(const Ask& ask) const { return ask.in.inside_of(solid, ask.p); }
  VectorField normal(const Ask& ask) const { return normal_of(ask, solid, step); }
  VectorField nearest_place(const Ask& ask) const {
    const VectorField n = normal(ask);
    const Field d = distance(ask);
    return {ask.p.x - d * n.x, ask.p.y - d * n.y, ask.p.z - d * n.z};
  }
};

struct Mask {
  SolidName solid;
  double width = 0;

  static Spec<Mask> spec() {
    return {
        "mask",
        "1 inside a solid and 0 outside, with a border that may be soft.",
        {{"solid", &Mask::solid, "The solid", required()},
         {"width", &Mask::width, "Width of the border, over which the value falls from 1 to 0", unit::not_negative_mm}},
        no_inputs,
        "cube(12, mix(\"red\", \"blue\", mask(sphere(7), width=1)));",
        {{"value", &Mask::value, "Number from 0 to 1", Interval(0, 1)}}};
  }

  bool complete(const Reader& reader) const {
    if (width > 0) warn_of_sign_alone(reader, solid, "mask");
    return true;
  }

  Field value(const Ask& ask) const {
    if (width == 0) return ask.in.inside_of(solid, ask.p);
    return limited(0.5 - ask.in.distance_to(solid, ask.p) / width, 0, 1);
  }
};

Field channel_of(const program::SourceField& source, const char* channel, const Point& p) {
  const int number = source->channel(channel);
  ASSERT(number >= 0);
  return p.builder().source(source, number, p.x, p.y, p.z);
}

bool load_path(PathRequest request, program::SourceField& source, const Reader& reader) {
  if (!reader.loader) return reader.refuse("distances to points cannot be made here");
  source = reader.loader->source(request, reader);
  return source != nullptr;
}

struct PointDistance {
  Points points;
  program::SourceField source;  // made with the node

  static Spec<PointDistance> spec() {
    return {"point_distance",
            "The distance to the nearest of some points, and the index of that point.",
            {{"points", &PointDistance::points, "One or more points", required(unit::points)}},
            no_inputs,
            "sphere(8, mix(\"red\", \"blue\", point_distance([[4, 0, 0], [-4, 2, 0]]) / 6));",
            {{"distance", &PointDistance::distance, "mm", Interval(0, 4 * design_limit_mm)},
             {"index", &PointDistance::index, "Index of the nearest point, from 0 on"}}};
  }

  bool complete(const Reader& reader) {
    if (points.at.empty())
      return reader.refuse(
          "point_distance needs a point",
          "write for example " + spelled::either("point_distance([[0, 0, 0]])", "\"points\": [[0, 0, 0]]",
                                                 "ombre.point_distance([[0, 0, 0]])"));
    return load_path({points.at, PathKind::separate}, source, reader);
  }

  Field distance(const Ask& ask) const { return channel_of(source, "distance", ask.p); }
  Field index(const Ask& ask) const { return channel_of(source, "index", ask.p); }
};

struct PathDistance {
  Points points;
  bool closed = false;
  program::SourceField source;  // made with the node

  static Spec<PathDistance> spec() {
    return {"path_distance",
            "The distance to the straight lines from point to point, and the position of the nearest point along them.",
            {{"points", &PathDistance::points, "Two or more points", required(unit::points)},
             {"closed", &PathDistance::closed, "Joins the last point to the first"}},
            no_inputs,
            "sphere(8, mix(\"red\", \"blue\", path_distance([[-6, 0, 0], [0, 5, 0], [6, 0, 0]]).along));",
            {{"distance", &PathDistance::distance, "mm", Interval(0, 4 * design_limit_mm)},
             {"along", &PathDistance::share_along, "Position by length, 0 at the first point, 1 at the end",
              Interval(0, 1)}}};
  }

  bool complete(const Reader& reader) {
    std::vector<Vec3> way = points.at;
    if (closed && !way.empty()) way.push_back(way.front());
    double whole = 0;
    for (size_t n = 1; n < way.size(); ++n) whole += length(way[n] - way[n - 1]);
    if (!(whole > 0))
      return reader.refuse("path_distance needs two different points",
                           "write for example " + spelled::either("path_distance([[0, 0, 0], [10, 0, 0]])",
                                                                  "\"points\": [[0, 0, 0], [10, 0, 0]]",
                                                                  "ombre.path_distance([[0, 0, 0], [10, 0, 0]])"));
    return load_path({std::move(way)}, source, reader);
  }

  Field distance(const Ask& ask) const { return channel_of(source, "distance", ask.p); }
  Field share_along(const Ask& ask) const { return channel_of(source, "along", ask.p); }
};

struct CurveDistance : CurveParameters {
  Choice frame = "parallel";

  static Spec<CurveDistance> spec() {
    return {
        "curve_distance",
        "The distance to a smooth curve through points, the position of the nearest point along it, and a frame that "
        "moves along the curve.",
        {{"points", &CurveDistance::points, "Two to 1000 different points", required(unit::points)},
         {"toward", &CurveDistance::toward,
          "Direction of the frame's normal at the start, as far as it is perpendicular to the curve", unit::direction},
         {"closed", &CurveDistance::is_closed,
          "Continues the curve from the last point to the first. The frame then turns evenly around the curve by as "
          "much "
          "as is needed to meet itself"},
         {"frame", &CurveDistance::frame,
          "How the normal moves: parallel, without turning around the curve; or frenet, towards the centre of "
          "curvature, "
          "and where the curve is straight as with parallel",
          one_of({"parallel", "frenet"})}},
        no_inputs,
        "sphere(8, mix(\"red\", \"blue\", curve_distance([[-6, 0, 0], [0, 5, 0], [6, 0, 0]]).along));",
        {{"distance", &CurveDistance::distance, "mm", Interval(0, 4 * design_limit_mm)},
         {"along", &CurveDistance::share_along, "Position by length, 0 at the first point, 1 at the end",
          Interval(0, 1)},
         {"place", &CurveDistance::place,
          "Length along the curve, and the way from it across and along the normal, mm"},
         {"tangent", &CurveDistance::tangent, "Direction of the curve at its nearest point, of length 1"},
         {"normal", &CurveDistance::normal, "Direction of the frame's normal there, of length 1"}}};
  }

  bool complete(const Reader& reader) {
    const auto ends = is_closed ? CurveRule::Ends::closed : CurveRule::Ends::cut;
    const auto moves = frame == "frenet" ? CurveRule::Frame::frenet : CurveRule::Frame::parallel;
    curve = smooth_curve(points, {toward, ends, moves}, reader);
    return curve != nullptr;
  }

  Field distance(const Ask& ask) const { return read(ask.p, CurveFrames::distance); }
  Field share_along(const Ask& ask) const { return limited(length_along(ask.p) / curve->length(), 0, 1); }
  VectorField place(const Ask& ask) const {
    return {length_along(ask.p), read(ask.p, CurveFrames::first), read(ask.p, CurveFrames::second)};
  }
  VectorField tangent(const Ask& ask) const { return three(ask.p, CurveFrames::tangent_x); }
  VectorField normal(const Ask& ask) const { return three(ask.p, CurveFrames::normal_x); }

 private:
  Field length_along(const Point& p) const { return limited(read(p, CurveFrames::along), 0, curve->length()); }
  Field read(const Point& p, int channel) const { return p.builder().source(curve, channel, p.x, p.y, p.z); }
  VectorField three(const Point& p, int first) const {
    return {read(p, first), read(p, first + 1), read(p, first + 2)};
  }
};

}  // namespace

void add_value_places(Registry& registry) {
  registry.add<Coordinates, At, DistanceTo, Mask, PointDistance, PathDistance, CurveDistance>("values");
}

}  // namespace ombre::nodes
