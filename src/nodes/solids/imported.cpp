// Solids from files.
#include <algorithm>

#include "base/system/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/common/mixtures.h"
#include "nodes/common/node_polyhedra.h"
#include "nodes/common/part_label.h"

namespace ombre::nodes {
namespace {

using namespace design;

// The part of a file that has one material.
struct SolidPart {
  MaterialName material;
  program::SourceField source;
};
using Parts = std::vector<SolidPart>;

// Returns the material of a part, or `otherwise` for parts without a name.
MaterialName material_of(const std::string& name, const MaterialName& otherwise, const Reader& reader) {
  return name.empty() ? otherwise : MaterialName{reader.materials.find(name)};
}

// Returns false and adds a diagnostic if a mixture, which applies to the whole solid, is combined with the file's
// materials.
bool check_mixture(const MaterialName& material, const Choice& materials, const Reader& reader) {
  if (!material.mixture.node || materials == "one") return true;
  return reader.refuse(std::string(reader.node) +
                           " has a mixture, which is for the whole of it, and is asked for the materials of the file",
                       "leave out " + spelled::parameter("materials", '"' + std::string(materials.text()) + '"') +
                           ", or name one material for what has none in the file");
}

// Returns false and adds a diagnostic if materials are given for names that are not asked for.
bool check_map(const std::vector<MaterialForName>& material_map, const Choice& materials, const Reader& reader) {
  return !(materials == "one") || material_map.empty() ||
         reader.refuse("material_map of " + std::string(reader.node) + ": the materials of the file are not asked for",
                       "write " + spelled::parameter("materials", "\"names\"") + " or " +
                           spelled::parameter("materials", "\"colours\"") + " too");
}

// Returns the material for the request of a file. For a mixture it does not matter.
MaterialName material_for_request(const MaterialName& material, const Reader& reader) {
  return material.mixture.node ? MaterialName{&reader.materials.first()} : material;
}

Field read(const SolidPart& part, const char* channel, const Point& p) {
  const int number = part.source->channel(channel);
  ASSERT(number >= 0);
  return p.builder().source(part.source, number, p.x, p.y, p.z);
}

std::vector<Field> distances(const Parts& parts, const Point& p) {
  std::vector<Field> fields;
  for (const SolidPart& part : parts) fields.push_back(read(part, "distance", p));
  return fields;
}

std::vector<Field> insides(const Parts& parts, const Point& p) {
  std::vector<Field> fields;
  for (const SolidPart& part : parts) fields.push_back(truth(read(part, "inside", p)));
  return fields;
}

Field least_distance(const Parts& parts, const Point& p) { return program::fold(distances(parts, p), program::min); }
// Does not need distances, which makes it fast along rows of voxels.
Field inside_any(const Parts& parts, const Point& p) { return program::fold(insides(parts, p), program::logical_or); }

// Returns the parts that count at a point. At least one counts where it matters.
std::vector<Field> part_weights(const Parts& parts, const Point& p, Demand demand) {
  std::vector<Field> flags = insides(parts, p);
  if (demand == Demand::inside) {
    flags.back() = p.constant(1);  // points inside that belong to none of the other parts
    return flags;
  }
  const Field none = logical_not(program::fold(flags, program::logical_or));
  const std::vector<Field> close = nearest(distances(parts, p));
  for (size_t n = 0; n < flags.size(); ++n) flags[n] = logical_or(flags[n], logical_and(none, close[n]));
  return flags;
}

Composition composition_of(const Parts& parts, const Inputs& in, const Point& p, Demand demand) {
  if (parts.size() == 1) return in.composition_of(parts[0].material, p);
  const std::vector<Field> shares = first_true(part_weights(parts, p, demand));
  if (std::ranges::any_of(parts, [](const SolidPart& part) { return part.material.mixture.node; })) {
    std::vector<Composition> own;
    for (const SolidPart& part : parts) own.push_back(in.composition_of(part.material, p));
    return weighted(own, shares);
  }
  Composition result;
  for (size_t n = 0; n < parts.size(); ++n) result.fractions.emplace_back(in.material(parts[n].material), shares[n]);
  std::sort(result.fractions.begin(), result.fractions.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  return result;
}

// Returns a hash of all parts' sources.
template <class AnyParts>
Hash content_of(const AnyParts& parts) {
  if (parts.size() == 1) return parts[0].source->content();
  std::string all;
  for (const auto& part : parts) all += part.source->content().hex();
  return hash_bytes(all);
}

template <class AnyParts>
Box bounds_of(const AnyParts& parts) {
  Box box;
  for (const auto& part : parts) box = hull(box, part.source->bounds());
  return box;
}

// Returns the label of the first of several solids that contains the point; `names` are those of the solids.
Field label_of(const Parts& parts, const std::vector<std::string>& names, const std::vector<std::string>& labels,
               const Point& p, Demand demand) {
  const auto number = [&](const std::string& name) {
    const auto found = std::ranges::find(labels, name);
    return found == labels.end() ? 0.0 : static_cast<double>(found - labels.begin() + 1);
  };
  if (parts.size() < 2) return p.constant(number(names[0]));
  const std::vector<Field> shares = first_true(part_weights(parts, p, demand));
  Field label = p.constant(0);
  for (size_t n = 0; n < parts.size(); ++n) label = label + shares[n] * number(names[n]);
  return label;
}

// A solid whose parts are known when the node is made.
struct SolidOfParts {
  Parts parts;

  Box bounds(const Box&) const { return bounds_of(parts); }
  Field distance(const Point& p) const { return least_distance(parts, p); }
  Field membership(const Inputs&, const Point& p, Border) const { return inside_any(parts, p); }
  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    return composition_of(parts, in, p, demand);
  }
};

struct Mesh : SolidOfParts {
  FilePath path;
  MaterialName material;
  Choice inside_rule = "nonzero";
  std::string object;
  Choice materials = "one";
  std::vector<MaterialForName> material_map;
  double deform = 0;
  int step = 0;
  std::shared_ptr<const std::vector<MeshPart>> loaded;  // set when the node is made

  static Spec<Mesh> spec() {
    return {
        "mesh",
        "A solid bounded by the triangles of a file: STL, OBJ, PLY or OFF in mm, glTF, 3MF (with its beams) or AMF in "
        "their own unit; or by the outer sides of a mesh of results: VTU, PVD, PVTU, XDMF, FRD or INP.",
        {{"path", &Mesh::path, "The file; relative to the script, then to the working directory", required()},
         {"material", &Mesh::material, "Its material; with the file's materials, that of parts without one", mixable()},
         {"inside", &Mesh::inside_rule,
          "Rule for the inside: nonzero (winding number; overlapping shells stay solid), parity, or generalized (for "
          "open meshes)",
          one_of({"nonzero", "parity", "generalized"})},
         {"object", &Mesh::object, "Name of one of the file's objects; none: all of them"},
         {"materials", &Mesh::materials,
          "Materials: one (the node's), names (by the names in the file), or colours (those nearest to the file's "
          "colours); where parts overlap, the first one in the file wins",
          one_of({"one", "names", "colours"})},
         {"material_map", &Mesh::material_map,
          "Materials for names in the file, which come before all others: [[\"PLA\", \"red\"], [\"TPU\", \"blue\"]]"},
         {"deform", &Mesh::deform, "Factor of the displacement by which a mesh of results is deformed"},
         {"step", &Mesh::step, "Number of a step of results, counted from 1; 0: the last", from_to(0, 1e9)}},
        no_inputs,
        "mesh(\"models/gear.stl\", \"red\");"};
  }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("meshes cannot be read here");
    if (!check_map(material_map, materials, reader) || !check_mixture(material, materials, reader)) return false;
    const MaterialName named = material_for_request(material, reader);
    MeshRequest request{path, {object, inside_rule, materials, named, material_map}, deform, step};
    loaded = reader.loader->source(request, reader);
    if (!loaded) return false;
    path.path = request.file.path;
    for (const MeshPart& part : *loaded) parts.push_back({material_of(part.material, material, reader), part.source});
    path.content = content_of(parts);
    return true;
  }

  // Walls between two parts may be nearer than the surface of the whole.
  Metric metric() const { return parts.size() == 1 && loaded->front().is_exact ? Metric::exact() : Metric::bounded(); }
};

struct Scad : SolidOfParts {
  FilePath path;
  std::string script;
  MaterialName material;
  std::string part;
  Choice materials = "auto";
  std::vector<MaterialForName> material_map;
  ScriptVariables variables;
  std::shared_ptr<const ScadSolids> loaded;      // set when the node is made
  std::vector<const Material*> piece_materials;  // one for each of its exact solids; null for a mixture

  static Spec<Scad> spec() {
    return {
        "scad",
        "A solid that an OpenSCAD script makes, in mm. Arguments with other names are values for the script's "
        "variables.",
        {{"path", &Scad::path, "The script; relative to this one, then to the working directory", required()},
         {"material", &Scad::material,
          "Its material; with the script's materials, that of parts without one. A mixture applies to the whole solid",
          mixable()},
         {"part", &Scad::part, "Name of one of the script's parts; rest: solids outside parts; none: everything"},
         {"materials", &Scad::materials,
          "Materials: one (the node's), names (those of material() in the script), colours (those nearest to the "
          "script's colours), or auto (names if the script has some, else colours, else one); where solids overlap, "
          "the first one in the script wins",
          one_of({"auto", "one", "names", "colours"})},
         {"material_map", &Scad::material_map,
          "Materials for names in the script, which come before all others: [[\"PLA\", \"red\"], [\"TPU\", \"blue\"]]"},
         {"variables", &Scad::variables, "Values for the script's variables: scad(\"box.scad\", width=20)"},
         {"script", &Scad::script,
          "The script's text in place of the file's; path then determines where its files are sought"}},
        no_inputs,
        "scad(\"openscad/handle.scad\", thickness=6);"};
  }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("OpenSCAD scripts cannot be run here");
    if (material.mixture.node && materials == "auto") materials = "one";
    if (!check_mixture(material, materials, reader)) return false;
    ScadRequest request{path, script, variables, part, materials, material_for_request(material, reader), material_map};
    loaded = reader.loader->source(request, reader);
    if (!loaded) return false;
    if (loaded->parts.empty()) return reader.refuse("the script makes no solid");
    path.path = request.file.path;
    for (const MeshPart& one : loaded->parts)
      parts.push_back({material_of(one.material, material, reader), one.source});
    path.content = content_of(parts);
    for (const std::string& one : loaded->piece_materials)
      piece_materials.push_back(material_of(one, material, reader).material);
    return true;
  }

  // Returns the names of bodies, which are labels.
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const ScadBody& body : loaded->bodies) all.push_back(body.name);
    return all;
  }

  std::optional<AttributeDeclaration> declares() const {
    AttributeDeclaration declared{std::string(label_name), "", 0, Overlap::first};
    declared.type = ValueType::label;
    declared.labels = names();
    std::erase(declared.labels, "");
    return declared.labels.empty() ? std::nullopt : std::optional(std::move(declared));
  }

  Field attribute(const Inputs& in, std::string_view wanted, const Point& p, Demand demand) const {
    ASSERT(wanted == label_name);
    Parts bodies;
    for (const ScadBody& body : loaded->bodies) bodies.push_back({material, body.source});
    return label_of(bodies, names(), in.declaration(label_name).labels, p, demand);
  }

  // Walls between two parts may be nearer than the surface of the whole.
  Metric metric() const { return parts.size() == 1 ? Metric::exact() : Metric::bounded(); }
};

struct Cad {
  FilePath path;
  MaterialName material;
  Choice mode = "fast";
  double tolerance = 0;
  std::string object;
  Choice materials = "one";
  std::vector<MaterialForName> material_map;
  std::shared_ptr<const std::vector<CadPart>> parts;  // read when the node is made
  std::vector<MaterialName> part_materials;

  static Spec<Cad> spec() {
    return {
        "cad",
        "A solid from a CAD file: STEP or IGES, in the file's own unit.",
        {{"path", &Cad::path, "The file; relative to the script, then to the working directory", required()},
         {"material", &Cad::material, "Its material; with the file's materials, that of parts without one", mixable()},
         {"mode", &Cad::mode,
          "fast (uses triangles) or exact (uses the surfaces themselves: slow, with exact distances)",
          one_of({"fast", "exact"})},
         {"tolerance", &Cad::tolerance, "Greatest distance of triangles from the surface; 0: a quarter of a voxel",
          unit::not_negative_mm},
         {"object", &Cad::object, "Name of one of the file's solids; none: all of them"},
         {"materials", &Cad::materials,
          "Materials: one (the node's), names (by the names of the file's solids), or colours (those nearest to the "
          "solids' colours); where solids overlap, the first one in the file wins",
          one_of({"one", "names", "colours"})},
         {"material_map", &Cad::material_map,
          "Materials for names of solids, which come before all others: [[\"bracket\", \"gray\"], [\"bushing\", "
          "\"red\"]]"}},
        no_inputs,
        "cad(\"models/bracket.step\", \"gray\");"};
  }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("CAD files cannot be read here");
    if (!check_map(material_map, materials, reader) || !check_mixture(material, materials, reader)) return false;
    const MaterialName named = material_for_request(material, reader);
    CadRequest request{path, {object, "nonzero", materials, named, material_map}, mode == "exact", tolerance};
    parts = reader.loader->source(request, reader);
    if (!parts) return false;
    for (const CadPart& part : *parts) part_materials.push_back(material_of(part.material, material, reader));
    path.path = request.file.path;
    path.content = content_of(*parts);
    return true;
  }

  // Walls between two solids may be nearer than the surface of the whole.
  Metric metric() const { return parts->size() == 1 && parts->front().is_single ? Metric::exact() : Metric::bounded(); }
  Box bounds(const Box&) const { return bounds_of(*parts); }
  Field distance(const Inputs& in, const Point& p) const { return least_distance(made(in), p); }
  Field membership(const Inputs& in, const Point& p, Border) const { return inside_any(made(in), p); }
  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    return composition_of(made(in), in, p, demand);
  }

 private:
  Parts made(const Inputs& in) const {
    Parts sources;
    for (size_t n = 0; n < parts->size(); ++n) {
      const CadPart& part = (*parts)[n];
      sources.push_back({part_materials[n], part.source->make(in.scale())});
      for (const Remark& r : part.source->remarks(in.scale())) in.report(r.severity, r.message, r.hint);
    }
    return sources;
  }
};

}  // namespace

std::optional<Polyhedra> polyhedra_of(const design::Node& node) {
  const auto* scad = dynamic_cast<const NodeOf<Scad>*>(&node);
  if (!scad || scad->data.material.mixture.node || !scad->data.loaded->pieces) return std::nullopt;
  return Polyhedra{scad->data.loaded->pieces, scad->data.loaded->piece_names, scad->data.piece_materials};
}

void add_imported(Registry& registry) { registry.add<Mesh, Scad, Cad>("imported"); }

}  // namespace ombre::nodes
