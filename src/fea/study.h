// Studies: what is held and what pulls, as a JSON file says it, and what that means for the nodes of a mesh.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/data.h"
#include "base/diagnostic.h"
#include "fea/model.h"

namespace ombre::fea {

// Chooses nodes of a mesh: those on one side of its bounding box, or those within a box.
struct Selection {
  std::optional<std::pair<int, bool>> side;  // axis, and whether the upper one
  Box box;                                   // mm, where there is no side
  SourceRange where;
};

struct Support {
  Selection on;
  std::array<std::optional<double>, 3> displacement_mm;  // along x, y, z; what is missing is free
};

struct Load {
  enum class Kind : uint8_t { force, pressure } kind = Kind::force;
  Selection on;
  Vec3 force_n;             // shared out over the outer faces there, by area; or else evenly over the nodes
  double pressure_mpa = 0;  // towards the solid
};

struct Study {
  std::map<std::string, Elastic> materials;  // by name, before those of the materials file
  std::vector<Support> supports;
  std::vector<Load> loads;
  Vec3 gravity_mm_s2;
  SourceRange where;
};

// {"materials": {"soft": {"modulus_mpa": 1, "poissons_ratio": 0.4, "density_kg_m3": 1100}},
//  "supports": [{"on": "zmin", "fix": "xyz"}, {"on": "zmax", "displacement_mm": [null, null, -1]}],
//  "loads": [{"on": "xmax", "force_n": [0, 0, -5]}, {"on": {"box": [0, 0, 0, 1, 1, 1]}, "pressure_mpa": 0.1}],
//  "gravity_mm_s2": [0, 0, -9810]}
// Nothing, and diagnostics with places, when it is wrong.
std::optional<Study> read_study(const Data& data, Diagnostics& diagnostics);

// Properties as a materials file has them beside a colour: "modulus_mpa" and so on. Nothing when there is none of them;
// a diagnostic at `data` when one is wrong or missing.
std::optional<Elastic> read_elastic(const DataMembers& members, const SourceRange& where, Diagnostics& diagnostics);

// Nothing, and diagnostics, when a selection holds no node, or a piece of the mesh is free to move as a whole.
std::optional<Conditions> conditions_of(const Study& study, const Model& model, Diagnostics& diagnostics);

}  // namespace ombre::fea
