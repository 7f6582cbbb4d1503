// The surfaces of a shape's faces. Only for this folder, because it includes the library's headers.
#pragma once

#include <BRepAdaptor_Surface.hxx>

#include <vector>

#include "cad/solids.h"

namespace ombre::cad {

class FaceSurfaces {
 public:
  // Constructs the surfaces of the faces, in the order of triangles_of().
  explicit FaceSurfaces(const TopoDS_Shape& shape);

  // Returns the result of Query::side_of_face().
  std::optional<FaceSide> side(uint32_t face, Vec3 p, double least_radius_mm) const;

 private:
  struct Face {
    BRepAdaptor_Surface surface;
    bool is_turned;  // true if the surface's normal points into the solid
  };
  std::vector<Face> faces_;
};

}  // namespace ombre::cad
