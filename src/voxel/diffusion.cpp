// Error diffusion within one layer, for any number of materials.
#include "voxel/diffusion.h"

#include <algorithm>

#include "base/system/assert.h"

namespace ombre::voxel {
namespace {

constexpr int64_t whole = 65536;  // one voxel

// Weights of error diffusion in sixteenths: ahead along the row, and in the next row behind, straight below and ahead.
constexpr int64_t ahead = 7, sixteenths = 16;
constexpr int64_t below_behind = 3, straight_below = 5, below_ahead = 1;

// A voxel takes this share of the waiting errors, but at most a quarter of a voxel, so that the correction stays
// invisible.
constexpr int64_t waiting_share = 4, most_waiting = whole / 4;

// Range of the noise that is added to each choice, in voxels. It may be white: what it adds to one voxel is subtracted
// from the next ones, so it ends up in high frequencies, as all errors do. With less noise, layers of 50 % become a
// single checkerboard; with more, 10 % gets uneven.
constexpr double noise_span = 0.375;

// Sixteenths of the fraction that count in a choice. If the whole fraction counted, rare materials would start late,
// since half a voxel must be missing first: 2 % would not appear before the 15th row. Counting the error and only part
// of the fraction avoids that and keeps the mean error at zero. This inverts the method of R. Eschbach, K. Knox,
// "Error-diffusion algorithm with edge enhancement", J. Opt. Soc. Am. A 8, 1991.
constexpr int64_t fraction_counts = 7;

}  // namespace

LayerDiffuser::LayerDiffuser(int64_t width, size_t materials, uint64_t seed, int64_t k)
    : width_(width),
      k_(k),
      materials_(materials),
      seed_(seed),
      mixed_(static_cast<size_t>(width) + 2),
      fractions_(static_cast<size_t>(width) * materials),
      errors_(fractions_.size()),
      below_(fractions_.size()),
      waiting_(materials),
      noise_(materials) {
  ASSERT(width > 0 && materials >= 1 && materials <= 256);
}

void LayerDiffuser::row(int64_t j, std::span<const uint8_t> inside, std::span<const uint8_t> inside_next,
                        std::span<const float* const> fractions, std::span<uint8_t> chosen) {
  ASSERT(inside.size() == static_cast<size_t>(width_) && chosen.size() == inside.size());
  ASSERT(inside_next.empty() || inside_next.size() == inside.size());
  ASSERT(fractions.size() == materials_);
  read(inside, fractions, chosen);
  receive();
  // Each material has its own draws, as if its rows belonged to a distant layer.
  for (size_t m = 0; m < materials_; ++m) noise_[m] = row_hash(seed_, j, k_ + (static_cast<int64_t>(m) << 24));
  direction_ = j % 2 == 0 ? 1 : -1;
  const int64_t first = direction_ > 0 ? 0 : width_ - 1;
  for (int64_t n = 0, i = first; n < width_; ++n, i += direction_)
    if (is_mixed(i)) diffuse(i, goes_down(i, inside_next), chosen[static_cast<size_t>(i)]);
}

std::vector<int64_t> LayerDiffuser::carried() const {
  std::vector<int64_t> sums = waiting_;
  for (size_t n = 0; n < below_.size(); ++n) sums[n % materials_] += below_[n];
  return sums;
}

// Rounds the row's fractions, chooses the voxels of a single material, and flags the others as mixed.
void LayerDiffuser::read(std::span<const uint8_t> inside, std::span<const float* const> fractions,
                         std::span<uint8_t> chosen) {
  for (int64_t i = 0; i < width_; ++i) {
    const auto voxel = static_cast<size_t>(i);
    mixed_[voxel + 1] = 0;
    if (inside[voxel] == 0) continue;
    const size_t greatest = read_voxel(i, fractions);
    if (at(fractions_, i)[greatest] == whole)
      chosen[voxel] = static_cast<uint8_t>(greatest);
    else
      mixed_[voxel + 1] = 1;
  }
}

// Returns the index of the greatest fraction. That fraction absorbs rounding errors, so that all sum to one.
size_t LayerDiffuser::read_voxel(int64_t i, std::span<const float* const> fractions) {
  Fixed* rounded = at(fractions_, i);
  Fixed rest = whole;
  size_t greatest = 0;
  for (size_t m = 0; m < materials_; ++m) {
    const float fraction = fractions[m][i];
    rounded[m] = fraction > 0 ? (static_cast<Fixed>(std::min(fraction, 1.0F) * (2 * whole)) + 1) / 2 : 0;
    rest -= rounded[m];
    if (rounded[m] > rounded[greatest]) greatest = m;
  }
  rounded[greatest] += rest;
  return greatest;
}

// Passes the errors of the previous row to the mixed voxels of this one.
void LayerDiffuser::receive() {
  std::fill(errors_.begin(), errors_.end(), 0);
  for (int64_t i = 0; i < width_; ++i) hand_down(i);
  std::fill(below_.begin(), below_.end(), 0);
}

void LayerDiffuser::hand_down(int64_t i) {
  const Fixed* from = at(below_, i);
  if (std::all_of(from, from + materials_, [](Fixed error) { return error == 0; })) return;
  struct Neighbour {
    int64_t voxel, weight;
  };
  // The last receiver, which has the greatest weight, absorbs rounding errors.
  const Neighbour neighbours[] = {{i + direction_, below_ahead}, {i - direction_, below_behind}, {i, straight_below}};
  int64_t weights = 0;
  const Neighbour* last = nullptr;
  for (const Neighbour& n : neighbours) {
    if (!is_mixed(n.voxel)) continue;
    weights += n.weight;
    last = &n;
  }
  for (size_t m = 0; m < materials_; ++m) {
    Fixed rest = from[m];
    for (const Neighbour& n : neighbours) {
      if (!is_mixed(n.voxel)) continue;
      const Fixed share = &n == last ? rest : from[m] * n.weight / weights;
      at(errors_, n.voxel)[m] += share;
      rest -= share;
    }
    waiting_[m] += rest;
  }
}

void LayerDiffuser::take_waiting(Fixed* error) {
  for (size_t m = 0; m < materials_; ++m) {
    const Fixed share = std::clamp(waiting_[m] / waiting_share, -most_waiting, most_waiting);
    error[m] += share;
    waiting_[m] -= share;
  }
}

// Returns the material of the voxel that is most wanting; the first one wins a tie.
size_t LayerDiffuser::most_wanting(int64_t i, const Fixed* errors) const {
  const Fixed* fractions = fractions_.data() + static_cast<size_t>(i) * materials_;
  size_t best = materials_;
  Fixed greatest = 0;
  for (size_t m = 0; m < materials_; ++m) {
    if (fractions[m] <= 0) continue;
    const auto noise = static_cast<Fixed>((hashed_draw(noise_[m], i) * 0x1p-24 - 0.5) * whole * noise_span);
    const Fixed value = errors[m] + fractions[m] * fraction_counts / sixteenths + noise;
    if (best < materials_ && value <= greatest) continue;
    best = m;
    greatest = value;
  }
  return best;
}

// True if one of the three voxels below is inside.
bool LayerDiffuser::goes_down(int64_t i, std::span<const uint8_t> inside_next) const {
  if (inside_next.empty()) return false;
  const auto from = static_cast<size_t>(std::max<int64_t>(i - 1, 0));
  const auto to = static_cast<size_t>(std::min(i + 2, width_));
  return std::any_of(inside_next.begin() + from, inside_next.begin() + to, [](uint8_t is) { return is != 0; });
}

void LayerDiffuser::diffuse(int64_t i, bool down, uint8_t& chosen) {
  Fixed* error = at(errors_, i);
  take_waiting(error);
  const size_t best = most_wanting(i, error);
  chosen = static_cast<uint8_t>(best);
  for (size_t m = 0; m < materials_; ++m) error[m] += at(fractions_, i)[m];
  error[best] -= whole;

  const int64_t next = i + direction_;
  for (size_t m = 0; m < materials_; ++m) {
    const Fixed share = !is_mixed(next) ? 0 : down ? error[m] * ahead / sixteenths : error[m];
    if (share != 0) at(errors_, next)[m] += share;
    (down ? at(below_, i) : waiting_.data())[m] += error[m] - share;
  }
}

}  // namespace ombre::voxel
