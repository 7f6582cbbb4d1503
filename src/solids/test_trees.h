// Trees for tests, written much like scripts.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "base/text/error.h"
#include "solids/evaluate_tree.h"
#include "solids/test_kernel.h"

namespace ombre::solids {

// Relative tolerance, because OpenSCAD writes six digits.
inline constexpr double six_digits = 1e-5;
#define EXPECT_SIZE(size, expected) EXPECT_NEAR(size, expected, six_digits*(expected))

using Children = std::vector<TreePtr>;

inline TreePtr node(Operation operation, Children children = {}) {
  auto tree = std::make_shared<Tree>();
  tree->operation = std::move(operation);
  tree->children = std::move(children);
  return tree;
}

inline TreePtr with(TreePtr tree, Semantics semantics) {
  auto copy = std::make_shared<Tree>(*tree);
  copy->semantics = semantics;
  return copy;
}

inline constexpr Colour red{1, 0, 0, 1}, green{0, 0.5, 0, 1}, blue{0, 0, 1, 1};

inline TreePtr cube(double x, double y, double z) { return node(Cube{{x, y, z}}); }
inline TreePtr cube(double size) { return cube(size, size, size); }
inline TreePtr sphere(double radius, double edges = 20) { return node(Sphere{radius, {edges}}); }
inline TreePtr square(double x, double y) { return node(Square{{x, y}}); }
inline TreePtr circle(double radius, double edges = 20) { return node(Circle{radius, {edges}}); }
inline TreePtr nothing() { return node(Group{}); }
inline TreePtr group(Children children) { return node(Group{}, std::move(children)); }
inline TreePtr unite(Children children) { return node(Union{}, std::move(children)); }
inline TreePtr intersection(Children children) { return node(Intersection{}, std::move(children)); }
inline TreePtr difference(Children children) { return node(Difference{}, std::move(children)); }
inline TreePtr hull(Children children) { return node(Hull{}, std::move(children)); }
inline TreePtr minkowski(Children children) { return node(Minkowski{}, std::move(children)); }
inline TreePtr moved(double x, double y, double z, Children children) {
  return node(Transform{Affine::translation({x, y, z})}, std::move(children));
}
inline TreePtr turned(Vec3 axis, double degrees, Children children) {
  return node(Transform{Affine::rotation(axis, degrees)}, std::move(children));
}
inline TreePtr colour(const Colour& colour, Children children) { return node(SetColour{colour}, std::move(children)); }
inline TreePtr part(const std::string& name, Children children) { return node(SetPart{name}, std::move(children)); }
inline TreePtr material(const std::string& name, Children children) {
  return node(SetMaterial{name}, std::move(children));
}

// Returns the volume of a solid in mm3, or the area of a region in mm2.
inline double size_of(const Piece& piece) {
  if (const Region* region = piece.region()) return area_of(*region);
  return piece.solid() ? volume_of(piece.solid()->mesh()) : 0;
}

// Returns true if each edge is traversed equally often in both directions.
inline bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, int> edges;
  const auto key = [&](uint32_t n) { return std::array{mesh.points[n].x, mesh.points[n].y, mesh.points[n].z}; };
  for (const Triangle& t : mesh.triangles)
    for (size_t n = 0; n < 3; ++n) {
      const auto a = key(t[n]), b = key(t[(n + 1) % 3]);
      if (a == b) continue;
      if (a < b)
        ++edges[{a, b}];
      else
        --edges[{b, a}];
    }
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

inline Pieces evaluated(const TreePtr& tree, bool keeps_empty = false) {
  Diagnostics messages;
  EvaluateOptions options;
  options.keeps_empty = keeps_empty;
  options.threads = 2;
  Pieces pieces = evaluate(tree, options, messages);
  for (const Diagnostic& message : messages.list()) EXPECT_NE(message.severity, Severity::error) << to_text(message);
  for (const Piece& piece : pieces) EXPECT_TRUE(!piece.solid() || is_closed(piece.solid()->mesh()));
  return pieces;
}

// Returns the total size of all pieces.
inline double size_of(const TreePtr& tree) {
  double sum = 0;
  for (const Piece& piece : evaluated(tree)) sum += size_of(piece);
  return sum;
}

// Describes pieces, such as "1000 red; 3000 green part x", with sizes rounded to a thousandth.
inline std::string described(const Pieces& pieces) {
  std::string text;
  for (const Piece& piece : pieces) {
    char number[32];
    std::snprintf(number, sizeof number, "%.7g", std::round(size_of(piece) * 1000) / 1000);
    if (!text.empty()) text += "; ";
    text += number;
    const auto& colour = piece.attributes.colour;
    if (colour) text += *colour == red ? " red" : *colour == green ? " green" : *colour == blue ? " blue" : " other";
    if (!piece.attributes.part.empty()) text += " part " + piece.attributes.part;
    if (!piece.attributes.material.empty()) text += " of " + piece.attributes.material;
  }
  return text;
}

inline std::string described(const TreePtr& tree, bool keeps_empty = false) {
  return described(evaluated(tree, keeps_empty));
}

}  // namespace ombre::solids
