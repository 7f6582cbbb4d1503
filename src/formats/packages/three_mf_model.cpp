// Reads the model files of a 3MF package (3MF Core 1.3; base materials and colour groups; the paths of Production 1.1).
#ifdef OMBRE_3MF

#include "formats/packages/three_mf_model.h"

#include <algorithm>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/packages/three_mf_beams.h"
#include "formats/packages/three_mf_extensions.h"
#include "formats/packages/three_mf_resources.h"
#include "formats/slicers/painting.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

// Parses twelve numbers, column by column of our matrices: 3MF multiplies row vectors by matrices.
Affine parse_transform(const XmlFile& file, xml_node node) {
  auto text = file.attribute(node, "transform");
  if (!text) return {};
  std::array<double, 12> m{};
  size_t count = 0;
  for (std::string_view word = next_word(*text); !word.empty(); word = next_word(*text), ++count)
    if (count < m.size()) m[count] = file.number(node, word, "a number of a transform");
  if (count != m.size()) file.fail_at(node, "a transform has 12 numbers, this one has " + std::to_string(count));
  const Affine map{{Vec3{m[0], m[3], m[6]}, Vec3{m[1], m[4], m[7]}, Vec3{m[2], m[5], m[8]}}, {m[9], m[10], m[11]}};
  if (determinant(map) == 0) file.fail_at(node, "a transform squeezes its object flat: its determinant is 0");
  return map;
}

class ObjectReader {
 public:
  ObjectReader(const XmlFile& file, const std::string& part, Assembly& assembly, std::set<std::string>& further)
      : file_(file), part_(part), assembly_(assembly), further_(further), properties_(file) {}

  void read(xml_node resources) {
    properties_.read(resources);
    for (const xml_node node : resources.children())
      if (local_name(node) == "object") read_object(node);
  }

  Placement read_placement(xml_node node) {
    const uint64_t id = resource_id(file_, node, "objectid");
    const auto path = file_.attribute(node, "path");
    if (!path || path->empty()) return {object_key(part_, id), parse_transform(file_, node)};
    const std::string other(path->front() == '/' ? path->substr(1) : *path);
    further_.insert(other);
    return {object_key(other, id), parse_transform(file_, node)};
  }

 private:
  void read_object(xml_node node) {
    const uint64_t id = resource_id(file_, node, "id");
    AssemblyObject object;
    object.name = file_.attribute(node, "name").value_or("");
    if (object.name.empty()) object.name = "object " + std::to_string(id);
    if (is_solid(node, object)) {
      if (const xml_node mesh = child_of(node, "mesh")) read_mesh(mesh, node, object);
      for (const xml_node component : child_of(node, "components").children())
        if (local_name(component) == "component") object.components.push_back(read_placement(component));
    }
    if (!assembly_.objects.emplace(object_key(part_, id), std::move(object)).second)
      file_.fail_at(node, "there are two objects with the number " + std::to_string(id));
  }

  // Returns false for supports, and for meshes that only change settings in their region.
  bool is_solid(xml_node node, AssemblyObject& object) const {
    const std::string_view type = file_.attribute(node, "type").value_or("model");
    const bool is_model = type.empty() || type == "model";
    if (!is_model && type != "support" && type != "solidsupport")
      object.no_solid = "of type " + quoted(type);
    else if (has_cura_mark(node, "cutting_mesh"))
      object.no_solid = "that Cura cuts others by";
    return is_model && object.no_solid.empty() && !has_cura_mark(node, "support_mesh") &&
           !has_cura_mark(node, "anti_overhang_mesh") && !has_cura_mark(node, "infill_mesh");
  }

  // Returns true if Cura marked the object: in its metadata, or in a separate element of older versions.
  bool has_cura_mark(xml_node node, std::string_view key) const {
    const auto is_set = [&](xml_node list, std::string_view element, std::string_view attribute) {
      for (const xml_node child : list.children())
        if (local_name(child) == element && local_name(child.attribute(std::string(attribute).c_str()).value()) == key)
          return to_lower(trim(child.text().get())) == "true" || trim(child.text().get()) == "1";
      return false;
    };
    return is_set(child_of(node, "metadatagroup"), "metadata", "name") ||
           is_set(child_of(node, "settings"), "setting", "key");
  }

  void read_mesh(xml_node mesh, xml_node object_node, AssemblyObject& object) {
    for (const xml_node vertex : child_of(mesh, "vertices").children()) object.mesh.vertices.push_back(point(vertex));
    const PropertyReference usual = properties_.reference(object_node, "pindex", {});
    PropertyReference last;
    uint32_t last_painted = 0;
    for (const xml_node triangle : child_of(mesh, "triangles").children()) {
      if (local_name(triangle) != "triangle") continue;
      const PropertyReference property = properties_.reference(triangle, {"p1", "p2", "p3"}, usual);
      const uint32_t painted = painted_extruder(triangle);
      if (object.mesh.groups.empty() || property != last || painted != last_painted)
        start_group(object.mesh, property, triangle, painted);
      last = property;
      last_painted = painted;
      count_mixture(property);
      add_shading(triangle, usual, object.mesh);
      object.mesh.triangles.push_back(corners(triangle, object.mesh.vertices.size()));
      ++object.mesh.groups.back().triangle_count;
    }
    if (const xml_node lattice = child_of(mesh, "beamlattice"))
      add_lattices(
          file_, lattice, properties_, usual, [&](xml_node user, uint64_t id) { return clip(user, id); },
          assembly_.warnings, object.mesh);
  }

  // Returns the mesh that clips a lattice: that of an object before the lattice's own.
  std::shared_ptr<const Mesh> clip(xml_node user, uint64_t id) {
    std::shared_ptr<const Mesh>& known = clips_[id];
    if (known) return known;
    const auto found = assembly_.objects.find(object_key(part_, id));
    if (found == assembly_.objects.end() || found->second.mesh.triangles.empty())
      file_.fail_at(user, "the clippingmesh " + std::to_string(id) + " is no object with triangles before this one");
    return known = std::make_shared<Mesh>(found->second.mesh);
  }

  void count_mixture(const PropertyReference& property) {
    const std::string mixture = properties_.mixture(property);
    if (mixture.empty()) return;
    const std::string rest = " by <" + mixture + ">, which is not read";
    assembly_.warnings.add("a triangle has its material" + rest, "triangles have their materials" + rest);
  }

  // Adds the shading of the next triangle, if it or one before it has more than the colour of its group.
  void add_shading(xml_node triangle, const PropertyReference& usual, Mesh& mesh) const {
    auto shading = properties_.shading(triangle, usual);
    if (!shading && mesh.shadings.empty()) return;
    for (const MeshGroup& group : mesh.groups)
      for (size_t n = mesh.shadings.size(); n < group.first_triangle + group.triangle_count; ++n)
        mesh.shadings.push_back(shading_of(group));
    if (!shading) shading = shading_of(mesh.groups.back());
    if (shading->image >= 0) shading->image = add_image(properties_.images()[static_cast<size_t>(shading->image)]);
    mesh.shadings.push_back(*shading);
  }

  // Returns the number of an image among those of the package.
  int32_t add_image(const MeshImage& image) const {
    const auto known = std::ranges::find(assembly_.images, image);
    if (known == assembly_.images.end()) {
      assembly_.images.push_back(image);
      return static_cast<int32_t>(assembly_.images.size() - 1);
    }
    return static_cast<int32_t>(known - assembly_.images.begin());
  }

  Vec3 point(xml_node vertex) const {
    const auto coordinate = [&](const char* axis) {
      return file_.coordinate(vertex, file_.required(vertex, axis), "a coordinate of a vertex");
    };
    return {coordinate("x"), coordinate("y"), coordinate("z")};
  }

  std::array<uint32_t, 3> corners(xml_node triangle, size_t vertices) const {
    return {vertex_number(file_, triangle, "v1", vertices), vertex_number(file_, triangle, "v2", vertices),
            vertex_number(file_, triangle, "v3", vertices)};
  }

  // Returns the extruder that a triangle is painted with; 0 for none. A triangle that is painted in parts has the
  // extruder of its largest part.
  uint32_t painted_extruder(xml_node triangle) {
    auto code = file_.attribute(triangle, "mmu_segmentation");
    if (!code) code = file_.attribute(triangle, "paint_color");
    if (!code || code->empty()) return 0;
    const auto paint = read_paint(*code);
    if (!paint) {
      assembly_.warnings.add("a triangle has a paint that is not understood, and counts as unpainted",
                             "triangles have a paint that is not understood, and count as unpainted");
      return 0;
    }
    if (paint->is_divided)
      assembly_.warnings.add("a triangle is painted in parts; all of it has the extruder of its largest part",
                             "triangles are painted in parts; all of each has the extruder of its largest part");
    return paint->extruder;
  }

  void start_group(Mesh& mesh, const PropertyReference& property, xml_node triangle, uint32_t painted) const {
    mesh.groups.push_back({"", static_cast<uint32_t>(mesh.triangles.size()), 0});
    mesh.groups.back().painted = painted;
    properties_.describe(property, triangle, mesh.groups.back());
  }

  const XmlFile& file_;
  const std::string& part_;
  Assembly& assembly_;
  std::set<std::string>& further_;
  PropertyTable properties_;
  std::map<uint64_t, std::shared_ptr<const Mesh>> clips_;
};

void read_unit(const XmlFile& file, xml_node model, Assembly& assembly) {
  const auto unit = file.attribute(model, "unit");
  if (!unit) return;
  const auto mm = mm_per_unit(*unit);
  if (!mm)
    file.fail_at(model, "there is no unit " + quoted(*unit),
                 "it can be micron, millimeter, centimeter, inch, foot or meter");
  assembly.mm_per_unit = *mm;
}

}  // namespace

std::string object_key(std::string_view part, uint64_t id) { return std::to_string(id) + " of " + std::string(part); }

std::string id_of_key(const std::string& key) { return key.substr(0, key.find(' ')); }

void add_objects(const XmlFile& file, const std::string& part, Assembly& assembly, std::set<std::string>& further) {
  const xml_node model = file.root("model");
  warn_of_extensions(file, model);
  ObjectReader(file, part, assembly, further).read(child_of(model, "resources"));
}

void add_build(const XmlFile& file, const std::string& part, Assembly& assembly, std::set<std::string>& further) {
  const xml_node model = file.root("model");
  read_unit(file, model, assembly);
  ObjectReader reader(file, part, assembly, further);
  size_t number = 0;
  for (const xml_node item : child_of(model, "build").children()) {
    if (local_name(item) != "item") continue;
    ++number;
    const std::string_view printable = file.attribute(item, "printable").value_or("1");
    if (printable != "0" && printable != "false")
      assembly.build.push_back(reader.read_placement(item));
    else
      assembly.warnings.add(
          "item " + std::to_string(number) + " of the build is marked printable=\"0\" and is left out",
          "items of the build are marked printable=\"0\" and are left out");
  }
}

}  // namespace ombre::formats

#endif
