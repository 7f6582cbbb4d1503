// Triangle meshes as files give them: a plain struct and one reader per format. Those of packages: package_readers.h.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/vec.h"
#include "base/text/diagnostic.h"
#include "formats/containers/greatest_coordinate.h"
#include "formats/images/rgba.h"
#include "formats/mesh/beam_lattice.h"

namespace ombre::formats {

// A run of triangles: an STL solid, what an OBJ file calls an object or a group, a volume of AMF, an object of 3MF as
// far as one material goes. A name may come back when a file returns to it.
struct MeshGroup {
  std::string name;
  uint32_t first_triangle = 0, triangle_count = 0;
  std::string material = {};        // OBJ usemtl; it is also the name where the file gives no other
  std::string object = {};          // the AMF object or the 3MF part that it belongs to, where that has a name
  std::optional<Rgba> colour = {};  // AMF, 3MF: its own or its material's
};

// A lattice of one material in its place. Several places may share it.
struct PlacedLattice {
  MeshGroup group;  // what it is called and made of; it has no triangles
  std::shared_ptr<const BeamLattice> lattice;
  Affine mm_from_lattice = {};  // with an inverse
};

struct Mesh {
  // As in the file, 3MF and AMF in mm; finite, at most greatest_coordinate away from 0.
  std::vector<Vec3> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;          // counter-clockwise from outside; empty only beside lattices
  std::vector<MeshGroup> groups;                           // in order, none empty, together all triangles
  std::vector<std::array<double, 2>> texture_coordinates;  // may be empty
  std::vector<std::array<uint32_t, 3>> texture_triangles;  // empty, or one per triangle, into texture_coordinates
  std::vector<PlacedLattice> lattices;  // of 3MF; they unite with the triangles, and what comes first wins
};

// STL, binary and text; vertices at the same place become one.
std::optional<Mesh> read_stl(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// Wavefront OBJ; free-form surfaces, lines and normals are passed over.
std::optional<Mesh> read_obj(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// PLY 1.0: ascii, binary little-endian and big-endian.
std::optional<Mesh> read_ply(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// Geomview OFF as text, in three dimensions; normals, colours and texture coordinates may be there.
std::optional<Mesh> read_off(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// What the bytes show for certain, whatever the file is called.
bool is_stl(std::string_view bytes);
bool is_ply(std::string_view bytes);
bool is_off(std::string_view bytes);

}  // namespace ombre::formats
