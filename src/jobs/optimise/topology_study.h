// Studies of topology, which ask where a share of a design's material should be.
#pragma once

#include <optional>

#include "base/text/data.h"
#include "base/text/diagnostic.h"
#include "jobs/optimise/optimise_study.h"
#include "optimise/topology.h"

namespace ombre::compile {

struct TopologyStudy {
  ModelChoice model;
  std::optional<fea::Load> goal;  // a force of 1 N along the goal's displacement, at its place
  bool is_greatest = false;       // true if the displacement is maximised
  // Without a radius in the study it is 1.5 bricks, and 0 until the bricks are known.
  optimise::TopologyOptions options;
};

// {"topology": {"volume_fraction": 0.5, "radius": 2.4, "penalty": 3, "steps": 200, "move": 0.2,
//  "change": 0.01, "projection": 16, "displacement": {"on": "xmax", "direction": [0, 0, 1], "goal": "least"}},
//  "fea": "pull.json", "cell": 1}. Returns nothing, and adds diagnostics with places, when it is
// wrong.
std::optional<TopologyStudy> read_topology_study(const Data& data, Diagnostics& diagnostics);

}  // namespace ombre::compile
