#include "nodes/values/colour_table.h"

#include <cmath>

#include "base/math/srgb.h"
#include "base/system/assert.h"
#include "nodes/common/number_table.h"

namespace ombre::nodes {
namespace {

std::vector<double> colour_axis(size_t steps) {
  std::vector<double> axis;
  for (size_t n = 0; n < steps; ++n) axis.push_back(static_cast<double>(n) / static_cast<double>(steps - 1));
  return axis;
}

}  // namespace

program::SourceField make_colour_source(std::vector<std::vector<double>> outputs) {
  const auto steps = static_cast<size_t>(std::lround(std::cbrt(static_cast<double>(outputs.front().size()))));
  ASSERT(steps * steps * steps == outputs.front().size());
  const std::vector<double> axis = colour_axis(steps);
  return make_table({{axis, axis, axis}, std::move(outputs)}, TableMode::linear);
}

program::SourceField make_colour_table(const ink::ColourMixer& mixer, size_t materials) {
  constexpr size_t steps = 33;
  const std::vector<double> axis = colour_axis(steps);
  std::vector<std::vector<double>> outputs(materials);
  for (const double red : axis)
    for (const double green : axis)
      for (const double blue : axis) {
        const auto shares = mixer.shares({linear_of_srgb(red), linear_of_srgb(green), linear_of_srgb(blue)});
        for (size_t n = 0; n < materials; ++n) outputs[n].push_back(shares[n]);
      }
  return make_colour_source(std::move(outputs));
}

}  // namespace ombre::nodes
