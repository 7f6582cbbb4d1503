// The beam lattices of a 3MF model. Only for files that are built with pugixml.
#pragma once

#include <functional>

#include "formats/containers/counted_warnings.h"
#include "formats/packages/three_mf_resources.h"

namespace ombre::formats {

// The mesh of an object that is clipped by; `user` is the element that refers to it.
using ClippingMeshes = std::function<std::shared_ptr<const Mesh>(pugi::xml_node user, uint64_t id)>;

// Adds what a <beamlattice> element holds to the mesh of its object, whose vertices are read already: one lattice for
// each material. Those whose elements come last are first, since they win where beams overlap, and beams win over
// balls. `usual` is the object's property.
void add_lattices(const XmlFile& file, pugi::xml_node element, const PropertyTable& properties,
                  const PropertyReference& usual, const ClippingMeshes& clipping_meshes, CountedWarnings& warnings,
                  Mesh& mesh);

}  // namespace ombre::formats
