// Objects that consist of meshes and of other objects in place, as 3MF and AMF files have them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/containers/counted_warnings.h"
#include "formats/mesh/mesh.h"

namespace ombre::formats {

struct Placement {
  std::string object;         // its key in the assembly
  Affine parent_from_object;  // with an inverse
};

struct AssemblyObject {
  std::string name;
  Mesh mesh;  // its groups may lack names; no triangles in objects that only hold others
  std::vector<Placement> components;
  std::string no_solid = {};  // what it is in place of a solid, where that is worth a warning if it is used
};

struct Assembly {
  double mm_per_unit = 1;
  std::map<std::string, AssemblyObject> objects;
  std::vector<Placement> build;  // what the file is about
  CountedWarnings warnings;      // of what the reader left out
};

// Millimetres in a unit by its name in these formats; nothing for another word.
std::optional<double> mm_per_unit(std::string_view unit);

// Everything that is built, in mm. What was left out is warned of. Files that hold themselves, or repeat an object
// beyond all use, are reported, as are those without triangles; that ends the reading by DesignError.
Mesh assemble(const Assembly& assembly, const std::string& file, Diagnostics& diagnostics);

}  // namespace ombre::formats
