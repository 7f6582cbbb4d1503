#include "ink/colour_mixer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "base/math/math.h"
#include "base/system/assert.h"

namespace ombre::ink {
namespace {

// Returns vectors in the span of the given ones, each of which has product 1 with one of them and 0 with the others.
// Returns nothing if the given ones are linearly dependent.
std::optional<std::vector<Vec3>> dual_basis(const std::vector<Vec3>& e) {
  constexpr double least = 1e-12;  // squared lengths, areas and volumes of colours
  if (e.empty()) return std::vector<Vec3>{};
  if (e.size() == 1) {
    const double square = dot(e[0], e[0]);
    return square < least ? std::nullopt : std::optional(std::vector{(1 / square) * e[0]});
  }
  const Vec3 normal = cross(e[0], e[1]);
  if (e.size() == 2) {
    const double square = dot(normal, normal);
    if (square < least) return std::nullopt;
    return std::vector{(1 / square) * cross(e[1], normal), (1 / square) * cross(normal, e[0])};
  }
  const double volume = dot(normal, e[2]);
  if (volume * volume < least) return std::nullopt;
  return std::vector{(1 / volume) * cross(e[1], e[2]), (1 / volume) * cross(e[2], e[0]), (1 / volume) * normal};
}

}  // namespace

ColourMixer::ColourMixer(std::vector<Vec3> colours, const Vec3& weights)
    : colours_(std::move(colours)), weights_(weights) {
  ASSERT(!colours_.empty() && colours_.size() <= most_materials);
  add_groups({}, 0);
}

void ColourMixer::add_groups(std::vector<size_t> members, size_t next) {
  if (!members.empty()) {
    std::vector<Vec3> edges;
    for (size_t n = 1; n < members.size(); ++n) edges.push_back(colours_[members[n]] - colours_[members[0]]);
    const auto slopes = dual_basis(edges);
    if (!slopes) return;
    groups_.push_back({members, *slopes});
  }
  if (members.size() == 4) return;
  for (size_t n = next; n < colours_.size(); ++n) {
    members.push_back(n);
    add_groups(members, n + 1);
    members.pop_back();
  }
}

std::vector<double> ColourMixer::shares(Vec3 colour) const {
  constexpr double slack = 1e-9, same = 1e-14;
  double least_error = std::numeric_limits<double>::infinity(), least_variation = least_error;
  std::vector<double> best(colours_.size());
  for (const Group& group : groups_) {
    const Vec3 origin = colours_[group.members[0]], rest = colour - origin;
    std::array<double, 4> share{1, 0, 0, 0};
    for (size_t n = 0; n < group.slopes.size(); ++n) {
      share[n + 1] = dot(group.slopes[n], rest);
      share[0] -= share[n + 1];
    }
    if (*std::min_element(share.begin(), share.end()) < -slack) continue;
    Vec3 shown{};
    double variation = 0;
    for (size_t n = 0; n < group.members.size(); ++n) {
      const Vec3 own = colours_[group.members[n]];
      shown = shown + share[n] * own;
      variation += share[n] * math::square(dot(weights_, own));
    }
    const double error = dot(shown - colour, shown - colour);
    if (error > least_error + same || (error > least_error - same && variation >= least_variation)) continue;
    least_error = std::min(error, least_error);
    least_variation = variation;
    std::fill(best.begin(), best.end(), 0);
    for (size_t n = 0; n < group.members.size(); ++n) best[group.members[n]] = std::max(share[n], 0.0);
  }
  return best;
}

}  // namespace ombre::ink
