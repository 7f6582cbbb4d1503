// How a design is cut into regions, and how finely: the arguments that meshes and contours share.
#include "ombre/region_arguments.h"

#include <algorithm>
#include <functional>

#include "base/pitch.h"
#include "base/text.h"
#include "ombre/arguments.h"
#include "ombre/checks.h"
#include "ombre/commands.h"

namespace ombre::cli {
namespace {

std::optional<double> length_of(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::optional<Pitch> length = Pitch::parse(text);
  if (!length)
    throw WrongArgument(option + " " + text + " is not a length; write for example " + option + " 0.05 (mm)");
  return length->mm();
}

std::vector<double> borders_of(const std::string& text) {
  if (text.empty()) return {};
  const std::vector<double> borders = parse_numbers(text);
  const bool rises = std::ranges::adjacent_find(borders, std::greater_equal<>()) == borders.end();
  if (!borders.empty() && rises) return borders;
  throw WrongArgument("--borders " + text + " are not rising numbers; write for example --borders 0.25,0.5,0.75");
}

}  // namespace

void add_region_arguments(CLI::App& app, RegionArguments& a, const std::string& piece) {
  app.add_option("--tolerance", a.tolerance,
                 "Largest distance to the design's surface; mm (default: a thousandth of its longest side)")
      ->type_name("MM");
  app.add_option("--cell", a.cell, "Edge of the smallest cells; mm (default: 4 times the tolerance)")->type_name("MM");
  app.add_option(
         "--by", a.by,
         piece +
             " for each of the materials or named parts, or for bands of a material's fraction or an attribute; of\n"
             "several, with commas, for each combination of their bands")
      ->type_name("materials|parts|NAME");
  auto* bands =
      app.add_option("--bands", a.bands, "Number of bands of equal width (default 4, of the fraction that varies most)")
          ->check(whole_between(2, 1000))
          ->type_name("N");
  app.add_option("--borders", a.borders, "Values between bands: fractions from 0 to 1, or the attribute's")
      ->excludes(bands)
      ->type_name("V1,V2,...");
}

compile::RegionRequest region_request(const RegionArguments& a) {
  compile::RegionRequest request;
  request.tolerance_mm = length_of("--tolerance", a.tolerance);
  request.cell_mm = length_of("--cell", a.cell);
  request.by_material = a.by == "materials";
  request.by_part = a.by == "parts";
  const std::vector<double> borders = borders_of(a.borders);
  const bool has_bands = a.bands > 0 || !borders.empty();
  const bool is_without_bands = request.by_material || request.by_part;
  if (is_without_bands && has_bands)
    throw WrongArgument("--by " + a.by +
                        " has no bands; leave out --bands and --borders, or name a material: --by red");
  if (!has_bands && (a.by.empty() || is_without_bands)) return request;
  const std::vector<std::string> names = split(a.by, ',');
  if (names.size() > 1 && !borders.empty())
    throw WrongArgument("--borders are those of one value; with --by " + a.by + " write --bands, the number for each");
  const auto bands_of = [&](const std::string& name) {
    return compile::BandRequest{a.bands > 0 ? a.bands : 4, borders, std::string(trim(name))};
  };
  request.bands = bands_of(names.front());
  for (size_t n = 1; n < names.size(); ++n) request.crossed.push_back(bands_of(names[n]));
  return request;
}

}  // namespace ombre::cli
