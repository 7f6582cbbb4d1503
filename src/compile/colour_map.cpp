#include "compile/colour_map.h"

#include <algorithm>
#include <cmath>

#include "render/shade.h"

namespace ombre::compile {
namespace {

using program::Field;

constexpr std::array<design::Rgba, 9> viridis{{{68, 1, 84, 255},
                                               {71, 44, 122, 255},
                                               {59, 81, 139, 255},
                                               {44, 113, 142, 255},
                                               {33, 144, 141, 255},
                                               {39, 173, 129, 255},
                                               {92, 200, 99, 255},
                                               {170, 220, 50, 255},
                                               {253, 231, 37, 255}}};
constexpr size_t steps = viridis.size() - 1;

}  // namespace

design::Rgba map_colour(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * steps;
  const auto below = std::min(static_cast<size_t>(place), steps - 1);
  const auto part = static_cast<float>(place - static_cast<double>(below));
  const render::Colour from = render::linear(viridis[below]), to = render::linear(viridis[below + 1]);
  const auto mixed = [&](float render::Colour::*channel) {
    return from.*channel + part * (to.*channel - from.*channel);
  };
  render::Colour colour;
  for (const auto channel : {&render::Colour::red, &render::Colour::green, &render::Colour::blue})
    colour.*channel = mixed(channel);
  return render::encoded(colour);
}

std::array<Field, 3> mapped_colour(Field value, Interval range) {
  program::Builder& builder = *value.builder;
  const double width = range.hi > range.lo ? range.hi - range.lo : 1;
  const Field place = min(max((value - range.lo) * (steps / width), 0.0), builder.constant(steps));
  const auto channel = [&](float render::Colour::*part) {
    const auto at = [&](size_t n) { return static_cast<double>(render::linear(viridis[n]).*part); };
    // From colour to colour, the slope changes.
    Field sum = builder.constant(at(0));
    double slope = 0;
    for (size_t n = 0; n < steps; ++n) {
      const double next = at(n + 1) - at(n);
      sum = sum + (next - slope) * max(place - static_cast<double>(n), 0.0);
      slope = next;
    }
    return sum;
  };
  return {channel(&render::Colour::red), channel(&render::Colour::green), channel(&render::Colour::blue)};
}

}  // namespace ombre::compile
