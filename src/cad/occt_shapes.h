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

// Throws what the library throws.
SolidPtr make_solid(const NamedShape& named);

}  // namespace ombre::cad
