// Studies: materials, supports and loads, as a JSON file has them, and their meaning for the nodes of a mesh.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"
#include "base/text/record.h"
#include "fea/model/model.h"

namespace ombre::fea {

// A plane through a point, which chooses the nodes on it.
struct Plane {
  Vec3 point, normal;  // mm; the normal has length one
};

// Chooses outer sides that look along a direction.
struct Facing {
  Vec3 direction;  // unit vector
  double most_degrees = 0;
};

// A text of the study with its place.
struct PlacedText {
  std::string text;
  SourceRange where;
};

// Chooses nodes of a mesh that meet all conditions that are given.
struct Selection {
  std::optional<std::pair<int, bool>> side;  // side of the bounding box: axis, and true for the upper side
  std::optional<Box> box;                    // mm
  std::optional<Plane> plane;
  std::optional<Facing> facing;
  std::optional<PlacedText> material;  // nodes of elements that are made of it, or have most of it
  std::optional<PlacedText> part;      // nodes of elements whose middle is in this part of the design
  std::optional<PlacedText> formula;   // nodes where the formula is not 0
  SourceRange where;
};

struct Support {
  Selection on;
  std::array<std::optional<double>, 3> displacement_mm;  // along x, y, z; a missing one is free
  double value = 0;                                      // in conduction: degrees Celsius, or V
  std::string name;                                      // name of its nodes in decks
};

struct Load {
  enum class Kind : uint8_t {
    force,
    pressure,
    flow,        // total heat or current that enters
    flux,        // heat or current for each mm2 of outer sides
    convection,  // exchange with a medium around
  } kind = Kind::force;
  Selection on;
  Vec3 force_n;             // distributed over the outer sides there by area, or else evenly over the nodes
  double pressure_mpa = 0;  // positive towards the solid
  double flow = 0;          // W or A; for a flux per mm2
  double film_w_m2k = 0, ambient_c = 0;
  std::string name;
};

struct Study {
  Physics physics = Physics::mechanics;
  std::map<std::string, Elastic> materials;      // by name; they take precedence over those of the materials file
  std::map<std::string, double> conductivities;  // W/(m K) or S/m, depending on the physics
  std::vector<Support> supports;
  std::vector<Load> loads;
  Vec3 gravity_mm_s2;
  // Mean strain of a periodic cell, which has no supports and loads: xx, yy, zz, xy, yz, zx, the last three as twice
  // the tensor's.
  std::optional<std::array<double, 6>> mean_strain;
  SourceRange where;
};

// {"materials": {"soft": {"modulus_mpa": 1, "poissons_ratio": 0.4, "density_kg_m3": 1100}},
//  "supports": [{"on": "zmin", "fix": "xyz"}, {"on": "zmax", "displacement_mm": [null, null, -1]}],
//  "loads": [{"on": "xmax", "force_n": [0, 0, -5]}, {"on": {"box": [0, 0, 0, 1, 1, 1]}, "pressure_mpa": 0.1}],
//  "gravity_mm_s2": [0, 0, -9810]}
// or of a cell that repeats: {"materials": ..., "mean_strain": [0.01, 0, 0, 0, 0, 0]}
// or of conduction:
// {"physics": "heat", "materials": {"soft": {"conductivity_w_mk": 0.2}},
//  "supports": [{"on": "zmin", "temperature_c": 20}],
//  "loads": [{"on": "zmax", "heat_w": 1}, {"on": "xmax", "flux_w_mm2": 0.01},
//            {"on": "ymax", "film_w_m2k": 10, "ambient_c": 20}]}
// {"physics": "electric", "materials": {"soft": {"conductivity_s_m": 100}},
//  "supports": [{"on": "zmin", "potential_v": 0}], "loads": [{"on": "zmax", "current_a": 0.1}]}
// Returns nothing, and adds diagnostics with places, when it is wrong.
std::optional<Study> read_study(const Data& data, Diagnostics& diagnostics);

// Parts of studies. Each returns nothing, and reports why, for data that are wrong.
std::optional<Selection> read_selection(const Data& data, const MemberReader& reader);
extern const char* const selection_help;                                           // what to write for a selection
std::optional<Vec3> read_direction(const Data& data, const MemberReader& reader);  // of length one
std::optional<Box> read_box(const Data& data, const MemberReader& reader);

// Reads properties as a materials file has them beside a colour: "modulus_mpa" and so on. Returns nothing if there is
// none of them; adds a diagnostic at `data` if one is wrong or missing.
std::optional<Elastic> read_elastic(const DataMembers& members, const SourceRange& where, Diagnostics& diagnostics);
// Reads "conductivity_w_mk" or "conductivity_s_m", depending on the physics, with the same results.
std::optional<double> read_conductivity(const DataMembers& members, Physics physics, Diagnostics& diagnostics);

// A function that chooses the nodes of a part, or those by a formula, in the design. It returns nothing, and adds
// diagnostics, if the text is wrong.
using ChooseNodes =
    std::function<std::optional<std::vector<bool>>(const Selection& selection, Diagnostics& diagnostics)>;

// Applies a study to a model. Returns nothing, and adds diagnostics, if a selection holds no node, a piece of the mesh
// can move as a whole, or its temperature is undetermined. Without `choose`, selections by part and formula are errors.
std::optional<Conditions> conditions_of(const Study& study, const ModelView& model, Diagnostics& diagnostics,
                                        const ChooseNodes& choose = nullptr);

}  // namespace ombre::fea
