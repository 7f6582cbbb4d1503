// How far from 0 points of files may lie.
#pragma once

namespace ombre::formats {

// Farther away, a double cannot tell micrometres apart.
inline constexpr double greatest_coordinate = 1e15;

}  // namespace ombre::formats
