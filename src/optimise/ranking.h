// Finds the best of many points.
#pragma once

#include <cstddef>
#include <vector>

#include "optimise/search.h"

namespace ombre::optimise {

bool is_feasible(const Outcome& outcome);

// Returns the points whose constraints hold and that no other one beats in all objectives, sorted by the first
// objective; of equal points the first.
std::vector<size_t> front_of(const std::vector<Outcome>& outcomes);

}  // namespace ombre::optimise
