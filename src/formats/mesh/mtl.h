// Materials beside Wavefront OBJ files: their colours and images.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/diagnostic.h"
#include "formats/mesh/mesh.h"

namespace ombre::formats {

struct ObjMaterial {
  std::string name;
  std::array<float, 4> colour{1, 1, 1, 1};  // Kd, and d as alpha; taken as sRGB
  MeshImage image;                          // map_Kd, beside the file; without a name: none
};

// Reads .mtl: newmtl, Kd, d, Tr and map_Kd. Returns null, with diagnostics, if a statement of these is wrong.
std::optional<std::vector<ObjMaterial>> read_mtl(const std::string& name, std::string_view bytes,
                                                 Diagnostics& diagnostics);

// Returns the files of materials that an OBJ file names.
std::vector<std::string> material_libraries(std::string_view obj);

// Shades the triangles by their groups' materials; an image replaces the colour. Triangles of materials that are
// not among these are white. Throws DesignError if an image is used without texture coordinates.
void apply_materials(const std::string& name, const std::vector<ObjMaterial>& materials, Mesh& mesh,
                     Diagnostics& diagnostics);

}  // namespace ombre::formats
