// Problems whose functions are only known by their values.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ombre::optimise {

// The answer of a problem at a point.
struct Outcome {
  bool failed = false;             // nothing is known about the point
  std::vector<double> objectives;  // the less, the better
  std::vector<double> excesses;    // of constraints, which hold where the excess is at most 0

  // How far the constraints are from holding: 0 where all of them do.
  double violation() const {
    double sum = 0;
    for (const double excess : excesses) sum += std::max(excess, 0.0);
    return sum;
  }
};

// A point has a coordinate from 0 to 1 for each variable.
using Point = std::vector<double>;

struct Problem {
  Point start;
  size_t objectives = 1, constraints = 0;
  // The outcomes of several points, in their order. May throw; then the search ends with that exception.
  std::function<std::vector<Outcome>(const std::vector<Point>&)> evaluate;
};

struct SearchOptions {
  std::string method = "cobyla";
  size_t evaluations = 200;  // at most
  size_t population = 24;    // of nsga2 and cmaes
  uint32_t seed = 0;         // of nsga2 and cmaes
  double tolerance = 1e-4;   // of coordinates, at which cobyla and bobyqa end
};

}  // namespace ombre::optimise
