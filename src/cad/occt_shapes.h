// Shapes of Open CASCADE. Only for this folder, because it includes the library's headers.
#pragma once

#include <TopoDS_Shape.hxx>

#include <string>
#include <vector>

#include "cad/solids.h"

namespace ombre::cad {

// A solid as stored in a file.
struct NamedShape {
  std::string name;
  std::optional<std::array<uint8_t, 4>> colour;
  TopoDS_Shape shape;
  std::string unit = {};  // the file's unit of lengths, which the reader converts to mm
};

// Reads the shapes of a file. Throws Error, and exceptions of the library.
std::vector<NamedShape> read_shapes(const std::string& path);

// A solid whose faces are oriented outward, with its size.
struct MeasuredShape {
  NamedShape named;
  double volume_mm3 = 0;
  Box bounds;
};

// Orients and measures a solid. Throws exceptions of the library.
MeasuredShape measured(NamedShape named);

// Serializes shapes for this version of the library and this kind of machine. Parts shared between shapes stay shared.
std::string pack_shapes(const std::vector<MeasuredShape>& shapes);
std::vector<MeasuredShape> unpack_shapes(const std::string& bytes);

// Returns a solid that answers queries. Throws exceptions of the library.
SolidPtr make_solid(const MeasuredShape& shape);

}  // namespace ombre::cad
