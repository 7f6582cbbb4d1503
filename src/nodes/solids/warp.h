// Solids in distorted space. Points are mapped as by transforms, but by maps that are not affine.
#pragma once

#include <limits>

#include "design/spec.h"
#include "nodes/common/shapes.h"
#include "program/evaluate.h"

namespace ombre::nodes {

// Returns a box around the points to which `inner` maps those of `where`.
template <class T>
Box query_box(const T& warp, const Box& where) {
  if (where.is_empty()) return where;
  program::Builder builder;
  const Point q = warp.inner(Point::origin_frame(builder));
  const program::Program program = builder.finish({{"x", q.x}, {"y", q.y}, {"z", q.z}});
  std::vector<Interval> values;
  program::evaluate_intervals(program, where, values);
  Box box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lo[static_cast<int>(axis)] = values[program.outputs[axis]].lo;
    box.hi[static_cast<int>(axis)] = values[program.outputs[axis]].hi;
  }
  return intersect(box, design::design_space());
}

// Base of the family. T has these methods:
// - inner(p) returns the point at which the child is evaluated.
// - image_of(box) returns a box around the image of the child's box.
// - stretch_in(box) returns the greatest factor by which `inner` increases distances between points of the box, or
//   infinity if neighbours may be evaluated far apart.
// - warn(...) reports what is cut off.
template <class T>
struct Warp {
  Box shape;  // encloses the inside
  double stretch = std::numeric_limits<double>::infinity();

  bool complete(const design::Reader& reader, const std::vector<design::NodePtr>& inputs) {
    const Box child = inputs[0]->bounds(design::design_space());
    self().warn(reader, child);
    shape = self().image_of(child);
    if (shape.is_empty()) return true;
    shape = shape.expanded(1e-6 * (1 + length(shape.lo) + length(shape.hi)));
    const Vec3 size = shape.size();
    if (std::max({size.x, size.y, size.z}) < design::design_limit_mm) stretch = self().stretch_in(shape);
    return true;
  }

  design::Metric metric(const design::Inputs& in) const {
    const design::Metric metric = in.metric(0);
    if (metric.is_implicit() || !std::isfinite(stretch)) return design::Metric::implicit();
    return design::Metric::bounded(std::max(1.0, metric.lipschitz));
  }

  // Far from the shape, maps may stretch without limit. The child is therefore evaluated at the nearest point of the
  // shape's box, and the distance to that box is a lower bound.
  Field distance(const design::Inputs& in, const Point& p) const {
    if (metric(in).is_implicit()) return in.distance(0, self().inner(p));
    const auto clamped = [&](Field v, Interval range) { return min(max(v, range.lo), p.constant(range.hi)); };
    const Point near =
        p.moved_to(clamped(p.x, shape.axis(0)), clamped(p.y, shape.axis(1)), clamped(p.z, shape.axis(2)));
    const Vec3 c = shape.center(), h = 0.5 * shape.size();
    const Field from_box = corner(abs(p.x - c.x) - h.x, abs(p.y - c.y) - h.y, abs(p.z - c.z) - h.z);
    return max(in.distance(0, self().inner(near)) / stretch, from_box);
  }

  Box reach(const design::Inputs& in, const Box& where, double margin) const {
    const bool is_implicit = metric(in).is_implicit();
    if (!is_implicit && margin > 0) return intersect(shape.expanded(margin), where);
    const Box there = is_implicit ? where : intersect(where, shape);
    const Box reached = in.reach(0, query_box(self(), there), margin);
    return reached.is_empty() ? reached : intersect(self().image_of(reached), where);
  }

 private:
  const T& self() const { return *static_cast<const T*>(this); }
};

}  // namespace ombre::nodes
