// ombre optimise with a study of topology.
#pragma once

#include <string>

#include "base/data.h"
#include "ombre/commands.h"
#include "ombre/job_arguments.h"

namespace ombre::cli {

struct TopologyArguments {
  DesignArguments design;
  std::string folder;
  double memory_bytes = 0;
  int threads = 0;
  bool force = false;
};

// Writes density.nrrd, topology.vcad, history.csv and chart.svg into the folder. Returns an exit code.
int optimise_topology(const TopologyArguments& arguments, const Data& study, Session& session);

}  // namespace ombre::cli
