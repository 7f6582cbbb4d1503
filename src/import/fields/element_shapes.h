// Shape functions of finite elements, which interpolate values at the nodes within the element.
//
// Places in an element are reference coordinates: from -1 to 1 along each axis of a brick; in a tetrahedron, the
// barycentric coordinates of nodes 2, 3 and 4. Along z a wedge is a brick, and a tetrahedron across; a pyramid is a
// brick whose upper nodes are one. Source: T. J. R. Hughes, The Finite Element Method, 2000, chapter 3.
#pragma once

#include <span>
#include <vector>

#include "base/math/interval.h"
#include "base/math/vec.h"
#include "formats/results/results.h"

namespace ombre::importing {

using formats::ElementKind;

inline constexpr size_t most_element_nodes = 20;

inline bool is_tetrahedron(ElementKind kind) {
  return kind == ElementKind::tetrahedron4 || kind == ElementKind::tetrahedron10;
}

// shape_weights() computes the weight of each node, shape_slopes() the gradient of the weights in reference
// coordinates. Weights sum to 1.
void shape_weights(ElementKind kind, Vec3 at, std::span<double> weights);
void shape_slopes(ElementKind kind, Vec3 at, std::span<Vec3> slopes);

Vec3 middle_of(ElementKind kind);
// Returns true if the place lies in the element, or outside of it by at most `room`.
bool is_in_element(ElementKind kind, Vec3 at, double room);
Vec3 clamped_to(ElementKind kind, Vec3 at);
// Returns the places of the nodes in reference coordinates.
std::span<const Vec3> node_places(ElementKind kind);

// Encloses the field that takes these values at the nodes, up to rounding; the bounds are its Bernstein control values.
Interval field_bounds(ElementKind kind, std::span<const double> values);

// Finds the place in the element whose point is `target`, by Newton's method from the middle. Returns false if it does
// not converge.
bool place_in_element(ElementKind kind, std::span<const Vec3> nodes, Vec3 target, Vec3& at);

// Returns true if the element is an affine image of the reference element, up to rounding, such as tetrahedra with
// straight edges and parallelepipeds.
bool is_affine(ElementKind kind, std::span<const Vec3> nodes);
// Finds the place of `target` in an affine element directly.
bool place_in_affine_element(ElementKind kind, std::span<const Vec3> nodes, Vec3 target, Vec3& at);

// A side of an element with its triangles, counter-clockwise from outside; triangles of a quadratic element include the
// nodes between corners.
struct ElementSide {
  std::vector<uint8_t> corners;                   // three or four
  std::vector<std::array<uint8_t, 3>> triangles;  // numbers of the element's nodes
};
const std::vector<ElementSide>& sides_of(ElementKind kind);

}  // namespace ombre::importing
