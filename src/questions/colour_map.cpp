#include "questions/colour_map.h"

#include <algorithm>
#include <cmath>

#include "render/shade.h"

namespace ombre::compile {
namespace {

using program::Field;

constexpr size_t steps = std::tuple_size_v<decltype(Palette::colours)> - 1;

// Converts a table of hexadecimal colours.
constexpr std::array<design::Rgba, 9> table(std::array<uint32_t, 9> colours) {
  std::array<design::Rgba, 9> result{};
  for (size_t n = 0; n < colours.size(); ++n)
    result[n] = {static_cast<uint8_t>(colours[n] >> 16), static_cast<uint8_t>(colours[n] >> 8 & 255),
                 static_cast<uint8_t>(colours[n] & 255), 255};
  return result;
}

// A helix around the grays with the start 0.5, -1.5 turns, and the hue 1, by D. A. Green, "A colour scheme for the
// display of astronomical intensity images", 2011.
std::array<design::Rgba, 9> cubehelix() {
  constexpr double start = 0.5, turns = -1.5, pi = 3.14159265358979323846;
  constexpr double across[3][2] = {{-0.14861, 1.78277}, {-0.29227, -0.90649}, {1.97294, 0}};
  std::array<design::Rgba, 9> result{};
  for (size_t n = 0; n < result.size(); ++n) {
    const double share = static_cast<double>(n) / steps, angle = 2 * pi * (start / 3 + 1 + turns * share);
    const double reach = share * (1 - share) / 2;
    for (size_t c = 0; c < 3; ++c) {
      const double level = share + reach * (across[c][0] * std::cos(angle) + across[c][1] * std::sin(angle));
      result[n][c] = static_cast<uint8_t>(std::lround(255 * std::clamp(level, 0.0, 1.0)));
    }
    result[n][3] = 255;
  }
  return result;
}

// Sources of the tables: viridis, plasma, inferno and magma are by S. van der Walt and N. Smith, 2015, in the public
// domain (CC0); coolwarm is by K. Moreland, "Diverging color maps for scientific visualization", 2009.
const std::array<Palette, 7> all_palettes{{
    {"viridis", table({0x440154, 0x472C7A, 0x3B518B, 0x2C718E, 0x21908D, 0x27AD81, 0x5CC863, 0xAADC32, 0xFDE725})},
    {"plasma", table({0x0D0887, 0x4C02A1, 0x7E03A8, 0xAA2395, 0xCC4778, 0xE66C5C, 0xF89540, 0xFDC527, 0xF0F921})},
    {"inferno", table({0x000004, 0x210C4A, 0x57106E, 0x8A226A, 0xBC3754, 0xE45A31, 0xF98E09, 0xF9CB35, 0xFCFFA4})},
    {"magma", table({0x000004, 0x1D1147, 0x51127C, 0x822681, 0xB73779, 0xE75263, 0xFC8961, 0xFEC488, 0xFCFDBF})},
    {"coolwarm", table({0x3B4CC0, 0x6282EA, 0x8DB0FE, 0xB8D0F9, 0xDDDDDD, 0xF5C4AD, 0xF49A7B, 0xDE604D, 0xB40426})},
    {"cubehelix", cubehelix()},
    {"gray", table({0x000000, 0x202020, 0x404040, 0x606060, 0x808080, 0xA0A0A0, 0xC0C0C0, 0xE0E0E0, 0xFFFFFF})},
}};

}  // namespace

std::span<const Palette> palettes() { return all_palettes; }

std::vector<std::string> palette_names() {
  std::vector<std::string> names;
  for (const Palette& palette : all_palettes) names.emplace_back(palette.name);
  return names;
}

const Palette* palette_called(std::string_view name) {
  const auto found = std::ranges::find(all_palettes, name, &Palette::name);
  return found == all_palettes.end() ? nullptr : &*found;
}

std::span<const design::Rgba> label_colours() {
  static constexpr design::Rgba colours[] = {{205, 205, 205, 255}, {0, 114, 178, 255},   {230, 159, 0, 255},
                                             {0, 158, 115, 255},   {204, 121, 167, 255}, {86, 180, 233, 255},
                                             {213, 94, 0, 255},    {240, 228, 66, 255},  {90, 90, 90, 255}};
  return colours;
}

design::Rgba label_colour(size_t label) {
  const auto colours = label_colours();
  return label == 0 ? colours[0] : colours[1 + (label - 1) % (colours.size() - 1)];
}

design::Rgba map_colour(double share, const Palette& palette) {
  const double place = std::clamp(share, 0.0, 1.0) * steps;
  const auto below = std::min(static_cast<size_t>(place), steps - 1);
  const auto part = static_cast<float>(place - static_cast<double>(below));
  const render::Colour from = render::linear(palette.colours[below]), to = render::linear(palette.colours[below + 1]);
  const auto mixed = [&](float render::Colour::*channel) {
    return from.*channel + part * (to.*channel - from.*channel);
  };
  render::Colour colour;
  for (const auto channel : {&render::Colour::red, &render::Colour::green, &render::Colour::blue})
    colour.*channel = mixed(channel);
  return render::encoded(colour);
}

std::array<Field, 3> mapped_colour(Field value, Interval range, const Palette& palette) {
  program::Builder& builder = *value.builder;
  const double width = range.hi > range.lo ? range.hi - range.lo : 1;
  const Field place = min(max((value - range.lo) * (steps / width), 0.0), builder.constant(steps));
  const auto channel = [&](float render::Colour::*part) {
    const auto at = [&](size_t n) { return static_cast<double>(render::linear(palette.colours[n]).*part); };
    // The sum of ramps is piecewise linear: its slope changes at each colour.
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
