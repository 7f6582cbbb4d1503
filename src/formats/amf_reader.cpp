// AMF (ISO/ASTM 52915), as text or zipped: objects with volumes, materials, constellations.
#ifdef OMBRE_3MF

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.h"
#include "formats/assembly.h"
#include "formats/text_scanner.h"
#include "formats/xml_file.h"
#include "formats/zip_archive.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

struct Material {
  std::string name;
  std::optional<Rgba> colour;
};

std::string name_of(xml_node node) {
  for (const xml_node child : node.children("metadata"))
    if (std::string_view(child.attribute("type").value()) == "name") return child.text().get();
  return "";
}

// Colours may be formulas of the place, which are not read.
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
    for (const xml_node material : amf.children("material"))
      materials_[material.attribute("id").value()] = {name_of(material), colour_of(material)};
    for (const xml_node object : amf.children("object")) add(object, read_object(object));
    for (const xml_node constellation : amf.children("constellation"))
      add(constellation, read_instances(constellation));
    // What stands in no constellation stands for itself.
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

  void add(xml_node node, AssemblyObject object) {
    const std::string id(file_.required(node, "id"));
    if (!assembly_.objects.emplace(id, std::move(object)).second)
      file_.fail_at(node, "there are two objects with the id " + quoted(id));
  }

  AssemblyObject read_object(xml_node node) {
    AssemblyObject object;
    object.name = name_of(node);
    if (object.name.empty()) object.name = "object " + std::string(file_.required(node, "id"));
    const xml_node mesh = node.child("mesh");
    for (const xml_node vertex : mesh.child("vertices").children("vertex"))
      object.mesh.vertices.push_back(point(vertex));
    for (const xml_node volume : mesh.children("volume")) read_volume(volume, colour_of(node), object.mesh);
    return object;
  }

  Vec3 point(xml_node vertex) const {
    const xml_node coordinates = vertex.child("coordinates");
    const auto coordinate = [&](const char* axis) {
      return file_.coordinate(vertex, coordinates.child(axis).text().get(), "a coordinate of a vertex");
    };
    return {coordinate("x"), coordinate("y"), coordinate("z")};
  }

  void read_volume(xml_node volume, std::optional<Rgba> object_colour, Mesh& mesh) const {
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
    mesh.groups.push_back(std::move(group));
  }

  std::array<uint32_t, 3> corners(xml_node triangle, size_t vertices) const {
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
    for (const xml_node instance : constellation.children("instance")) {
      object.components.push_back({std::string(file_.required(instance, "objectid")), transform(instance)});
      placed_.insert(object.components.back().object);
    }
    return object;
  }

  // Turned about x, then y, then z, then moved.
  Affine transform(xml_node instance) const {
    const auto value = [&](const char* element) {
      const xml_node child = instance.child(element);
      return child ? file_.coordinate(instance, child.text().get(), std::string("a number in <") + element + '>') : 0;
    };
    return Affine::translation({value("deltax"), value("deltay"), value("deltaz")}) *
           Affine::rotation({0, 0, 1}, value("rz")) * Affine::rotation({0, 1, 0}, value("ry")) *
           Affine::rotation({1, 0, 0}, value("rx"));
  }

  const XmlFile& file_;
  Assembly& assembly_;
  std::map<std::string, Material> materials_;
  std::set<std::string> placed_;
};

// The text of a zipped file: its first entry that is called so.
std::string unpacked(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  ZipReader archive(name, bytes, diagnostics);
  for (const std::string& entry : archive.names())
    if (to_lower(entry).ends_with(".amf")) return archive.read(entry);
  fail(diagnostics, name, "this zip archive has no file that ends in .amf",
       archive.has("_rels/.rels") ? "name it .3mf, which it seems to be" : "");
}

}  // namespace

std::optional<Mesh> read_amf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  try {
    if (bytes.empty()) fail(diagnostics, name, "the file is empty");
    const std::string text = is_zip(bytes) ? unpacked(name, bytes, diagnostics) : "";
    const XmlFile file(name, is_zip(bytes) ? text : bytes, diagnostics);
    Assembly assembly;
    AmfReader(file, assembly).read();
    return assemble(assembly, name, diagnostics);
  } catch (const DesignError&) {
    return std::nullopt;
  }
}

}  // namespace ombre::formats

#endif
