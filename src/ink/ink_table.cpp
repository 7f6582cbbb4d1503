#include "ink/ink_table.h"

#include <algorithm>
#include <numeric>

#include "base/math/math.h"

namespace ombre::ink {
namespace {

constexpr size_t steps = InkTable::steps;

// Returns `count` colours along each axis, of which the first is at `first` and neighbours are a step of the grid
// apart.
std::vector<Vec3> grid_colours(size_t count, double first) {
  constexpr double spacing = 1.0 / (steps - 1);
  std::vector<Vec3> colours;
  const auto at = [&](size_t n) { return first + static_cast<double>(n) * spacing; };
  for (size_t red = 0; red < count; ++red)
    for (size_t green = 0; green < count; ++green)
      for (size_t blue = 0; blue < count; ++blue) colours.push_back({at(red), at(green), at(blue)});
  return colours;
}

// Returns what is interpolated in the middle of each cell of the grid: the mean of its eight corners.
std::vector<double> shares_between(const std::vector<double>& shares, size_t channels) {
  constexpr size_t cells = steps - 1;
  std::vector<double> between;
  for (size_t red = 0; red < cells; ++red)
    for (size_t green = 0; green < cells; ++green)
      for (size_t blue = 0; blue < cells; ++blue)
        for (size_t channel = 0; channel < channels; ++channel) {
          double sum = 0;
          for (size_t corner = 0; corner < 8; ++corner) {
            const size_t at = ((red + corner / 4) * steps + green + corner / 2 % 2) * steps + blue + corner % 2;
            sum += shares[at * channels + channel];
          }
          between.push_back(sum / 8);
        }
  return between;
}

double greatest_sum(const std::vector<double>& shares, size_t channels) {
  double greatest = 0;
  for (size_t n = 0; n < shares.size(); n += channels)
    greatest = std::max(greatest, std::accumulate(shares.begin() + static_cast<ptrdiff_t>(n),
                                                  shares.begin() + static_cast<ptrdiff_t>(n + channels), 0.0));
  return greatest;
}

void measure_error(const Profile& profile, const Rendering& rendering, const std::vector<double>& shares, int threads,
                   InkTable& table) {
  const size_t inks = table.inks();
  std::vector<double> exact = shares_of(profile, rendering, grid_colours(steps - 1, 0.5 / (steps - 1)), threads);
  divide_above_one(exact, inks);
  const auto wanted = colours_of(profile, rendering.intent, exact, threads);
  const auto given = colours_of(profile, rendering.intent, shares_between(shares, inks), threads);
  for (size_t n = 0; n < wanted.size(); ++n) {
    const double error = ciede2000(wanted[n], given[n]);
    table.mean_error += error / static_cast<double>(wanted.size());
    table.worst_error = std::max(table.worst_error, error);
  }
}

}  // namespace

double divide_above_one(std::span<double> shares) {
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  if (sum > 1)
    for (double& share : shares) share /= sum;
  return sum;
}

void divide_above_one(std::span<double> shares, size_t channels) {
  for (size_t n = 0; n < shares.size(); n += channels) divide_above_one(shares.subspan(n, channels));
}

InkTable make_ink_table(const Profile& profile, const Rendering& rendering, int threads) {
  const std::vector<Vec3> colours = grid_colours(steps, 0);
  std::vector<double> shares = shares_of(profile, rendering, colours, threads);
  const size_t inks = shares.size() / colours.size();
  InkTable table;
  table.most_ink = greatest_sum(shares, inks);
  divide_above_one(shares, inks);
  table.values.resize(inks + 1);
  const std::vector<Lab> shown = colours_of(profile, rendering.intent, shares, threads);
  for (size_t n = 0; n < colours.size(); ++n) {
    for (size_t ink = 0; ink < inks; ++ink) table.values[ink].push_back(shares[n * inks + ink]);
    table.values[inks].push_back(ciede2000(lab_of_srgb(colours[n]), shown[n]));
  }
  measure_error(profile, rendering, shares, threads, table);
  return table;
}

}  // namespace ombre::ink
