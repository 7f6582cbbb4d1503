// Problems whose functions are known only by their values.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ombre::optimise {

// The answer of a problem at a point.
struct Outcome {
  bool failed = false;             // true if the point could not be measured
  std::vector<double> objectives;  // smaller is better
  std::vector<double> excesses;    // excesses of constraints; a constraint holds if its excess is at most 0

  // Returns the sum of violations: 0 if all constraints hold.
  double violation() const {
    double sum = 0;
    for (const double excess : excesses) sum += std::max(excess, 0.0);
    return sum;
  }
};

// A point, with a coordinate from 0 to 1 for each variable.
using Point = std::vector<double>;

struct Problem {
  Point start;
  size_t objectives = 1, constraints = 0;
  // Returns the outcomes of several points, in their order. An exception ends the search.
  std::function<std::vector<Outcome>(const std::vector<Point>&)> evaluate;
};

struct SearchOptions {
  std::string method = "cobyla";
  size_t evaluations = 200;  // greatest number of evaluations
  size_t population = 24;    // for nsga2 and cmaes
  uint32_t seed = 0;         // for nsga2 and cmaes
  double tolerance = 1e-4;   // change of coordinates at which cobyla and bobyqa end
};

}  // namespace ombre::optimise
