// The outputs of nodes that give maps of cells.
#pragma once

#include <limits>
#include <numbers>

#include "design/spec.h"
#include "nodes/common/field_math.h"
#include "nodes/common/slopes.h"

namespace ombre::nodes {

using program::Field;
using program::Point;

// The region of a map: g, and membership if that is known in a cheaper way (Inputs::inside_of).
struct CellRegion {
  Field distance, inside = {};
};

}  // namespace ombre::nodes

namespace ombre::design {

template <>
struct OutputPort<nodes::CellRegion> {
  static OutputType type() { return OutputPort<OutputSolid>::type(); }
  static OutputAnswer answer(const nodes::CellRegion& made) { return {{made.distance, made.inside}}; }
};

}  // namespace ombre::design

namespace ombre::nodes {

inline constexpr double no_border = std::numeric_limits<double>::infinity();

// Base of maps of cells. T has these methods:
// - Slope cells_at(p) returns u, v and w; or cells_at(ask), if they depend on solids.
// - Field outside(ask) returns g of the region, and Box region_within(where) a box around the region. It may have
//   Field inside(ask), which is 1 in the region, if that is cheaper.
//
// It sets these members when it is completed. It may have Slope size_at(p), the size of cells in mm, if the edges of
// cells are perpendicular everywhere; bool has_right_angles() may say that they are not. It may have Slope slope(p, n)
// or slope(ask, n), the derivatives of u, v or w.
template <class T>
struct CellOutputs {
  Vec3 counts{no_border, no_border, no_border};  // cells along each axis
  bool has_region = true;

  static std::vector<design::OutputSpec<T>> outputs() {
    using design::Ask, design::VectorField;
    return {
        {"place", method<Point>(&CellOutputs::place),
         "u, v and w: the position among cells, whose borders are whole numbers"},
        {"region", method<CellRegion>(&CellOutputs::region),
         static_cast<Box (T::*)(const Box&) const>(&CellOutputs::region_box), "The solid that the cells fill"},
        {"index", method<VectorField>(&CellOutputs::index), "Index of the cell along u, v and w, from 0 on"},
        {"local", method<VectorField>(&CellOutputs::local), "Position in the cell, from 0 to 1 along u, v and w"},
        {"distance", method<Field>(&CellOutputs::distance),
         "Distance to the nearest border of the cell, mm; to first order where borders are curved"},
        {"size", method<VectorField>(&CellOutputs::cell_size),
         "Lengths of the cell along u, v and w, mm, as those at this point"},
        {"volume", method<Field>(&CellOutputs::volume), "Volume of the cell, mm^3, if all of it were as at this point"},
        {"stretches", method<VectorField>(&CellOutputs::stretches),
         "Least, middle and greatest length to which the map stretches a length of 1 cell, mm"},
        {"slope_u", method<VectorField>(&CellOutputs::slope_u), "Derivatives of u by x, y and z, per mm"},
        {"slope_v", method<VectorField>(&CellOutputs::slope_v), "Derivatives of v by x, y and z, per mm"},
        {"slope_w", method<VectorField>(&CellOutputs::slope_w), "Derivatives of w by x, y and z, per mm"},
        {"perpendicular", static_cast<bool (T::*)() const>(&CellOutputs::is_perpendicular),
         "True if the edges of cells are perpendicular everywhere"}};
  }

  bool gives(size_t output) const { return output != 1 || has_region; }

  Point place(const design::Ask& ask) const {
    const Slope at = cells(ask);
    return ask.p.moved_to(at[0], at[1], at[2]);
  }
  CellRegion region(const design::Ask& ask) const {
    if constexpr (requires(const T& t) { t.inside(ask); })
      return {self().outside(ask), self().inside(ask)};
    else
      return {self().outside(ask)};
  }
  Box region_box(const Box& where) const { return self().region_within(where); }

  design::VectorField index(const design::Ask& ask) const {
    return vector([&](size_t n) { return index_along(ask, n); });
  }
  design::VectorField local(const design::Ask& ask) const {
    return vector([&](size_t n) { return limited(cells(ask)[n] - index_along(ask, n), 0, 1); });
  }
  Field distance(const design::Ask& ask) const {
    std::vector<Field> borders;
    for (size_t n = 0; n < 3; ++n) {
      const Field at = cells(ask)[n], off = limited(abs(at - floor_of(at + 0.5)), 0, 0.5);
      borders.push_back(off * height(ask, n));
    }
    return program::fold(borders, program::min);
  }
  design::VectorField cell_size(const design::Ask& ask) const {
    return vector([&](size_t n) { return edge(ask, n); });
  }
  Field volume(const design::Ask& ask) const {
    if (is_perpendicular()) return edge(ask, 0) * edge(ask, 1) * edge(ask, 2);
    return inverse_of(abs(determinant(slopes(ask))));
  }
  // The squares of the stretches are the inverse eigenvalues of the matrix of products of slopes: O. K. Smith,
  // "Eigenvalues of a symmetric 3 x 3 matrix", Communications of the ACM 4, 1961.
  design::VectorField stretches(const design::Ask& ask) const {
    if (is_perpendicular()) {
      const Field a = edge(ask, 0), b = edge(ask, 1), c = edge(ask, 2);
      return {min(min(a, b), c), max(min(a, b), min(max(a, b), c)), max(max(a, b), c)};
    }
    const auto [u, v, w] = slopes(ask);
    const auto of = [](const Slope& a, const Slope& b) { return dot_of(a, b); };
    const Field mean = (of(u, u) + of(v, v) + of(w, w)) / 3.0;
    const Field a = of(u, u) - mean, b = of(v, v) - mean, c = of(w, w) - mean;
    const Field uv = of(u, v), vw = of(v, w), wu = of(w, u);
    // Where eigenvalues are equal, these bounds keep derivatives finite.
    constexpr double least = 1e-30, most_cosine = 1 - 1e-14;
    const Field squares = (square(a) + square(b) + square(c) + (square(uv) + square(vw) + square(wu)) * 2.0) / 6.0;
    const Field spread = sqrt(max(squares, least));
    const Field third = a * (b * c - square(vw)) - uv * (uv * c - vw * wu) + wu * (uv * vw - b * wu);
    const Field cosine = limited(third / max(spread * spread * spread * 2.0, least), -most_cosine, most_cosine);
    const Field angle = ask.p.builder().apply(program::Op::acos, cosine) / 3.0;
    const Field greatest = mean + spread * cos(angle) * 2.0;
    // The product and the sum of the others come from invariants, since differences from the greatest would be inexact.
    const Field pairs = squared_length(cross_without_zeros(u, v)) + squared_length(cross_without_zeros(v, w)) +
                        squared_length(cross_without_zeros(w, u));
    const Field product = square(determinant({u, v, w})) / greatest, half = (pairs - product) / greatest * 0.5;
    const Field middle = half + sqrt(max(square(half) - product, least));
    const auto stretch = [](Field squared) { return inverse_of(sqrt(max(squared, least))); };
    return {stretch(greatest), stretch(middle), stretch(product / middle)};
  }
  design::VectorField slope_u(const design::Ask& ask) const { return slope_vector(ask, 0); }
  design::VectorField slope_v(const design::Ask& ask) const { return slope_vector(ask, 1); }
  design::VectorField slope_w(const design::Ask& ask) const { return slope_vector(ask, 2); }
  bool is_perpendicular() const {
    if constexpr (requires(const T& t) { t.has_right_angles(); })
      return self().has_right_angles();
    else
      return has_size;
  }

  // Returns the derivatives of u, v or w.
  Slope slope(const Point& p, size_t n) const {
    return slope_at([&](const Point& q) { return self().cells_at(q)[n]; }, p);
  }

 private:
  static constexpr bool has_size = requires(const T& t, const Point& p) { t.size_at(p); };

  template <class R, class Method>
  static R (T::*method(Method found))(const design::Ask&) const {
    return static_cast<R (T::*)(const design::Ask&) const>(found);
  }
  const T& self() const { return *static_cast<const T*>(this); }
  Slope cells(const design::Ask& ask) const {
    if constexpr (requires(const T& t) { t.cells_at(ask); })
      return self().cells_at(ask);
    else
      return self().cells_at(ask.p);
  }
  Slope slope_of(const design::Ask& ask, size_t n) const {
    if constexpr (requires(const T& t) { t.slope(ask, n); })
      return self().slope(ask, n);
    else
      return self().slope(ask.p, n);
  }
  template <class Part>
  static design::VectorField vector(const Part& part) {
    return {part(0), part(1), part(2)};
  }

  Field index_along(const design::Ask& ask, size_t n) const {
    const Field whole = floor_of(cells(ask)[n]);
    const double count = counts[static_cast<int>(n)];
    return count == no_border ? whole : limited(whole, 0, count - 1);
  }
  std::array<Slope, 3> slopes(const design::Ask& ask) const {
    return {slope_of(ask, 0), slope_of(ask, 1), slope_of(ask, 2)};
  }
  design::VectorField slope_vector(const design::Ask& ask, size_t n) const {
    const Slope by = slope_of(ask, n);
    return {by[0], by[1], by[2]};
  }
  static Field determinant(const std::array<Slope, 3>& rows) {
    return dot_without_zeros(rows[0], cross_without_zeros(rows[1], rows[2]));
  }
  static Field inverse_of(Field v) { return v.builder->constant(1) / v; }
  static Field squared_length(const Slope& v) { return dot_without_zeros(v, v); }
  static Field length_of(const Slope& v) { return sqrt(squared_length(v)); }
  // Returns the length of the cell's edge along an axis, a column of the inverse of the matrix of slopes.
  Field edge(const design::Ask& ask, size_t n) const {
    if constexpr (has_size)
      if (is_perpendicular()) return self().size_at(ask.p)[n];
    const auto rows = slopes(ask);
    return length_of(cross_without_zeros(rows[(n + 1) % 3], rows[(n + 2) % 3])) / abs(determinant(rows));
  }
  // Returns the distance between opposite faces of the cell.
  Field height(const design::Ask& ask, size_t n) const {
    if constexpr (has_size)
      if (is_perpendicular()) return self().size_at(ask.p)[n];
    return inverse_of(length_of(slope_of(ask, n)));
  }
};

}  // namespace ombre::nodes
