// Solids that are translated, rotated, scaled and mirrored by mapping the points at which the input is evaluated.
#include <map>

#include "design/spec.h"
#include "nodes/common/parameter_checks.h"

namespace ombre::nodes {
namespace {

using namespace design;

// Base of the family. T::map() maps points of the input's space to points of this one.
template <class T>
struct Transform {
  Affine map() const { return static_cast<const T*>(this)->here_from_input(); }

  Point inner(const Point& p) const { return p.mapped(inverse(map())); }
  // Factor for the input's distance, so that the product never exceeds the distance here.
  double scale() const {
    const auto [least, greatest] = stretch(map());
    return greatest - least <= 1e-12 * greatest && std::abs(least - 1) < 1e-12 ? 1 : least;
  }
  Metric metric(const Inputs& in) const {
    const auto [least, greatest] = stretch(map());
    const Metric metric = in.metric(0);
    return greatest - least <= 1e-12 * greatest || metric.is_implicit() ? metric : Metric::bounded(metric.lipschitz);
  }
  Box reach(const Inputs& in, const Box& where, double margin) const {
    return image(map(), in.reach(0, image(inverse(map()), where), margin / scale()));
  }
};

struct Translate : Transform<Translate> {
  Vec3 by;

  static Spec<Translate> spec() {
    return {"translate",
            "Moves what is in its braces.",
            {{"by", &Translate::by, "Distance along x, y and z", required(unit::point)}},
            one_solid,
            "translate(5, 0, 0) { sphere(3, \"red\"); }"};
  }

  Affine here_from_input() const { return Affine::translation(by); }
};

struct Rotate : Transform<Rotate> {
  Vec3 angles, around;
  Choice order = "zyx";
  std::optional<Vec3> axis;
  double degrees = 0;

  static Spec<Rotate> spec() {
    return {"rotate",
            "Turns what is in its braces about fixed axes, right-handed.",
            {{"angles", &Rotate::angles, "Angles about x (pitch), y (yaw) and z (roll)", unit::degrees},
             {"order", &Rotate::order, "Order of the axes, the first turn first",
              one_of({"zyx", "xyz", "xzy", "yxz", "yzx", "zxy"})},
             {"axis", &Rotate::axis, "Axis to turn about, in place of angles", unit::direction},
             {"degrees", &Rotate::degrees, "Angle about axis", unit::degrees},
             {"around", &Rotate::around, "A point that stays in place", unit::point}},
            one_solid,
            "rotate(axis=z, deg=45) { cube(6, \"red\"); }"};
  }

  bool complete(const Reader& reader) const { return !axis || has_direction(reader, "axis", *axis); }

  Affine here_from_input() const {
    Affine turn;
    if (axis)
      turn = Affine::rotation(*axis, degrees);
    else
      for (const char letter : order.text()) {
        const int i = letter - 'x';
        Vec3 direction;
        direction[i] = 1;
        turn = Affine::rotation(direction, angles[i]) * turn;
      }
    return around == Vec3{} ? turn : Affine::translation(around) * turn * Affine::translation(-around);
  }
};

struct Scale : Transform<Scale> {
  Vec3 by{1, 1, 1};

  static Spec<Scale> spec() {
    return {"scale",
            "Stretches what is in its braces, away from the origin.",
            {{"by", &Scale::by, "Factors along x, y and z; not 0", required()}},
            one_solid,
            "scale(1, 1, 2) { sphere(4, \"red\"); }"};
  }

  bool complete(const Reader& reader) const {
    if (by.x != 0 && by.y != 0 && by.z != 0) return true;
    return reader.refuse("a factor of scale is 0, which would flatten the part");
  }

  Affine here_from_input() const { return Affine::scaling(by); }
};

struct Mirror : Transform<Mirror> {
  Vec3 normal{1, 0, 0};

  static Spec<Mirror> spec() {
    return {"mirror",
            "Mirrors what is in its braces at a plane through the origin.",
            {{"normal", &Mirror::normal, "Direction perpendicular to the plane", required(unit::direction)}},
            one_solid,
            "mirror(x) { translate(5, 0, 0) { cone(3, 1, 6, \"red\"); } }"};
  }

  bool complete(const Reader& reader) const { return has_direction(reader, "normal", normal); }

  Affine here_from_input() const {
    const Vec3 n = (1 / length(normal)) * normal;
    Affine map;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) map.rows[static_cast<size_t>(i)][j] -= 2 * n[i] * n[j];
    return map;
  }
};

struct Matrix : Transform<Matrix> {
  Affine matrix;

  static Spec<Matrix> spec() {
    return {
        "matrix",
        "Applies an affine map to what is in its braces.",
        {{"matrix", &Matrix::matrix, "3 or 4 rows of 4 numbers; the last column is a translation in mm", required()}},
        one_solid,
        "matrix([[1, 0.3, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2]]) { cube(6, \"red\"); }"};
  }

  bool complete(const Reader& reader) const {
    const Stretch s = stretch(matrix);
    if (determinant(matrix) != 0 && s.least > 1e-9 * s.greatest) return true;
    return reader.refuse("this matrix flattens space: its determinant is 0, or nearly so");
  }

  Affine here_from_input() const { return matrix; }
};

}  // namespace

void add_transforms(Registry& registry) { registry.add<Translate, Rotate, Scale, Mirror, Matrix>("transforms"); }

}  // namespace ombre::nodes
