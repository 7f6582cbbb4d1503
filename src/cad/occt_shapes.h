// Shapes of Open CASCADE. Only for this folder: it includes the library's headers.
#pragma once

#include <TopoDS_Shape.hxx>

#include <string>
#include <vector>

#include "cad/solids.h"

namespace ombre::cad {

// A solid as a file has it.
struct NamedShape {
  std::string name;
  std::optional<std::array<uint8_t, 4>> colour;
  TopoDS_Shape shape;
};

// Throws Error, and what the library throws.
std::vector<NamedShape> read_shapes(const std::string& path);

// A solid whose faces look outward, and how large it is.
struct MeasuredShape {
  NamedShape named;
  double volume_mm3 = 0;
  Box bounds;
};

// Throws what the library throws.
MeasuredShape measured(NamedShape named);

// Shapes as bytes, for this version of the library and this kind of machine. Parts that shapes share stay shared.
std::string pack_shapes(const std::vector<MeasuredShape>& shapes);
std::vector<MeasuredShape> unpack_shapes(const std::string& bytes);

// Throws what the library throws.
SolidPtr make_solid(const MeasuredShape& shape);

}  // namespace ombre::cad
