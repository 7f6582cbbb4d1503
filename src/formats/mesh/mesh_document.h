// The contents of a mesh file to be written: bodies of triangles, with names, materials and colours.
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
#include "formats/mesh/slicer_project.h"

namespace ombre::formats {

struct MeshMaterial {
  std::string name;
  Rgba colour{128, 128, 128, 255};
};

struct MeshBody {
  std::string name;
  std::vector<Vec3> vertices;                      // mm
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise from outside
  std::optional<uint32_t> material = {};           // index of a material of the document
  std::vector<Rgba> vertex_colours = {};           // empty, or one per vertex
  Settings settings = {};
  std::vector<uint8_t> paint = {};  // empty, or one per triangle: the extruder of its surface; 0 for the body's own
};

// Beams between vertices, which only 3MF supports.
struct WrittenBeams {
  std::string name;
  std::vector<Vec3> vertices;  // mm
  std::vector<Beam> beams;
  std::vector<uint32_t> materials;  // empty, or one per beam: indices of materials of the document
  LatticeClipping clipping = LatticeClipping::none;
  uint32_t clip = 0;  // if clipped: index into the document's clips
};

struct MeshDocument {
  std::string title;
  std::vector<MeshMaterial> materials;
  std::vector<MeshBody> bodies;
  std::vector<WrittenBeams> beams = {};
  std::vector<MeshBody> clips = {};  // solids that only serve for clipping
  SlicerProject project = {};        // for files of slicers

  // Totals over the bodies.
  size_t vertex_count() const;
  size_t triangle_count() const;
  size_t beam_count() const;
};

}  // namespace ombre::formats
