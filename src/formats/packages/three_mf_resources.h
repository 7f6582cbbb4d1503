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

  // Returns the name of the element that mixes properties if the reference is to one, else an empty text. Textures are
  // no mixtures.
  std::string mixture(const PropertyReference& reference) const;

  // Returns the shading of a triangle if its corners lie in a texture, or have different colours. `usual` is that of
  // its object. The shading's image is a number in images().
  std::optional<TriangleShading> shading(pugi::xml_node triangle, const PropertyReference& usual) const;
  // The images of textures; their names are those in the package.
  const std::vector<MeshImage>& images() const { return images_; }

 private:
  struct Property {
    std::string material;
    std::optional<Rgba> colour;
  };

  // Places of a texture, and the number of its image.
  struct TextureGroup {
    int32_t image = -1;
    std::vector<std::array<double, 2>> places;
  };

  void read_properties(pugi::xml_node node, std::string_view element, std::string_view colour);
  void read_texture(pugi::xml_node node);
  void read_texture_group(pugi::xml_node node);
  ImageWrap wrap(pugi::xml_node node, std::string_view attribute) const;
  // Returns the properties of the three corners, or nothing if one has none.
  std::optional<std::array<size_t, 3>> corners(pugi::xml_node triangle, const PropertyReference& usual) const;
  [[noreturn]] void fail_index(pugi::xml_node user, uint64_t index, uint64_t resource, size_t count) const;

  const XmlFile& file_;
  std::map<uint64_t, std::vector<Property>> properties_;
  std::map<uint64_t, std::string> mixtures_;  // by resource: kind of mixture
  std::map<uint64_t, int32_t> textures_;      // by resource: number of the image
  std::map<uint64_t, TextureGroup> texture_groups_;
  std::vector<MeshImage> images_;
};

// Returns the id of an object or a resource.
uint64_t resource_id(const XmlFile& file, pugi::xml_node node, std::string_view attribute);

// Returns the number of a vertex of an object with `vertices` vertices.
uint32_t vertex_number(const XmlFile& file, pugi::xml_node node, std::string_view attribute, size_t vertices);

// Returns the first child with that local name, or null.
pugi::xml_node child_of(pugi::xml_node node, std::string_view name);

}  // namespace ombre::formats
