// Beams and balls between vertices, as in 3MF files (Beam Lattice Extension 1.2).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

struct Mesh;

// The closing of a beam at an end: a ball with the end's radius, the half of it beyond the end, or flat.
enum class BeamCap : uint8_t { sphere, hemisphere, butt };

// A conical frustum between two vertices, with its caps.
struct Beam {
  std::array<uint32_t, 2> ends{};  // two different vertices of the lattice
  std::array<double, 2> radii{};   // radii at the ends; positive
  std::array<BeamCap, 2> caps{};
};

struct Ball {
  uint32_t centre = 0;  // a vertex of the lattice
  double radius = 0;    // positive
};

// The part of a lattice that exists.
enum class LatticeClipping : uint8_t { none, inside, outside };

// The union of beams and balls, clipped. All lengths are in the unit of the vertices.
struct BeamLattice {
  std::vector<Vec3> vertices;
  std::vector<Beam> beams;
  std::vector<Ball> balls;
  LatticeClipping clipping = LatticeClipping::none;
  std::shared_ptr<const Mesh> clip;  // the clipping mesh; set if there is clipping
};

}  // namespace ombre::formats
