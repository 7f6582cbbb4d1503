// Evaluates a design at single points.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "load/loaded.h"

namespace ombre::compile {

struct ProbeResult {
  Vec3 point;  // mm
  bool inside = false;
  double distance = 0;                                      // g, mm; negative inside
  std::vector<std::pair<std::string, double>> composition;  // materials with a fraction above 0; empty outside
  std::vector<std::pair<std::string, double>> attributes;   // every attribute of the design
  std::vector<std::string> parts;                           // parts that contain the point
};

// Probes in double precision. Returns nothing, and adds a diagnostic, when the design is too large.
std::optional<std::vector<ProbeResult>> probe(const Loaded& loaded, const std::vector<Vec3>& points,
                                              Diagnostics& diagnostics);

}  // namespace ombre::compile
