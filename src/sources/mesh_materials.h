// Maps the materials of a mesh file to materials of the design.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/source_loader.h"
#include "formats/mesh/mesh.h"
#include "sources/loading.h"

namespace ombre::sources {

// The triangles of one material.
struct MaterialMesh {
  design::MaterialName material;
  formats::Mesh mesh;
};

// A file with named or coloured groups, for messages.
struct GroupedFile {
  std::string kind;  // "the mesh"
  std::string node;  // name of the node that reads it
  std::string path;
  Phrase remedy;  // what to do if it names none, such as "use another"
};

// Returns the design's material of each group. Null, with diagnostics, if the file has less information on materials
// than `use` requires, or names materials that the design does not have.
std::optional<std::vector<const design::Material*>> find_materials(const GroupedFile& file,
                                                                   const std::vector<formats::MeshGroup>& groups,
                                                                   const design::MeshUse& use,
                                                                   const design::Reader& reader);

// Divides a mesh by the design's materials, in the order in which they first occur. Null, with diagnostics, as above.
std::optional<std::vector<MaterialMesh>> by_material(const std::string& path, const formats::Mesh& mesh,
                                                     const design::MeshUse& use, const design::Reader& reader);

// Returns true if this name in a material map means a body with this material and colour: it is the material's name, or
// the colour, as #rrggbb or by its name in CSS.
bool means(const std::string& name, const std::string& material, const std::optional<design::Rgba>& colour);

// Returns true if the file is an OpenSCAD script that is the design, not one that the design calls.
bool is_design_itself(const std::string& path, const design::Reader& reader);

// Adds the options of a use that determine the parts of a file, including the design's materials if they matter.
void add_use(Key& key, const design::MeshUse& use, const design::Reader& reader);

// Returns "the mesh", or "the script" if the file is one; for messages.
std::string kind_of(const std::string& path);

}  // namespace ombre::sources
