// The model files of a 3MF package (3MF Core 1.3; base materials and colour groups; the paths of Production 1.1).
#ifdef OMBRE_3MF

#include "formats/three_mf_model.h"

#include <algorithm>
#include <charconv>

#include "base/text.h"
#include "formats/text_scanner.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

struct Property {
  std::string material;
  std::optional<Rgba> colour;
};
using PropertyGroups = std::map<uint64_t, std::vector<Property>>;

// "#RRGGBB" or "#RRGGBBAA".
std::optional<Rgba> parse_colour(std::string_view text) {
  Rgba colour{0, 0, 0, 255};
  if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return std::nullopt;
  for (size_t i = 0; 2 * i + 1 < text.size(); ++i) {
    const char* const digits = text.data() + 1 + 2 * i;
    if (std::from_chars(digits, digits + 2, colour[i], 16).ptr != digits + 2) return std::nullopt;
  }
  return colour;
}

xml_node child_of(xml_node node, std::string_view name) {
  for (const xml_node child : node.children())
    if (local_name(child) == name) return child;
  return {};
}

// Takes the next word off the text; empty at the end.
std::string_view next_word(std::string_view& text) {
  constexpr std::string_view blanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
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
    // Supports are not part of the solid.
    if (file_.attribute(node, "type").value_or("model") != "support") {
      if (const xml_node mesh = child_of(node, "mesh")) read_mesh(mesh, node, object);
      for (const xml_node component : child_of(node, "components").children())
        if (local_name(component) == "component") object.components.push_back(read_placement(component));
    }
    if (!assembly_.objects.emplace(object_key(part_, id), std::move(object)).second)
      file_.fail_at(node, "there are two objects with the number " + std::to_string(id));
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
      object.mesh.triangles.push_back(corners(triangle, object.mesh.vertices.size()));
      ++object.mesh.groups.back().triangle_count;
    }
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

  // Where a triangle's property stands: a group and an index in it.
  struct Source {
    std::optional<uint64_t> group, index;
    bool operator==(const Source&) const = default;
  };

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

// Names the first extension whose absence changes the shape.
void warn_of_extensions(const XmlFile& file, xml_node model) {
  std::string_view prefixes = file.attribute(model, "requiredextensions").value_or("");
  for (std::string_view prefix = next_word(prefixes); !prefix.empty(); prefix = next_word(prefixes)) {
    const std::string_view space = model.attribute(("xmlns:" + std::string(prefix)).c_str()).value();
    const bool is_known =
        space.find("/material/") != std::string_view::npos || space.find("/production/") != std::string_view::npos;
    if (is_known) continue;
    file.diagnostics().warning({}, file.name() + ": what the 3MF extension " + quoted(prefix) + " adds is not read" +
                                       (space.empty() ? "" : ": " + quoted(space)));
    return;
  }
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
  for (const xml_node item : child_of(model, "build").children())
    if (local_name(item) == "item") assembly.build.push_back(reader.read_placement(item));
}

}  // namespace ombre::formats

#endif
