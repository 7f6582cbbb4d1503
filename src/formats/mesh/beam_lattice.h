// Beams and balls between vertices, as 3MF files have them (Beam Lattice Extension 1.2).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

struct Mesh;

// How a beam is closed at an end: by a ball of the end's radius, by the half of it that lies beyond the end, or flat.
enum class BeamCap : uint8_t { sphere, hemisphere, butt };

// A conical frustum between two vertices, and its caps.
struct Beam {
  std::array<uint32_t, 2> ends{};  // vertices of the lattice, not the same
  std::array<double, 2> radii{};   // at the ends; positive
  std::array<BeamCap, 2> caps{};
};

struct Ball {
  uint32_t centre = 0;  // a vertex of the lattice
  double radius = 0;    // positive
};

// Which part of a lattice there is.
enum class LatticeClipping : uint8_t { none, inside, outside };

// The union of its beams and balls, clipped. All lengths are in the unit of its vertices.
struct BeamLattice {
  std::vector<Vec3> vertices;
  std::vector<Beam> beams;
  std::vector<Ball> balls;
  LatticeClipping clipping = LatticeClipping::none;
  std::shared_ptr<const Mesh> clip;  // by the triangles of this; set where there is clipping
};

}  // namespace ombre::formats
