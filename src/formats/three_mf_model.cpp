// The model files of a 3MF package (3MF Core 1.3; base materials and colour groups; the paths of Production 1.1).
#ifdef OMBRE_3MF

#include "formats/three_mf_model.h"

#include <algorithm>

#include "base/text.h"
#include "formats/text_scanner.h"
#include "formats/three_mf_extensions.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

struct Property {
  std::string material;
  std::optional<Rgba> colour;
};
using PropertyGroups = std::map<uint64_t, std::vector<Property>>;

xml_node child_of(xml_node node, std::string_view name) {
  for (const xml_node child : node.children())
    if (local_name(child) == name) return child;
  return {};
}

// Twelve numbers, column by column of our matrices: 3MF multiplies rows by matrices.
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
      : file_(file), part_(part), assembly_(assembly), further_(further) {}

  void read(xml_node resources) {
    for (const xml_node node : resources.children()) {
      const std::string_view kind = local_name(node);
      if (kind == "basematerials") read_properties(node, "base", "displaycolor");
      if (kind == "colorgroup") read_properties(node, "color", "color");
      if (kind == "texture2dgroup" || kind == "compositematerials" || kind == "multiproperties")
        mixtures_[id_of(node, "id")] = kind;
    }
    for (const xml_node node : resources.children())
      if (local_name(node) == "object") read_object(node);
  }

  Placement read_placement(xml_node node) {
    const uint64_t id = id_of(node, "objectid");
    const auto path = file_.attribute(node, "path");
    if (!path || path->empty()) return {object_key(part_, id), parse_transform(file_, node)};
    const std::string other(path->front() == '/' ? path->substr(1) : *path);
    further_.insert(other);
    return {object_key(other, id), parse_transform(file_, node)};
  }

 private:
  // Where a triangle's property stands: a group and an index in it.
  struct Source {
    std::optional<uint64_t> group, index;
    bool operator==(const Source&) const = default;
  };

  uint64_t id_of(xml_node node, std::string_view attribute) const {
    return file_.count(node, file_.required(node, attribute), "the number of an object or a resource");
  }

  void read_properties(xml_node node, std::string_view element, std::string_view colour) {
    std::vector<Property>& properties = properties_[id_of(node, "id")];
    for (const xml_node child : node.children()) {
      if (local_name(child) != element) continue;
      const auto text = file_.attribute(child, colour);
      properties.push_back({std::string(file_.attribute(child, "name").value_or("")), parse_colour(text.value_or(""))});
    }
  }

  void read_object(xml_node node) {
    const uint64_t id = id_of(node, "id");
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

  // Supports are not part of the solid, nor are meshes that only change settings where they are.
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

  // Cura keeps its settings of an object as metadata; older versions had an element of their own.
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
    const Source usual = source_of(object_node, "pindex", {});
    Source last;
    for (const xml_node triangle : child_of(mesh, "triangles").children()) {
      if (local_name(triangle) != "triangle") continue;
      const Source source = source_of_triangle(triangle, usual);
      if (object.mesh.groups.empty() || source != last) start_group(object.mesh, source, triangle);
      last = source;
      count_mixture(source);
      object.mesh.triangles.push_back(corners(triangle, object.mesh.vertices.size()));
      ++object.mesh.groups.back().triangle_count;
    }
  }

  void count_mixture(const Source& source) {
    const auto mixture = source.group ? mixtures_.find(*source.group) : mixtures_.end();
    if (mixture == mixtures_.end()) return;
    const std::string rest = " by <" + mixture->second + ">, which is not read";
    assembly_.warnings.add("a triangle has its material" + rest, "triangles have their materials" + rest);
  }

  Vec3 point(xml_node vertex) const {
    const auto coordinate = [&](const char* axis) {
      return file_.coordinate(vertex, file_.required(vertex, axis), "a coordinate of a vertex");
    };
    return {coordinate("x"), coordinate("y"), coordinate("z")};
  }

  std::array<uint32_t, 3> corners(xml_node triangle, size_t vertices) const {
    const auto corner = [&](const char* attribute) {
      const uint64_t index = file_.count(triangle, file_.required(triangle, attribute), "the number of a vertex");
      if (index >= vertices)
        file_.fail_at(triangle, "the triangle uses vertex " + std::to_string(index) + ", but the " +
                                    format_count(vertices) + " vertices of its object are numbered from 0");
      return static_cast<uint32_t>(index);
    };
    return {corner("v1"), corner("v2"), corner("v3")};
  }

  Source source_of(xml_node node, std::string_view index, Source usual) const {
    if (const auto group = file_.attribute(node, "pid"))
      usual.group = file_.count(node, *group, "the number of a resource");
    if (const auto text = file_.attribute(node, index))
      usual.index = file_.count(node, *text, "the number of a property");
    return usual;
  }

  // A triangle whose corners differ has none: there is no place for mixtures.
  Source source_of_triangle(xml_node triangle, const Source& usual) const {
    const Source source = source_of(triangle, "p1", usual);
    const auto first = file_.attribute(triangle, "p1");
    for (const char* corner : {"p2", "p3"})
      if (const auto other = file_.attribute(triangle, corner); other && other != first) return {};
    return source;
  }

  // Groups of other kinds (textures, mixtures) give neither a material nor a colour.
  void start_group(Mesh& mesh, const Source& source, xml_node triangle) const {
    mesh.groups.push_back({"", static_cast<uint32_t>(mesh.triangles.size()), 0});
    if (!source.group || !source.index) return;
    const auto found = properties_.find(*source.group);
    if (found == properties_.end()) return;
    if (*source.index >= found->second.size())
      file_.fail_at(triangle, "the triangle uses property " + std::to_string(*source.index) + " of resource " +
                                  std::to_string(*source.group) + ", which has " + format_count(found->second.size()) +
                                  " numbered from 0");
    const Property& property = found->second[*source.index];
    mesh.groups.back().material = property.material;
    mesh.groups.back().colour = property.colour;
  }

  const XmlFile& file_;
  const std::string& part_;
  Assembly& assembly_;
  std::set<std::string>& further_;
  PropertyGroups properties_;
  std::map<uint64_t, std::string> mixtures_;  // the kinds of resources that mix others
};

// Slicers' ways to give parts of a surface to other extruders.
void warn_of_paint(const XmlFile& file, CountedWarnings& warnings) {
  for (const std::string_view attribute : {" paint_color=\"", "mmu_segmentation=\""})
    for (size_t at = file.text().find(attribute); at != std::string_view::npos;
         at = file.text().find(attribute, at + attribute.size()))
      warnings.add("a triangle is painted with another extruder, which is not read",
                   "triangles are painted with other extruders, which is not read");
}

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
  warn_of_paint(file, assembly.warnings);
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
