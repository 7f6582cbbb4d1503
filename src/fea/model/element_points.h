// Integration points of elements, with the gradients of shape functions.
#pragma once

#include <array>

#include "fea/model/element_mesh.h"

namespace ombre::fea {

struct ElementPoint {
  double volume_mm3 = 0;             // volume that the point stands for; negative if the element is inverted
  std::array<Vec3, 10> gradients{};  // gradients of the nodes' shape functions, 1/mm
};

struct ElementPoints {
  size_t count = 0;
  std::array<ElementPoint, 8> points{};
};

// Finds the integration points: one for C3D4, four for C3D10, eight for C3D8. They are exact for straight edges and
// parallelepipeds.
void find_points(const MeshView& mesh, size_t element, ElementPoints& found);
// Returns the point in the middle, which stands for the whole element.
ElementPoint middle_point(const MeshView& mesh, size_t element);

}  // namespace ombre::fea
