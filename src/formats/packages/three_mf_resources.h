// How the elements of a 3MF model refer to materials, colours, objects and vertices. Only for files that are built with
// pugixml.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "formats/containers/xml_file.h"
#include "formats/mesh/mesh.h"

namespace ombre::formats {

// A resource of properties, and an index in it.
struct PropertyReference {
  std::optional<uint64_t> resource, index;
  bool operator==(const PropertyReference&) const = default;
  bool operator<(const PropertyReference& other) const {
    return std::tie(resource, index) < std::tie(other.resource, other.index);
  }
};

// The base materials and the colour groups of a model file.
class PropertyTable {
 public:
  explicit PropertyTable(const XmlFile& file) : file_(file) {}

  void read(pugi::xml_node resources);

  // What the attributes `pid` and `index` of an element refer to; `usual` where they are missing.
  PropertyReference reference(pugi::xml_node node, std::string_view index, PropertyReference usual) const;
  // The same for an element with properties at several corners; no property where these differ, since there is no
  // place for mixtures.
  PropertyReference reference(pugi::xml_node node, std::initializer_list<const char*> corners,
                              const PropertyReference& usual) const;

  // Gives a group the material and the colour. Resources of other kinds (textures, mixtures) give neither. `user` is
  // the element that refers to them.
  void describe(const PropertyReference& reference, pugi::xml_node user, MeshGroup& group) const;

  // The name of the element that mixes properties, if the reference is to one; else empty.
  std::string mixture(const PropertyReference& reference) const;

 private:
  struct Property {
    std::string material;
    std::optional<Rgba> colour;
  };

  void read_properties(pugi::xml_node node, std::string_view element, std::string_view colour);

  const XmlFile& file_;
  std::map<uint64_t, std::vector<Property>> properties_;
  std::map<uint64_t, std::string> mixtures_;  // the kinds of resources that mix others
};

// The number of an object or a resource.
uint64_t resource_id(const XmlFile& file, pugi::xml_node node, std::string_view attribute);

// The number of a vertex of an object that has so many.
uint32_t vertex_number(const XmlFile& file, pugi::xml_node node, std::string_view attribute, size_t vertices);

// The first child of that local name; null without one.
pugi::xml_node child_of(pugi::xml_node node, std::string_view name);

}  // namespace ombre::formats
