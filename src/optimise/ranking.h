// Ranks points: which of many are best.
#pragma once

#include <cstddef>
#include <vector>

#include "optimise/search.h"

namespace ombre::optimise {

bool is_feasible(const Outcome& outcome);

// The points whose constraints hold and that no other one beats in all objectives, by the first objective; of equal
// ones the first.
std::vector<size_t> front_of(const std::vector<Outcome>& outcomes);

}  // namespace ombre::optimise
