// Points at which elements are integrated, with the gradients of shape functions.
#pragma once

#include <array>

#include "fea/model/element_mesh.h"

namespace ombre::fea {

struct ElementPoint {
  double volume_mm3 = 0;             // that the point stands for; negative where the element is inside out
  std::array<Vec3, 10> gradients{};  // of the nodes' shape functions, 1/mm
};

struct ElementPoints {
  size_t count = 0;
  std::array<ElementPoint, 8> points{};
};

// C3D4: one point, C3D10: four, C3D8: eight; exact for straight edges and parallelepipeds.
void find_points(const MeshView& mesh, size_t element, ElementPoints& found);
// The one in the middle, which stands for all of it.
ElementPoint middle_point(const MeshView& mesh, size_t element);

}  // namespace ombre::fea
