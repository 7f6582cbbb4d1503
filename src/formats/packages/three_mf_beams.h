// Reads the beam lattices of a 3MF model. Only for builds with pugixml.
#pragma once

#include <functional>

#include "formats/containers/counted_warnings.h"
#include "formats/packages/three_mf_resources.h"

namespace ombre::formats {

// Returns the mesh of the object `id`, which clips a lattice; `user` is the element that refers to it.
using ClippingMeshes = std::function<std::shared_ptr<const Mesh>(pugi::xml_node user, uint64_t id)>;

// Adds the lattices of a <beamlattice> element to the mesh of its object, whose vertices are already read: one for each
// material. Lattices whose elements come last are first, because they have precedence where beams overlap, and beams
// have precedence over balls. `usual` is the object's property.
void add_lattices(const XmlFile& file, pugi::xml_node element, const PropertyTable& properties,
                  const PropertyReference& usual, const ClippingMeshes& clipping_meshes, CountedWarnings& warnings,
                  Mesh& mesh);

}  // namespace ombre::formats
