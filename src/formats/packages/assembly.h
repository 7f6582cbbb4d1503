// Objects composed of meshes and of placed other objects, as in 3MF and AMF files.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/containers/counted_warnings.h"
#include "formats/mesh/mesh.h"

namespace ombre::formats {

struct Placement {
  std::string object;         // key in the assembly
  Affine parent_from_object;  // invertible
};

struct AssemblyObject {
  std::string name;
  Mesh mesh;  // groups may lack names; there are no triangles in objects that only contain others
  std::vector<Placement> components;
  std::string no_solid = {};  // what the object is instead of a solid, if its use deserves a warning
};

struct Assembly {
  double mm_per_unit = 1;
  std::map<std::string, AssemblyObject> objects;
  std::vector<Placement> build;        // the objects to build
  std::vector<MeshImage> images = {};  // of the objects' shadings
  CountedWarnings warnings;            // about contents that the reader left out
};

// Returns the shading of the triangles of a group that have nothing but its colour.
TriangleShading shading_of(const MeshGroup& group);

// Returns the number of millimetres in a unit of these formats, or null for an unknown name.
std::optional<double> mm_per_unit(std::string_view unit);

// Returns everything that is built, in mm, and warns of contents that were left out. Objects that contain themselves,
// excessive repetition, and files without triangles are reported, and DesignError is thrown.
Mesh assemble(const Assembly& assembly, const std::string& file, Diagnostics& diagnostics);

}  // namespace ombre::formats
