// The space above a patch of a surface, as u, v and a height.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/charts/surface_patch.h"
#include "program/field_source.h"

namespace ombre::importing {

// A place where the shell turns inside out, and the height up to which it does not, from 0 on.
struct Fold {
  Vec3 at;
  double height = 0;
};
// Returns the place with the least height among those below the upper border or, downward, above the lower one; nothing
// if there is none. Exact.
std::optional<Fold> find_fold(const Shell& shell);

// Returns a point that several places of the shell share, or nothing. Tests the middles and corners of triangles, at
// five heights.
std::optional<Vec3> find_overlap(const Shell& shell);

// Lengths and volumes as the shell changes them, from the corners and middles of triangles at five heights.
struct ShellReport {
  Interval volumes;    // mm^3 per unit of u, v (mm) and of height
  Interval stretches;  // of lengths along the surface
  double aspect = 1;   // greatest ratio of stretches at a place
};
ShellReport report_of(const Shell& shell);

// Returns a source with the channels "u", "v" (mm) and "height", and their derivatives "u_x" to "height_z". "outside"
// is g of the shell, "inside" 1 in it and 0 elsewhere. "border" is the distance in mm to the patch's border at the same
// height. Outside, values are those of the nearest triangle. `content` is the hash of what the shell is made of.
program::SourceField make_shell_source(const std::string& name, Shell shell, Hash content);

}  // namespace ombre::importing
