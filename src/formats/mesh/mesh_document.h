// What a mesh file is written from: bodies of triangles, with names, materials and colours.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/math/vec.h"
#include "formats/images/rgba.h"
#include "formats/mesh/beam_lattice.h"

namespace ombre::formats {

struct MeshMaterial {
  std::string name;
  Rgba colour{128, 128, 128, 255};
};

struct MeshBody {
  std::string name;
  std::vector<Vec3> vertices;                                      // mm
  std::vector<std::array<uint32_t, 3>> triangles;                  // counter-clockwise from outside
  std::optional<uint32_t> material = {};                           // an index into the document's
  std::vector<Rgba> vertex_colours = {};                           // empty, or one per vertex
  std::vector<std::pair<std::string, std::string>> settings = {};  // PrusaSlicer's keys: fill_density, 15%
};

// Beams between vertices. Only 3MF holds them.
struct WrittenBeams {
  std::string name;
  std::vector<Vec3> vertices;  // mm
  std::vector<Beam> beams;
  std::vector<uint32_t> materials;  // one for each beam, indices into the document's; or empty
  LatticeClipping clipping = LatticeClipping::none;
  uint32_t clip = 0;  // where there is clipping: an index into the document's clips
};

struct MeshDocument {
  std::string title;
  std::vector<MeshMaterial> materials;
  std::vector<MeshBody> bodies;
  std::vector<WrittenBeams> beams = {};
  std::vector<MeshBody> clips = {};  // solids that are not there themselves

  // Of the bodies.
  size_t vertex_count() const;
  size_t triangle_count() const;
  size_t beam_count() const;
};

}  // namespace ombre::formats
