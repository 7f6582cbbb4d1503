// Points, vectors and affine maps. Lengths are in mm unless a name says otherwise.
#pragma once

#include <array>
#include <cmath>

namespace ombre {

struct Vec2 {
  double x = 0, y = 0;
  bool operator==(const Vec2&) const = default;
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double length(Vec2 a) { return std::sqrt(dot(a, a)); }

struct Vec3 {
  double x = 0, y = 0, z = 0;

  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  bool operator==(const Vec3&) const = default;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline bool is_finite(Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

// The map p -> linear * p + offset. Maps are named `to_from`: `part_from_world` maps world points to part points.
struct Affine {
  std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 offset;

  Vec3 operator()(Vec3 p) const { return linear(p) + offset; }
  Vec3 linear(Vec3 v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  bool is_identity() const { return *this == Affine{}; }
  bool operator==(const Affine&) const = default;

  static Affine translation(Vec3 by) { return {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, by}; }
  static Affine scaling(Vec3 s) { return {{Vec3{s.x, 0, 0}, Vec3{0, s.y, 0}, Vec3{0, 0, s.z}}, {}}; }
  // Returns a right-handed rotation, exact at multiples of 90 degrees. The axis may have any length but zero.
  static Affine rotation(Vec3 axis, double degrees);
};

// Composes two maps: (c_from_b * b_from_a)(p) == c_from_b(b_from_a(p)).
Affine operator*(const Affine& c_from_b, const Affine& b_from_a);
double determinant(const Affine& map);
// Returns the inverse. The determinant must not be zero.
Affine inverse(const Affine& map);
// True if a coordinate of the image depends on more than one coordinate.
bool mixes_axes(const Affine& map);
// The least and greatest factors by which a map can stretch a vector.
struct Stretch {
  double least = 1, greatest = 1;
};
Stretch stretch(const Affine& map);

}  // namespace ombre
