#include "jobs/common/region_options.h"

#include <algorithm>
#include <functional>

#include "base/text/text.h"

namespace ombre::compile {

std::vector<double> parse_borders(const std::string& text, const std::string& name) {
  const std::vector<double> borders = options::parse_numbers(text);
  const bool rises = std::ranges::adjacent_find(borders, std::greater_equal<>()) == borders.end();
  if (!borders.empty() && rises) return borders;
  throw options::WrongValue(name + " " + text + " are not rising numbers; write for example " + name +
                            " 0.25,0.5,0.75");
}

std::vector<double> parse_distances(const std::string& text, const std::string& name) {
  const std::vector<double> distances = options::parse_numbers(text);
  if (!distances.empty() && std::ranges::all_of(distances, [](double one) { return one > 0; })) return distances;
  throw options::WrongValue(name + " " + text + " are not positive numbers; write for example " + name + " 5");
}

RegionRequest RegionOptions::request() const {
  RegionRequest request;
  request.tolerance_mm = tolerance_mm;
  request.cell_mm = cell_mm;
  request.by_material = by == "materials";
  request.by_part = by == "parts";
  const bool is_without_bands = request.by_material || request.by_part || by == "whole";
  if (is_without_bands && has_bands())
    throw options::WrongValue("--by " + by + " has no bands; leave out " + spelled::option("--bands") + " and " +
                              spelled::option("--borders") + ", or name a material: " + spelled::option("--by", "red"));
  if (!has_bands() && (by.empty() || is_without_bands)) return request;
  const std::vector<std::string> names = split(by, ',');
  if (names.size() > 1 && !borders.empty())
    throw options::WrongValue(spelled::option("--borders") + " are those of one value; with " +
                              spelled::option("--by", by) + " write " + spelled::option("--bands") +
                              ", the number for each");
  if (within.size() > 1 && within.size() != names.size())
    throw options::WrongValue(spelled::option("--within") + " has " + std::to_string(within.size()) + " numbers for " +
                              std::to_string(names.size()) + " names; write one for all, or one for each");
  const auto bands_of = [&](size_t n) {
    return BandRequest{bands > 0 ? bands : 4, borders, std::string(trim(names[n])), within_of(n)};
  };
  request.bands = bands_of(0);
  for (size_t n = 1; n < names.size(); ++n) request.crossed.push_back(bands_of(n));
  return request;
}

}  // namespace ombre::compile
