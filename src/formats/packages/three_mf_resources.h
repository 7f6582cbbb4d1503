// References of 3MF elements to materials, colours, objects and vertices. Only for builds with pugixml.
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

// The base materials and colour groups of a model file.
class PropertyTable {
 public:
  explicit PropertyTable(const XmlFile& file) : file_(file) {}

  void read(pugi::xml_node resources);

  // Returns the reference in the attributes `pid` and `index` of an element; `usual` replaces missing ones.
  PropertyReference reference(pugi::xml_node node, std::string_view index, PropertyReference usual) const;
  // Returns the reference of an element with properties at several corners; no property if they differ, because
  // mixtures are not supported.
  PropertyReference reference(pugi::xml_node node, std::initializer_list<const char*> corners,
                              const PropertyReference& usual) const;

  // Sets the material and the colour of a group. Resources of other kinds (textures, mixtures) set neither. `user` is
  // the element that refers to them.
  void describe(const PropertyReference& reference, pugi::xml_node user, MeshGroup& group) const;

  // Returns the name of the element that mixes properties if the reference is to one, else an empty text.
  std::string mixture(const PropertyReference& reference) const;

 private:
  struct Property {
    std::string material;
    std::optional<Rgba> colour;
  };

  void read_properties(pugi::xml_node node, std::string_view element, std::string_view colour);

  const XmlFile& file_;
  std::map<uint64_t, std::vector<Property>> properties_;
  std::map<uint64_t, std::string> mixtures_;  // by resource: kind of mixture
};

// Returns the id of an object or a resource.
uint64_t resource_id(const XmlFile& file, pugi::xml_node node, std::string_view attribute);

// Returns the number of a vertex of an object with `vertices` vertices.
uint32_t vertex_number(const XmlFile& file, pugi::xml_node node, std::string_view attribute, size_t vertices);

// Returns the first child with that local name, or null.
pugi::xml_node child_of(pugi::xml_node node, std::string_view name);

}  // namespace ombre::formats
