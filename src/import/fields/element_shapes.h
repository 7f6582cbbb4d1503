// Shape functions of finite elements: values at the nodes become a field within the element.
//
// Places in an element are reference coordinates: from -1 to 1 along each axis of a brick; of a tetrahedron the shares
// of nodes 2, 3 and 4. After T. J. R. Hughes, The Finite Element Method, 2000, chapter 3.
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

// The weight of each node, and how fast it changes along the reference coordinates. Their sum is 1.
void shape_weights(ElementKind kind, Vec3 at, std::span<double> weights);
void shape_slopes(ElementKind kind, Vec3 at, std::span<Vec3> slopes);

Vec3 middle_of(ElementKind kind);
// Does it lie in the element, or out of it by no more than `room`?
bool is_in_element(ElementKind kind, Vec3 at, double room);
Vec3 clamped_to(ElementKind kind, Vec3 at);
// The places of the nodes, in coordinates of the reference element.
std::span<const Vec3> node_places(ElementKind kind);

// Encloses the field that takes these values at the nodes: its control values in Bernstein's basis, but for rounding.
Interval field_bounds(ElementKind kind, std::span<const double> values);

// Finds the place in the element that is at `target`, by steps of Newton's method from its middle. False where these do
// not arrive.
bool place_in_element(ElementKind kind, std::span<const Vec3> nodes, Vec3 target, Vec3& at);

// Is the element the image of the reference element under one affine map, as tetrahedra and bricks with straight edges
// and even sides are? Up to rounding.
bool is_affine(ElementKind kind, std::span<const Vec3> nodes);
// The same as place_in_element() for such an element, at once.
bool place_in_affine_element(ElementKind kind, std::span<const Vec3> nodes, Vec3 target, Vec3& at);

// The triangles of an element's sides, corner by corner, counter-clockwise from outside; those of a quadratic element
// go through the nodes between corners.
struct ElementSide {
  std::vector<uint8_t> corners;                   // three or four
  std::vector<std::array<uint8_t, 3>> triangles;  // numbers of the element's nodes
};
const std::vector<ElementSide>& sides_of(ElementKind kind);

}  // namespace ombre::importing
