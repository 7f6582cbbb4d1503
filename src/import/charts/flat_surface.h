// Surfaces laid out in a plane, by a library in a separate module.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/vec.h"

namespace ombre::importing {

enum class Flattening : uint8_t {
  lscm,     // least-squares conformal: keeps angles as far as possible (Lévy, Petitjean, Ray and Maillot, 2002)
  arap,     // as rigid as possible: keeps lengths as far as possible (Liu, Zhang, Xu, Gotsman and Gortler, 2008)
  authalic  // discrete authalic: a circle, by weights that keep areas around points (Desbrun, Meyer and Alliez, 2002)
};

// Returns a place for each point of a surface in one piece with a border. Places may be turned over where the method
// fails. `points` are in mm; the result has any scale. Throws Error if this build has no such library or it fails.
std::vector<Vec2> flatten(const std::vector<Vec3>& points, const std::vector<std::array<uint32_t, 3>>& triangles,
                          Flattening method);
bool has_flattening();

}  // namespace ombre::importing

// Lays out a surface; the function that the module exports.
extern "C" void ombre_flatten(const std::vector<ombre::Vec3>& points,
                              const std::vector<std::array<uint32_t, 3>>& triangles,
                              ombre::importing::Flattening method, std::vector<ombre::Vec2>& places);
