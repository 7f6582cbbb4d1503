#include "ink/droplet_model.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/math/math.h"
#include "base/system/assert.h"
#include "base/system/tasks.h"
#include "ink/ink_table.h"

namespace ombre::ink {
namespace {

constexpr double all = 1 - 1e-6;  // a share from which on a material is alone

double distance_squared(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (size_t n = 0; n < a.size(); ++n) sum += math::square(a[n] - b[n]);
  return sum;
}

Vec3 each_power(const Vec3& v, double exponent) {
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis) result[axis] = v[axis] > 0 ? math::pow(v[axis], exponent) : 0;
  return result;
}

// Steps along each ink, so that a table has some 10^5 colours at most.
size_t steps_of_inks(size_t inks) {
  constexpr std::array<size_t, 9> steps{0, 256, 65, 21, 17, 9, 7, 5, 4};
  return steps[inks];
}

// Returns the shares of the inks at a place of a table, in which the last ink's varies fastest.
std::vector<double> combination(size_t number, size_t inks, size_t steps) {
  std::vector<double> shares(inks);
  for (size_t n = inks; n-- > 0; number /= steps)
    shares[n] = static_cast<double>(number % steps) / static_cast<double>(steps - 1);
  return shares;
}

// Returns what inks show at a place of a table with this spacing. Shares that add up to more than 1 are never printed,
// but they are corners of cells that are partly printed. The line from white through the shares goes on there, so that
// the table interpolates well up to a sum of 1.
Lab colour_in_table(const DropletModel& model, std::vector<double> shares, double spacing) {
  const double beyond = divide_above_one(shares) - 1;
  std::vector<double> whiter = shares;
  shares.push_back(math::max(0, -beyond));
  const Lab colour = model.colour(shares);
  if (!(beyond > 0)) return colour;
  for (double& share : whiter) share *= 1 - spacing;
  whiter.push_back(spacing);
  const double steps_beyond = math::min(beyond / spacing, static_cast<double>(shares.size()));
  Lab continued = colour + steps_beyond * (colour - model.colour(whiter));
  continued.x = std::clamp(continued.x, 0.0, 100.0);
  return continued;
}

size_t power(size_t base, size_t exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

}  // namespace

std::optional<size_t> DropletModel::missing_alone(const std::vector<Patch>& patches) {
  const size_t materials = patches.front().shares.size();
  for (size_t n = 0; n < materials; ++n)
    if (std::ranges::none_of(patches, [&](const Patch& patch) { return patch.shares[n] > all; })) return n;
  return std::nullopt;
}

DropletModel::DropletModel(std::vector<Patch> patches) : patches_(std::move(patches)) {
  ASSERT(!patches_.empty() && !missing_alone(patches_));
  for (size_t n = 0; n < patches_.front().shares.size(); ++n)
    alone_.push_back(static_cast<size_t>(
        std::ranges::find_if(patches_, [&](const Patch& patch) { return patch.shares[n] > all; }) - patches_.begin()));
  fit();
}

// Chooses n, and keeps what the mean of light misses then.
void DropletModel::fit() {
  const auto take = [&](double n) {
    n_ = n;
    light_.clear();
    for (const size_t patch : alone_) light_.push_back(powers_of(patches_[patch].colour));
  };
  double best = 1, least = std::numeric_limits<double>::infinity();
  constexpr int most_quarters = 40;
  for (int quarters = 4; quarters <= most_quarters; ++quarters) {
    take(quarters / 4.0);
    double sum = 0;
    for (const Patch& patch : patches_) sum += ciede2000(mean_of_light(patch.shares), patch.colour);
    if (sum < least) best = n_;
    least = std::min(sum, least);
  }
  take(best);
  for (const Patch& patch : patches_) misses_.push_back(patch.colour - mean_of_light(patch.shares));
  mixer_.emplace(light_, Vec3{0, 1, 0});
}

Vec3 DropletModel::powers_of(const Lab& lab) const { return each_power(xyz_of_lab(lab), 1 / n_); }

Lab DropletModel::mean_of_light(std::span<const double> shares) const {
  Vec3 sum{};
  for (size_t n = 0; n < shares.size(); ++n) sum = sum + shares[n] * light_[n];
  return lab_of_xyz(each_power(sum, n_));
}

Lab DropletModel::corrected(std::span<const double> shares, std::optional<size_t> left_out) const {
  Vec3 miss{};
  double weights = 0;
  for (size_t n = 0; n < patches_.size(); ++n) {
    if (n == left_out) continue;
    const double square = distance_squared(shares, patches_[n].shares);
    if (square < 1e-18) return mean_of_light(shares) + misses_[n];
    const double weight = 1 / (square * square);
    miss = miss + weight * misses_[n];
    weights += weight;
  }
  return mean_of_light(shares) + (1 / weights) * miss;
}

Lab DropletModel::colour(std::span<const double> shares) const { return corrected(shares, std::nullopt); }

std::vector<double> DropletModel::shares(const Lab& wanted, const std::vector<double>& near) const {
  constexpr int most_rounds = 12;
  constexpr double enough = 0.02;
  std::vector<double> best;
  double least = std::numeric_limits<double>::infinity();
  // The mean of light is queried for another colour, moved by what it misses at the shares that are found.
  Lab queried = wanted;
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<double> found = mixer_->shares(powers_of(queried));
    const Lab miss = wanted - colour(found);
    if (length(miss) < least) best = found;
    least = std::min(length(miss), least);
    if (least < enough) break;
    queried = queried + miss;
    queried.x = std::clamp(queried.x, 0.0, 100.0);
  }
  constexpr double seen = 0.5;
  if (least < seen) return best;
  std::vector<std::vector<double>> starts{best};
  if (!near.empty()) starts.push_back(near);
  for (size_t n = 0; n < materials(); ++n) {
    starts.emplace_back(materials(), 0.0);
    starts.back()[n] = 1;
  }
  return nearest(wanted, std::move(starts));
}

// Moves shares from one material to another, in smaller and smaller steps, as long as the colour comes nearer.
std::vector<double> DropletModel::nearest(const Lab& wanted, std::vector<std::vector<double>> starts) const {
  constexpr double first_step = 0.125, last_step = 0.002;
  const auto light_of = [&](const std::vector<double>& shares) {
    Vec3 sum{};
    for (size_t n = 0; n < shares.size(); ++n) sum = sum + shares[n] * light_[n];
    return sum;
  };
  const auto miss = [&](const Vec3& light) { return length(lab_of_xyz(each_power(light, n_)) - wanted); };
  std::vector<double> shares = *std::ranges::min_element(starts, {}, [&](const auto& s) { return miss(light_of(s)); });
  Vec3 light = light_of(shares);
  double least = miss(light);
  const auto comes_nearer = [&](size_t from, size_t to, double step) {
    const double moved = math::min(step, shares[from]);
    if (from == to || !(moved > 0)) return false;
    const Vec3 there = light + moved * (light_[to] - light_[from]);
    const double left = miss(there);
    if (!(left < least - 1e-6)) return false;
    shares[from] -= moved;
    shares[to] += moved;
    light = there;
    least = left;
    return true;
  };
  for (double step = first_step; step > last_step; step /= 2)
    for (bool is_nearer = true; is_nearer;) {
      is_nearer = false;
      for (size_t from = 0; from < shares.size(); ++from)
        for (size_t to = 0; to < shares.size(); ++to) is_nearer = comes_nearer(from, to, step) || is_nearer;
    }
  return shares;
}

ModelError DropletModel::error() const {
  std::vector<std::pair<double, size_t>> errors;
  for (size_t n = 0; n < patches_.size(); ++n)
    if (std::ranges::find(alone_, n) == alone_.end())
      errors.emplace_back(ciede2000(corrected(patches_[n].shares, n), patches_[n].colour), n);
  if (errors.empty()) return {};
  std::ranges::sort(errors);
  ModelError error{0, errors[(errors.size() - 1) * 95 / 100].first, errors.back().first, errors.back().second};
  for (const auto& [difference, patch] : errors) error.mean += difference / static_cast<double>(errors.size());
  return error;
}

ProfileTables tables_of(const DropletModel& model, const std::string& description, int threads) {
  ProfileTables tables;
  tables.description = description;
  tables.copyright = "made from measured patches by Ombre";
  tables.inks = model.materials() - 1;
  tables.white = xyz_of_lab(model.rest());
  const auto relative = [&](const Lab& lab) {
    const Vec3 xyz = xyz_of_lab(lab);
    return lab_of_xyz({xyz.x / tables.white.x, xyz.y / tables.white.y, xyz.z / tables.white.z});
  };
  const auto absolute = [&](const Lab& lab) {
    const Vec3 xyz = xyz_of_lab(lab);
    return lab_of_xyz({xyz.x * tables.white.x, xyz.y * tables.white.y, xyz.z * tables.white.z});
  };

  tables.ink_steps = steps_of_inks(tables.inks);
  tables.colours.resize(power(tables.ink_steps, tables.inks));
  run_parallel(tables.ink_steps, threads, [&](size_t slice) {
    const size_t count = tables.colours.size() / tables.ink_steps;
    for (size_t n = slice * count; n < (slice + 1) * count; ++n)
      tables.colours[n] = relative(colour_in_table(model, combination(n, tables.inks, tables.ink_steps),
                                                   1 / static_cast<double>(tables.ink_steps - 1)));
  });

  tables.lab_steps = 29;
  const size_t steps = tables.lab_steps;
  tables.shares.resize(steps * steps * steps * tables.inks);
  run_parallel(steps, threads, [&](size_t lightness) {
    const auto step = [&](size_t n) { return static_cast<double>(n) / static_cast<double>(steps - 1); };
    const auto chroma_at = [&](size_t n) { return (step(n) < 0.5 ? 256 : 254) * (step(n) - 0.5); };
    std::vector<double> found;
    for (size_t n = 0; n < steps * steps; ++n) {
      const Lab wanted{100 * step(lightness), chroma_at(n / steps), chroma_at(n % steps)};
      found = model.shares(absolute(wanted), found);
      std::copy_n(found.begin(), tables.inks,
                  tables.shares.begin() + static_cast<ptrdiff_t>((lightness * steps * steps + n) * tables.inks));
    }
  });
  return tables;
}

}  // namespace ombre::ink
