// References of 3MF elements to materials and other resources (3MF Core 1.3: base materials; Materials and Properties
// 1.2: colour groups).
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
    if (kind == "texture2dgroup" || kind == "compositematerials" || kind == "multiproperties")
      mixtures_[resource_id(file_, node, "id")] = kind;
  }
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
    file_.fail_at(user, "the " + std::string(local_name(user)) + " uses property " + std::to_string(*reference.index) +
                            " of resource " + std::to_string(*reference.resource) + ", which has " +
                            format_count(found->second.size()) + " numbered from 0");
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
