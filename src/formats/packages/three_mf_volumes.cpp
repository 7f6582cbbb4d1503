// Reads slicers' own files about the objects in a 3MF package.
#ifdef OMBRE_3MF

#include "formats/packages/three_mf_volumes.h"

#include <algorithm>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/packages/slicer_volumes.h"
#include "formats/packages/three_mf_model.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

std::string metadata(xml_node node, std::string_view key) {
  for (const xml_node child : node.children("metadata"))
    if (child.attribute("key").value() == key) return child.attribute("value").value();
  return "";
}

AssemblyObject* object_of(const XmlFile& file, xml_node node, const std::string& part, Assembly& assembly) {
  const uint64_t id = file.count(node, file.required(node, "id"), "the number of an object");
  const auto found = assembly.objects.find(object_key(part, id));
  return found == assembly.objects.end() ? nullptr : &found->second;
}

// The volumes that slicers subtract from the others.
struct Negatives {
  std::string first;  // name of the first
  size_t count = 0;

  void add(const std::string& name) {
    if (count++ == 0) first = name;
  }
  void warn(const XmlFile& file) const {
    if (count == 0) return;
    const std::string more = count > 1 ? " and " + format_count(count - 1) + " more are" : " is";
    file.diagnostics().warning({}, file.name() + ": the negative volume " + formats::quoted(first) + more +
                                       " left out, not taken away from the others");
  }
};

// A range of an object's triangles that is a separate solid.
struct Volume {
  std::string name;
  uint32_t begin = 0, end = 0;
  uint64_t extruder = 1;
};

std::vector<Volume> read_volumes(const XmlFile& file, xml_node object, size_t triangles, Negatives& negatives) {
  std::vector<Volume> volumes;
  for (const xml_node node : object.children("volume")) {
    const uint64_t first = file.count(node, file.required(node, "firstid"), "the number of a triangle");
    const uint64_t last = file.count(node, file.required(node, "lastid"), "the number of a triangle");
    const bool is_next = volumes.empty() || first >= volumes.back().end;
    if (first > last || last >= triangles || !is_next)
      file.fail_at(node, "the volume has the triangles " + std::to_string(first) + " to " + std::to_string(last) +
                             ", but the " + format_count(triangles) +
                             " of its object are numbered from 0, and volumes follow each other");
    volumes.push_back({metadata(node, "name"), static_cast<uint32_t>(first), static_cast<uint32_t>(last + 1),
                       extruder_of(metadata(node, "extruder"), metadata(object, "extruder"))});
    const std::string type = metadata(node, "volume_type");
    if (!is_solid_volume(type, metadata(node, "modifier"))) volumes.back().begin = volumes.back().end;
    if (type == negative_volume) negatives.add(volumes.back().name);
  }
  return volumes;
}

// Adds the triangles that a group and a volume have in common.
void keep(const Mesh& from, const MeshGroup& group, const Volume& volume, const ExtruderColours& extruders,
          Mesh& kept) {
  const uint32_t begin = std::max(group.first_triangle, volume.begin);
  const uint32_t end = std::min(group.first_triangle + group.triangle_count, volume.end);
  if (begin >= end) return;
  std::vector<MeshGroup> part{group};
  extruders.paint(part, volume.extruder);
  part[0].name = volume.name;
  part[0].first_triangle = static_cast<uint32_t>(kept.triangles.size());
  part[0].triangle_count = end - begin;
  kept.triangles.insert(kept.triangles.end(), from.triangles.begin() + begin, from.triangles.begin() + end);
  kept.groups.push_back(std::move(part[0]));
}

// Both lists are sorted, so each step advances one of them.
void cut(Mesh& mesh, const std::vector<Volume>& volumes, const ExtruderColours& extruders) {
  Mesh kept;
  auto volume = volumes.begin();
  for (auto group = mesh.groups.begin(); group != mesh.groups.end() && volume != volumes.end();) {
    keep(mesh, *group, *volume, extruders, kept);
    if (group->first_triangle + group->triangle_count <= volume->end)
      ++group;
    else
      ++volume;
  }
  mesh.triangles = std::move(kept.triangles);
  mesh.groups = std::move(kept.groups);
}

struct Part {
  std::string name;
  bool is_solid = true;
  uint64_t extruder = 1;
};

// Reads the parts by the id of the component's object.
std::map<std::string, Part> read_parts(const XmlFile& file, xml_node object, Negatives& negatives) {
  std::map<std::string, Part> parts;
  for (const xml_node node : object.children("part")) {
    const std::string_view subtype = node.attribute("subtype").value();
    const Part part{metadata(node, "name"), subtype.empty() || subtype == "normal_part",
                    extruder_of(metadata(node, "extruder"), metadata(object, "extruder"))};
    if (subtype == "negative_part") negatives.add(part.name);
    parts.emplace(file.required(node, "id"), part);
  }
  return parts;
}

// Names and colours a component of an object. Returns true if it is not a solid.
bool apply_part(const std::map<std::string, Part>& parts, const Placement& component, const ExtruderColours& extruders,
                Assembly& assembly) {
  const auto part = parts.find(id_of_key(component.object));
  if (part == parts.end()) return false;
  const auto object = assembly.objects.find(component.object);
  if (object != assembly.objects.end()) {
    if (!part->second.name.empty()) object->second.name = part->second.name;
    extruders.paint(object->second.mesh.groups, part->second.extruder);
  }
  return !part->second.is_solid;
}

}  // namespace

void apply_prusa_volumes(const XmlFile& settings, const std::string& part, const ExtruderColours& extruders,
                         Assembly& assembly) {
  Negatives negatives;
  for (const xml_node node : settings.root("config").children("object")) {
    AssemblyObject* const object = object_of(settings, node, part, assembly);
    if (!object || object->mesh.triangles.empty()) continue;
    const std::vector<Volume> volumes = read_volumes(settings, node, object->mesh.triangles.size(), negatives);
    if (!volumes.empty()) cut(object->mesh, volumes, extruders);
    extruders.paint(object->mesh.groups, extruder_of("", metadata(node, "extruder")));
  }
  negatives.warn(settings);
}

void apply_bambu_parts(const XmlFile& settings, const std::string& part, const ExtruderColours& extruders,
                       Assembly& assembly) {
  Negatives negatives;
  for (const xml_node node : settings.root("config").children("object")) {
    AssemblyObject* const object = object_of(settings, node, part, assembly);
    if (!object) continue;
    if (const std::string name = metadata(node, "name"); !name.empty()) object->name = name;
    extruders.paint(object->mesh.groups, extruder_of("", metadata(node, "extruder")));
    const std::map<std::string, Part> parts = read_parts(settings, node, negatives);
    std::erase_if(object->components,
                  [&](const Placement& component) { return apply_part(parts, component, extruders, assembly); });
  }
  negatives.warn(settings);
}

}  // namespace ombre::formats

#endif
