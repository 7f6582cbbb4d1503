// The materials of a mesh file as materials of the design.
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
  std::string node;  // that reads it
  std::string path;
  Phrase remedy;  // where it names none: "use another"
};

// The design's material of each group. Nothing, and diagnostics, where the file says less of materials than `use` asks
// for, or names some that the design does not know.
std::optional<std::vector<const design::Material*>> find_materials(const GroupedFile& file,
                                                                   const std::vector<formats::MeshGroup>& groups,
                                                                   const design::MeshUse& use,
                                                                   const design::Reader& reader);

// Cuts a mesh by the design's materials, in the order in which its groups come to them. Nothing, and diagnostics,
// like above.
std::optional<std::vector<MaterialMesh>> by_material(const std::string& path, const formats::Mesh& mesh,
                                                     const design::MeshUse& use, const design::Reader& reader);

// What of a use decides the parts that a file gives, the design's materials included if they do.
void add_use(Key& key, const design::MeshUse& use, const design::Reader& reader);

// "the mesh", or "the script" for one that made it; for messages.
std::string kind_of(const std::string& path);

}  // namespace ombre::sources
