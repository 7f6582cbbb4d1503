// Solids from files.
#include "base/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/all_nodes.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Mesh {
  FilePath path;
  MaterialName material;
  Choice inside_rule = "nonzero";
  std::string object;
  program::SourceField source;  // read when the node is made

  static Spec<Mesh> spec() {
    return {"mesh",
            "imported",
            "Solid bounded by the triangles of a file: STL, OBJ, PLY or OFF in mm, 3MF or AMF in their own unit.",
            {{"path", &Mesh::path, "The file; relative to the script, then to the working directory", required()},
             {"material", &Mesh::material, "Its material"},
             {"inside", &Mesh::inside_rule,
              "What is inside: nonzero (winding number; overlapping shells stay solid), parity, or generalized (for "
              "open meshes)",
              one_of({"nonzero", "parity", "generalized"})},
             {"object", &Mesh::object, "The name of one of the file's objects; none: all of them"}},
            no_inputs,
            "mesh(\"models/gear.stl\", \"red\");"};
  }

  bool complete(const Reader& reader) {
    if (!reader.loader) {
      reader.diagnostics.error(reader.where, "meshes cannot be read here");
      return false;
    }
    source = reader.loader->mesh(path.path, object, std::string(inside_rule.text()), reader.where, reader.diagnostics);
    if (!source) return false;
    path.content = source->content();
    return true;
  }

  Box bounds(const Box&) const { return source->bounds(); }

  Field read(const char* channel, const Point& p) const {
    const int number = source->channel(channel);
    ASSERT(number >= 0);
    return p.builder().source(source, number, p.x, p.y, p.z);
  }

  Field distance(const Point& p) const { return read("distance", p); }
  // Along voxel rows this needs no distances.
  Field inside(const Inputs&, const Point& p) const { return truth(read("inside", p)); }
  Field interior(const Inputs&, const Point& p) const { return truth(read("inside", p)); }
};

}  // namespace

void add_imported(Registry& registry) { registry.add<Mesh>(); }

}  // namespace ombre::nodes
