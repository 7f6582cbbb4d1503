// Solids from files.
#include <algorithm>

#include "base/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/all_nodes.h"
#include "nodes/mixtures.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Mesh {
  FilePath path;
  MaterialName material;
  Choice inside_rule = "nonzero";
  std::string object;
  Choice materials = "one";
  std::vector<MaterialForName> material_map;
  std::vector<MeshPart> parts;  // read when the node is made

  static Spec<Mesh> spec() {
    return {"mesh",
            "imported",
            "Solid bounded by the triangles of a file: STL, OBJ, PLY or OFF in mm, 3MF or AMF in their own unit.",
            {{"path", &Mesh::path, "The file; relative to the script, then to the working directory", required()},
             {"material", &Mesh::material, "Its material; beside the file's materials, that of what has none there"},
             {"inside", &Mesh::inside_rule,
              "What is inside: nonzero (winding number; overlapping shells stay solid), parity, or generalized (for "
              "open meshes)",
              one_of({"nonzero", "parity", "generalized"})},
             {"object", &Mesh::object, "The name of one of the file's objects; none: all of them"},
             {"materials", &Mesh::materials,
              "Whose materials: one (the node's), names (the file's, by their names), or colours (those whose colours "
              "are nearest to the file's); where they overlap, the file's first wins",
              one_of({"one", "names", "colours"})},
             {"material_map", &Mesh::material_map,
              "Materials for names of the file, before all others: [[\"PLA\", \"red\"], [\"TPU\", \"blue\"]]"}},
            no_inputs,
            "mesh(\"models/gear.stl\", \"red\");"};
  }

  bool complete(const Reader& reader) {
    const auto fail = [&](const std::string& message, const std::string& hint = "") {
      reader.diagnostics.error(reader.where, message, hint);
      return false;
    };
    if (!reader.loader) return fail("meshes cannot be read here");
    if (materials == "one" && !material_map.empty())
      return fail("material_map of mesh: the materials of the file are not asked for",
                  "write materials=\"names\" or materials=\"colours\" too");
    parts = reader.loader->mesh(path.path, {object, inside_rule, materials, material, material_map}, reader);
    if (parts.empty()) return false;
    path.content = content();
    return true;
  }

  // Walls between two parts are nearer than the surface of the whole.
  Metric metric() const { return parts.size() == 1 ? Metric::exact() : Metric::bounded(); }

  Box bounds(const Box&) const {
    Box box;
    for (const MeshPart& part : parts) box = hull(box, part.source->bounds());
    return box;
  }

  Field distance(const Point& p) const { return program::fold(distances(p), program::min); }
  // Along voxel rows this needs no distances.
  Field inside(const Inputs&, const Point& p) const { return program::fold(insides(p), program::logical_or); }
  Field interior(const Inputs& in, const Point& p) const { return inside(in, p); }

  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    if (parts.size() == 1) return Composition::pure(in.material(parts[0].material), p.constant(1));
    const std::vector<Field> shares = first_true(weights(p, demand));
    Composition result;
    for (size_t n = 0; n < parts.size(); ++n) result.fractions.emplace_back(in.material(parts[n].material), shares[n]);
    std::sort(result.fractions.begin(), result.fractions.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    return result;
  }

 private:
  Hash content() const {
    if (parts.size() == 1) return parts[0].source->content();
    std::string all;
    for (const MeshPart& part : parts) all += part.source->content().hex();
    return hash_bytes(all);
  }

  static Field read(const MeshPart& part, const char* channel, const Point& p) {
    const int number = part.source->channel(channel);
    ASSERT(number >= 0);
    return p.builder().source(part.source, number, p.x, p.y, p.z);
  }

  std::vector<Field> distances(const Point& p) const {
    std::vector<Field> fields;
    for (const MeshPart& part : parts) fields.push_back(read(part, "distance", p));
    return fields;
  }

  std::vector<Field> insides(const Point& p) const {
    std::vector<Field> fields;
    for (const MeshPart& part : parts) fields.push_back(truth(read(part, "inside", p)));
    return fields;
  }

  // Which parts count at a point; one at least does where it matters.
  std::vector<Field> weights(const Point& p, Demand demand) const {
    std::vector<Field> marks = insides(p);
    if (demand == Demand::inside) {
      marks.back() = p.constant(1);  // what is inside, and in none of the others
      return marks;
    }
    const Field none = logical_not(program::fold(marks, program::logical_or));
    const std::vector<Field> close = nearest(distances(p));
    for (size_t n = 0; n < marks.size(); ++n) marks[n] = logical_or(marks[n], logical_and(none, close[n]));
    return marks;
  }
};

}  // namespace

void add_imported(Registry& registry) { registry.add<Mesh>(); }

}  // namespace ombre::nodes
