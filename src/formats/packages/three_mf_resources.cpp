// References of 3MF elements to materials and other resources (3MF Core 1.3: base materials; Materials and Properties
// 1.2: colour groups and textures).
#ifdef OMBRE_3MF

#include "formats/packages/three_mf_resources.h"

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {

using pugi::xml_node;

xml_node child_of(xml_node node, std::string_view name) {
  for (const xml_node child : node.children())
    if (local_name(child) == name) return child;
  return {};
}

uint64_t resource_id(const XmlFile& file, xml_node node, std::string_view attribute) {
  return file.count(node, file.required(node, attribute), "the number of an object or a resource");
}

uint32_t vertex_number(const XmlFile& file, xml_node node, std::string_view attribute, size_t vertices) {
  const uint64_t index = file.count(node, file.required(node, attribute), "the number of a vertex");
  if (index >= vertices)
    file.fail_at(node, "the " + std::string(local_name(node)) + " uses vertex " + std::to_string(index) + ", but the " +
                           format_count(vertices) + " vertices of its object are numbered from 0");
  return static_cast<uint32_t>(index);
}

void PropertyTable::read(xml_node resources) {
  for (const xml_node node : resources.children()) {
    const std::string_view kind = local_name(node);
    if (kind == "basematerials") read_properties(node, "base", "displaycolor");
    if (kind == "colorgroup") read_properties(node, "color", "color");
    if (kind == "texture2d") read_texture(node);
    if (kind == "texture2dgroup") read_texture_group(node);
    if (kind == "compositematerials" || kind == "multiproperties") mixtures_[resource_id(file_, node, "id")] = kind;
  }
}

ImageWrap PropertyTable::wrap(xml_node node, std::string_view attribute) const {
  const std::string_view style = file_.attribute(node, attribute).value_or("wrap");
  if (style == "mirror") return ImageWrap::mirror;
  return style == "clamp" || style == "none" ? ImageWrap::clamp : ImageWrap::repeat;
}

void PropertyTable::read_texture(xml_node node) {
  const std::string_view path = file_.required(node, "path");
  MeshImage image;
  image.name = path.starts_with('/') ? path.substr(1) : path;
  image.wrap_u = wrap(node, "tilestyleu");
  image.wrap_v = wrap(node, "tilestylev");
  textures_[resource_id(file_, node, "id")] = static_cast<int32_t>(images_.size());
  images_.push_back(std::move(image));
}

void PropertyTable::read_texture_group(xml_node node) {
  const auto texture = textures_.find(resource_id(file_, node, "texid"));
  if (texture == textures_.end()) file_.fail_at(node, "the texture2dgroup names a texture that is not before it");
  TextureGroup& group = texture_groups_[resource_id(file_, node, "id")];
  group.image = texture->second;
  for (const xml_node child : node.children())
    if (local_name(child) == "tex2coord")
      group.places.push_back({file_.coordinate(child, file_.required(child, "u"), "a coordinate of a texture"),
                              file_.coordinate(child, file_.required(child, "v"), "a coordinate of a texture")});
}

std::optional<std::array<size_t, 3>> PropertyTable::corners(xml_node triangle, const PropertyReference& usual) const {
  std::array<size_t, 3> indices;
  constexpr std::array<const char*, 3> names{"p1", "p2", "p3"};
  for (size_t n = 0; n < 3; ++n) {
    auto index = file_.attribute(triangle, names[n]);
    if (!index) index = file_.attribute(triangle, "p1");
    if (!index && !usual.index) return std::nullopt;
    indices[n] = index ? file_.count(triangle, *index, "the number of a property") : *usual.index;
  }
  return indices;
}

void PropertyTable::fail_index(xml_node user, uint64_t index, uint64_t resource, size_t count) const {
  file_.fail_at(user, "the " + std::string(local_name(user)) + " uses property " + std::to_string(index) +
                          " of resource " + std::to_string(resource) + ", which has " + format_count(count) +
                          " numbered from 0");
}

std::optional<TriangleShading> PropertyTable::shading(xml_node triangle, const PropertyReference& usual) const {
  const auto pid = file_.attribute(triangle, "pid");
  const auto resource = pid ? std::optional(file_.count(triangle, *pid, "the number of a resource")) : usual.resource;
  const auto indices = resource ? corners(triangle, usual) : std::nullopt;
  if (!indices) return std::nullopt;
  TriangleShading shading;
  if (const auto group = texture_groups_.find(*resource); group != texture_groups_.end()) {
    shading.image = group->second.image;
    for (size_t n = 0; n < 3; ++n) {
      const auto& places = group->second.places;
      if ((*indices)[n] >= places.size()) fail_index(triangle, (*indices)[n], *resource, places.size());
      shading.places[n] = places[(*indices)[n]];
    }
    return shading;
  }
  const auto found = properties_.find(*resource);
  if (found == properties_.end() || ((*indices)[0] == (*indices)[1] && (*indices)[1] == (*indices)[2]))
    return std::nullopt;
  for (size_t n = 0; n < 3; ++n) {
    if ((*indices)[n] >= found->second.size()) fail_index(triangle, (*indices)[n], *resource, found->second.size());
    if (const auto& colour = found->second[(*indices)[n]].colour) shading.colours[n] = shares_of(*colour);
  }
  return shading;
}

void PropertyTable::read_properties(xml_node node, std::string_view element, std::string_view colour) {
  std::vector<Property>& properties = properties_[resource_id(file_, node, "id")];
  for (const xml_node child : node.children()) {
    if (local_name(child) != element) continue;
    const auto text = file_.attribute(child, colour);
    properties.push_back({std::string(file_.attribute(child, "name").value_or("")), parse_colour(text.value_or(""))});
  }
}

PropertyReference PropertyTable::reference(xml_node node, std::string_view index, PropertyReference usual) const {
  if (const auto resource = file_.attribute(node, "pid"))
    usual.resource = file_.count(node, *resource, "the number of a resource");
  if (const auto number = file_.attribute(node, index))
    usual.index = file_.count(node, *number, "the number of a property");
  return usual;
}

PropertyReference PropertyTable::reference(xml_node node, std::initializer_list<const char*> corners,
                                           const PropertyReference& usual) const {
  const char* const first = *corners.begin();
  const auto index = file_.attribute(node, first);
  for (const char* corner : corners)
    if (const auto other = file_.attribute(node, corner); other && other != index) return {};
  return reference(node, first, usual);
}

void PropertyTable::describe(const PropertyReference& reference, xml_node user, MeshGroup& group) const {
  if (!reference.resource || !reference.index) return;
  const auto found = properties_.find(*reference.resource);
  if (found == properties_.end()) return;
  if (*reference.index >= found->second.size())
    fail_index(user, *reference.index, *reference.resource, found->second.size());
  const Property& property = found->second[*reference.index];
  group.material = property.material;
  group.colour = property.colour;
}

std::string PropertyTable::mixture(const PropertyReference& reference) const {
  const auto found = reference.resource ? mixtures_.find(*reference.resource) : mixtures_.end();
  return found == mixtures_.end() ? "" : found->second;
}

}  // namespace ombre::formats

#endif
