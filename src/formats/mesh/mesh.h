// Triangle meshes as read from files: a plain struct, and one reader per format. Readers of packages are in
// package_readers.h.
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

// A consecutive range of triangles: an STL solid, an object or group of OBJ, a volume of AMF, or the triangles of one
// material in a 3MF object. A name may occur several times.
struct MeshGroup {
  std::string name;
  uint32_t first_triangle = 0, triangle_count = 0;
  std::string material = {};        // name in OBJ's usemtl; it is also the group's name if the file has no other
  std::string object = {};          // name of the AMF object or 3MF part that contains it, if it has one
  std::optional<Rgba> colour = {};  // AMF and 3MF: its own colour, or that of its material
  uint32_t painted = 0;             // 3MF of slicers: extruder that its surface is painted with; 0 for none
};

// A placed lattice of one material. Several placements may share a lattice.
struct PlacedLattice {
  MeshGroup group;  // its name and material; without triangles
  std::shared_ptr<const BeamLattice> lattice;
  Affine mm_from_lattice = {};  // invertible
};

// An image repeats beyond its edges, is mirrored there, or goes on as at the edge.
enum class ImageWrap : uint8_t { repeat, mirror, clamp };

// An image that colours a surface.
struct MeshImage {
  std::string name;        // in the file, or of a file beside it, for messages
  std::string bytes = {};  // a PNG or JPEG file; empty if `name` is a file
  ImageWrap wrap_u = ImageWrap::repeat, wrap_v = ImageWrap::repeat;
  bool operator==(const MeshImage&) const = default;
};

// The colours of a triangle's corners, between which it is shaded. With an image they are multiplied by it in
// linear light; white leaves it as it is.
struct TriangleShading {
  std::array<std::array<float, 4>, 3> colours{{{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}};  // sRGB and alpha, 0 to 1
  std::array<std::array<double, 2>, 3> places{};  // of the corners in the image: u to the right, v upwards, 0 to 1
  int32_t image = -1;                             // number of the image; -1: none
};

struct Mesh {
  // In the file's unit, or mm for 3MF, AMF and glTF; finite, with coordinates of at most greatest_coordinate.
  std::vector<Vec3> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise from outside; empty only if there are lattices
  std::vector<MeshGroup> groups;                   // in order, not empty, covering all triangles
  std::vector<std::array<double, 2>> texture_coordinates;  // may be empty
  // empty, or one per triangle; indices into texture_coordinates
  std::vector<std::array<uint32_t, 3>> texture_triangles;
  std::vector<std::array<float, 4>> vertex_colours;  // red, green, blue, alpha in sRGB, 0 to 1; empty, or one a vertex
  // Files with textures or shaded triangles have one a triangle, others none; parts of meshes have none.
  std::vector<TriangleShading> shadings = {};
  std::vector<MeshImage> images = {};
  std::vector<PlacedLattice> lattices;  // from 3MF; united with the triangles, the earlier has precedence
};

// Reads binary and text STL; vertices at the same place are merged.
std::optional<Mesh> read_stl(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// Reads Wavefront OBJ; free-form surfaces, lines and normals are ignored.
std::optional<Mesh> read_obj(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// Reads PLY 1.0: ascii, binary little-endian and big-endian.
std::optional<Mesh> read_ply(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// Reads Geomview OFF as text, in three dimensions; normals, colours and texture coordinates are accepted.
std::optional<Mesh> read_off(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// Reads binary glTF 2.0, or its JSON text with buffers inside: the triangles of the scene, in mm with z upwards.
std::optional<Mesh> read_gltf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// These return true if the bytes are certainly of the format, whatever the file's name.
bool is_stl(std::string_view bytes);
bool is_ply(std::string_view bytes);
bool is_off(std::string_view bytes);
bool is_glb(std::string_view bytes);

}  // namespace ombre::formats
