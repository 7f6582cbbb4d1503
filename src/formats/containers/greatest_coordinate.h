// The limit on coordinates of points in files.
#pragma once

namespace ombre::formats {

// Greatest magnitude; beyond it, doubles cannot resolve micrometres.
inline constexpr double greatest_coordinate = 1e15;

}  // namespace ombre::formats
