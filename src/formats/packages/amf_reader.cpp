// Reads AMF (ISO/ASTM 52915), as text or zipped: objects with volumes, materials, constellations.
#ifdef OMBRE_3MF

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/containers/xml_file.h"
#include "formats/containers/zip_archive.h"
#include "formats/packages/assembly.h"
#include "formats/packages/extruder_colours.h"
#include "formats/packages/package_readers.h"
#include "formats/packages/slicer_volumes.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

struct Material {
  std::string name;
  std::optional<Rgba> colour;
};

std::string metadata_of(xml_node node, std::string_view type) {
  for (const xml_node child : node.children("metadata"))
    if (child.attribute("type").value() == type) return child.text().get();
  return "";
}

std::string name_of(xml_node node) { return metadata_of(node, "name"); }

// Returns true if angles are in radians: Slic3r and slicers derived from it write them so, contrary to the standard.
bool has_radians(xml_node amf) {
  const std::string program = to_lower(metadata_of(amf, "cad"));
  for (const char* name : {"slic3r", "prusaslicer", "superslicer"})
    if (program.find(name) != std::string::npos) return true;
  return !metadata_of(amf, "slic3rpe_amf_version").empty();
}

// Converts radians to degrees. Quarter turns are restored exactly, because the files have only six digits of an
// irrational number.
double degrees_of_radians(double radians) {
  constexpr double written_exactly = 1e-6, quarter = std::numbers::pi / 2;
  const double quarters = std::round(radians / quarter);
  if (std::abs(radians - quarters * quarter) <= written_exactly) return 90 * quarters;
  return radians * 180 / std::numbers::pi;
}

// Elements that are read, or that do not affect shapes and materials.
constexpr std::string_view of_amf[]{"object", "material", "constellation", "metadata", "texture"};
constexpr std::string_view of_material[]{"metadata", "color"};
constexpr std::string_view of_object[]{"metadata", "color", "mesh", "layer_config_ranges"};
constexpr std::string_view of_mesh[]{"vertices", "volume"};
constexpr std::string_view of_vertices[]{"vertex"};
constexpr std::string_view of_vertex[]{"coordinates", "color", "metadata"};
constexpr std::string_view of_volume[]{"metadata", "color", "triangle"};
constexpr std::string_view of_triangle[]{"v1", "v2", "v3", "texmap", "map"};
constexpr std::string_view of_constellation[]{"instance", "metadata"};
constexpr std::string_view of_instance[]{"deltax", "deltay", "deltaz", "rx",      "ry",      "rz",      "scale",
                                         "scalex", "scaley", "scalez", "mirrorx", "mirrory", "mirrorz", "printable"};

// Returns the colour of an element. Colours given by formulas of the position are not supported.
std::optional<Rgba> colour_of(xml_node node) {
  const xml_node colour = node.child("color");
  if (!colour) return std::nullopt;
  Rgba parts{0, 0, 0, 255};
  const char* const names[]{"r", "g", "b", "a"};
  for (size_t i = 0; i < parts.size(); ++i) {
    const xml_node part = colour.child(names[i]);
    if (!part && i == 3) continue;
    const auto value = parse_number(trim(part.text().get()));
    if (!value) return std::nullopt;
    parts[i] = static_cast<uint8_t>(std::lround(255 * std::clamp(*value, 0.0, 1.0)));
  }
  return parts;
}

class AmfReader {
 public:
  AmfReader(const XmlFile& file, Assembly& assembly) : file_(file), assembly_(assembly) {}

  void read() {
    const xml_node amf = file_.root("amf");
    read_unit(amf);
    has_radians_ = has_radians(amf);
    extruders_ = ExtruderColours::of_prusa(metadata_of(amf, "slic3rpe_config"));
    warn_of_others(amf, of_amf);
    for (const xml_node material : amf.children("material")) {
      warn_of_others(material, of_material);
      materials_[material.attribute("id").value()] = {name_of(material), colour_of(material)};
    }
    for (const xml_node object : amf.children("object")) add(object, read_object(object));
    for (const xml_node constellation : amf.children("constellation"))
      add(constellation, read_instances(constellation));
    // Objects outside of all constellations are built by themselves.
    for (const auto& [id, object] : assembly_.objects)
      if (!placed_.contains(id)) assembly_.build.push_back({id, {}});
  }

 private:
  void read_unit(xml_node amf) {
    const auto unit = file_.attribute(amf, "unit");
    if (!unit) return;
    const auto mm = mm_per_unit(*unit);
    if (!mm)
      file_.fail_at(amf, "there is no unit " + quoted(*unit), "it can be millimeter, inch, feet, meter or micron");
    assembly_.mm_per_unit = *mm;
  }

  // Warns of children that are not in the list.
  void warn_of_others(xml_node node, std::span<const std::string_view> known) {
    for (const xml_node child : node.children()) {
      const std::string_view name = child.name();
      if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) continue;
      const std::string element = '<' + std::string(name) + "> of <" + node.name() + '>';
      assembly_.warnings.add("an element " + element + " is not read", "elements " + element + " are not read");
    }
  }

  void add(xml_node node, AssemblyObject object) {
    const std::string id(file_.required(node, "id"));
    if (!assembly_.objects.emplace(id, std::move(object)).second)
      file_.fail_at(node, "there are two objects with the id " + formats::quoted(id));
  }

  AssemblyObject read_object(xml_node node) {
    AssemblyObject object;
    object.name = name_of(node);
    if (object.name.empty()) object.name = "object " + std::string(file_.required(node, "id"));
    const xml_node mesh = node.child("mesh");
    warn_of_others(node, of_object);
    warn_of_others(mesh, of_mesh);
    warn_of_others(mesh.child("vertices"), of_vertices);
    for (const xml_node vertex : mesh.child("vertices").children("vertex"))
      object.mesh.vertices.push_back(point(vertex));
    for (const xml_node volume : mesh.children("volume")) read_volume(volume, colour_of(node), object.mesh);
    return object;
  }

  Vec3 point(xml_node vertex) {
    warn_of_others(vertex, of_vertex);
    const xml_node coordinates = vertex.child("coordinates");
    const auto coordinate = [&](const char* axis) {
      return file_.coordinate(vertex, coordinates.child(axis).text().get(), "a coordinate of a vertex");
    };
    return {coordinate("x"), coordinate("y"), coordinate("z")};
  }

  bool is_solid(xml_node volume) {
    const std::string type = metadata_of(volume, "slic3r.volume_type");
    if (type == negative_volume)
      assembly_.warnings.add("a negative volume is left out, not taken away from the others",
                             "negative volumes are left out, not taken away from the others");
    return is_solid_volume(type, metadata_of(volume, "slic3r.modifier")) &&
           std::string_view(volume.attribute("type").value()) != "support";
  }

  void read_volume(xml_node volume, std::optional<Rgba> object_colour, Mesh& mesh) {
    if (!is_solid(volume)) return;
    warn_of_others(volume, of_volume);
    MeshGroup group{name_of(volume), static_cast<uint32_t>(mesh.triangles.size()), 0};
    for (const xml_node triangle : volume.children("triangle")) {
      mesh.triangles.push_back(corners(triangle, mesh.vertices.size()));
      ++group.triangle_count;
    }
    if (group.triangle_count == 0) return;
    const auto material = materials_.find(volume.attribute("materialid").value());
    if (material != materials_.end()) group.material = material->second.name;
    group.colour = colour_of(volume);
    if (!group.colour && material != materials_.end()) group.colour = material->second.colour;
    if (!group.colour) group.colour = object_colour;
    const std::string extruder = metadata_of(volume.parent().parent(), "slic3r.extruder");
    mesh.groups.push_back(std::move(group));
    extruders_.paint(mesh.groups, extruder_of(metadata_of(volume, "slic3r.extruder"), extruder));
  }

  std::array<uint32_t, 3> corners(xml_node triangle, size_t vertices) {
    warn_of_others(triangle, of_triangle);
    const auto corner = [&](const char* element) {
      const uint64_t index = file_.count(triangle, triangle.child(element).text().get(), "the number of a vertex");
      if (index >= vertices)
        file_.fail_at(triangle, "the triangle uses vertex " + std::to_string(index) + ", but the " +
                                    format_count(vertices) + " vertices of its object are numbered from 0");
      return static_cast<uint32_t>(index);
    };
    return {corner("v1"), corner("v2"), corner("v3")};
  }

  AssemblyObject read_instances(xml_node constellation) {
    AssemblyObject object;
    object.name = name_of(constellation);
    if (object.name.empty()) object.name = "constellation " + std::string(file_.required(constellation, "id"));
    warn_of_others(constellation, of_constellation);
    for (const xml_node instance : constellation.children("instance")) {
      warn_of_others(instance, of_instance);
      const std::string id(file_.required(instance, "objectid"));
      placed_.insert(id);
      if (value(instance, "printable", 1) != 0)
        object.components.push_back({id, transform(instance)});
      else
        assembly_.warnings.add("an instance of object " + id + " is marked as not printable and is left out",
                               "instances are marked as not printable and are left out");
    }
    return object;
  }

  double value(xml_node instance, const std::string& element, double usual) const {
    const xml_node child = instance.child(element.c_str());
    return child ? file_.coordinate(instance, child.text().get(), "a number in <" + element + '>') : usual;
  }

  Affine turned(xml_node instance, Vec3 axis, const std::string& element) const {
    const double angle = value(instance, element, 0);
    return Affine::rotation(axis, has_radians_ ? degrees_of_radians(angle) : angle);
  }

  // Returns the scale of one axis, negative if it is mirrored.
  double scale(xml_node instance, const std::string& axis) const {
    const double scale = value(instance, "scale" + axis, value(instance, "scale", 1));
    return value(instance, "mirror" + axis, 1) < 0 ? -scale : scale;
  }

  // Returns the map that mirrors and scales, rotates about x, then y, then z, then translates.
  Affine transform(xml_node instance) const {
    const auto delta = [&](const char* element) { return value(instance, element, 0); };
    const Affine map = Affine::translation({delta("deltax"), delta("deltay"), delta("deltaz")}) *
                       turned(instance, {0, 0, 1}, "rz") * turned(instance, {0, 1, 0}, "ry") *
                       turned(instance, {1, 0, 0}, "rx") *
                       Affine::scaling({scale(instance, "x"), scale(instance, "y"), scale(instance, "z")});
    if (determinant(map) == 0) file_.fail_at(instance, "this squeezes its object flat: it is scaled by 0");
    return map;
  }

  const XmlFile& file_;
  Assembly& assembly_;
  std::map<std::string, Material> materials_;
  std::set<std::string> placed_;
  bool has_radians_ = false;
  ExtruderColours extruders_;
};

// Returns the text of a zipped file: the first entry whose name ends in .amf.
std::string unpacked(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  ZipReader archive(name, bytes, diagnostics);
  for (const std::string& entry : archive.names())
    if (to_lower(entry).ends_with(".amf")) return archive.read(entry);
  fail(diagnostics, name, "this zip archive has no file that ends in .amf",
       archive.has("_rels/.rels") ? "name it .3mf, which it seems to be" : "");
}

}  // namespace

std::optional<Mesh> read_amf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return read_or_null(name, bytes, diagnostics, [&] {
    const std::string text = is_zip(bytes) ? unpacked(name, bytes, diagnostics) : "";
    const XmlFile file(name, is_zip(bytes) ? text : bytes, diagnostics);
    Assembly assembly;
    AmfReader(file, assembly).read();
    return assemble(assembly, name, diagnostics);
  });
}

}  // namespace ombre::formats

#endif
