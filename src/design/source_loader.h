// How nodes get at what lies in files: they ask, somebody else reads.
#pragma once

#include "design/values.h"
#include "program/field_source.h"

namespace ombre::design {

// What of a mesh file is meant, and which materials it gets.
struct MeshUse {
  std::string object;                         // the name of one of the file's objects; empty: all
  Choice inside;                              // "nonzero", "parity" or "generalized"
  Choice materials;                           // "one", "names" or "colours"
  MaterialName material;                      // of all, or of what has none in the file
  std::vector<MaterialForName> material_map;  // before the names in the table of materials
};

// The triangles of one material.
struct MeshPart {
  MaterialName material;
  program::SourceField source;  // with the channels "inside" and "distance"
};

class SourceLoader {
 public:
  virtual ~SourceLoader() = default;
  // A mesh by its materials, each once, in the order in which the file comes to them; with "one" a single part. `path`
  // is made relative to what was found. Nothing, and diagnostics, when it is missing, wrong or open.
  virtual std::vector<MeshPart> mesh(std::string& path, const MeshUse& use, const Reader& reader) = 0;
};

}  // namespace ombre::design
