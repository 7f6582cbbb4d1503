#include "optimise/ranking.h"

#include <algorithm>

namespace ombre::optimise {
namespace {

// Slack of constraints, as a share of the limit: displacements are known to about ten times the residual of 1e-6.
constexpr double slack = 1e-5;

bool beats(const Outcome& a, const Outcome& b) {
  for (size_t n = 0; n < a.objectives.size(); ++n)
    if (a.objectives[n] > b.objectives[n]) return false;
  return a.objectives != b.objectives;
}

}  // namespace

bool is_feasible(const Outcome& outcome) {
  return !outcome.failed && std::ranges::all_of(outcome.excesses, [](double excess) { return excess <= slack; });
}

std::vector<size_t> front_of(const std::vector<Outcome>& outcomes) {
  std::vector<size_t> front;
  for (size_t n = 0; n < outcomes.size(); ++n) {
    if (!is_feasible(outcomes[n])) continue;
    const auto is_better = [&](const Outcome& other) { return is_feasible(other) && beats(other, outcomes[n]); };
    const auto is_known = [&](size_t other) { return outcomes[other].objectives == outcomes[n].objectives; };
    if (std::ranges::none_of(outcomes, is_better) && std::ranges::none_of(front, is_known)) front.push_back(n);
  }
  std::ranges::stable_sort(front, {}, [&](size_t n) { return outcomes[n].objectives.front(); });
  return front;
}

}  // namespace ombre::optimise
