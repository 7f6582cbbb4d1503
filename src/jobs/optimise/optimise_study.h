// Studies of optimisation: variables, objectives, limits and the method.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"
#include "jobs/optimise/model_choice.h"
#include "optimise/search.h"

namespace ombre::compile {

// A top-level variable of the script.
struct DesignVariable {
  std::string name;
  double low = 0, high = 1, start = 0.5;
  bool is_whole = false;
  SourceRange where;
};

// A number that is measured of a design.
struct Measure {
  enum class Kind : uint8_t {
    volume,        // mm3
    mass,          // g
    share,         // share of a material in the volume, 0 to 1
    displacement,  // the greatest, mm, or its greatest size along an axis; if `in` is given, only of nodes in the box
    stress,        // the greatest von Mises stress in bricks, MPa; if `in` is given, only of those in the box
    compliance,    // the work of the loads, N mm: displacements times forces
    echo,          // a number that the script prints: echo(cost = 3)
  };
  Kind kind = Kind::volume;
  std::string name;         // name of the material, or of the printed number
  std::optional<int> axis;  // 0 to 2
  std::optional<Box> in;    // mm
  SourceRange where;

  bool needs_solution() const { return kind == Kind::displacement || kind == Kind::stress || kind == Kind::compliance; }
  bool needs_bricks() const { return kind != Kind::echo; }
  std::string label() const;  // "displacement z [mm]"
};

struct Objective {
  Measure measure;
  bool is_maximised = false;
};

struct Limit {
  Measure measure;
  bool is_upper = true;
  double value = 0;
};

struct OptimiseStudy {
  std::vector<DesignVariable> variables;
  std::vector<Objective> objectives;
  std::vector<Limit> limits;
  std::optional<ModelChoice> model;  // set if a measure needs bricks
  optimise::SearchOptions search;

  std::vector<Measure> measures() const;  // measures of objectives, then of limits
  bool needs_solution() const;
};

// {"variables": {"width": {"from": 2, "to": 10, "start": 5}, "ribs": {"from": 1, "to": 6, "whole": true}},
//  "objectives": [{"minimise": "mass"}],
//  "constraints": [{"measure": "displacement", "axis": "z", "at_most": 0.5}],
//  "fea": "pull.json", "cell": 1, "method": "cobyla", "evaluations": 100}
// "fea" is a study of `ombre fea`, or the name of its file, beside this one. Returns nothing, and adds
// diagnostics with places, when it is wrong. Throws Error for a file that cannot be read.
std::optional<OptimiseStudy> read_optimise_study(const Data& data, Diagnostics& diagnostics);

}  // namespace ombre::compile
