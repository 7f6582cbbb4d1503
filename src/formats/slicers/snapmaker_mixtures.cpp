#include "formats/slicers/snapmaker_mixtures.h"

#include "base/system/assert.h"
#include "base/text/text.h"

namespace ombre::formats {
namespace {

// A row has both filaments, whether it is in use, whether a user made it, and the percentage of the second filament.
// Members with letters follow. There is no gradient (0, g, w), and layers change between two filaments (m2) without
// thinner ones (z0) or offsets (xa, xb). The last members say whether the row is deleted (d), whether the program made
// it (o), and its identity (u).
std::string row(uint32_t first, uint32_t second, bool is_used, long percent, size_t identity) {
  const std::string used = is_used ? "1" : "0", unused = is_used ? "0" : "1";
  return std::to_string(first) + ',' + std::to_string(second) + ',' + used + ',' + used + ',' +
         std::to_string(percent) + ",0,g,w,m2,z0,xa0,xb0,d" + unused + ",o" + unused + ",u" + std::to_string(identity);
}

// Returns how a pattern names a part of the mixture.
char name_of(const FilamentMixture& mixture, size_t part) {
  constexpr size_t parts_of_row = 2;
  const auto number = part < parts_of_row ? static_cast<uint32_t>(part + 1) : mixture.parts[part].extruder;
  ASSERT(number <= most_in_pattern);
  return static_cast<char>('0' + number);
}

int layers_from(const FilamentMixture& mixture, size_t part) {
  int layers = 0;
  for (; part < mixture.parts.size(); ++part) layers += mixture.parts[part].layers;
  return layers;
}

// Returns which filament each layer of a cycle has, of this part of the mixture and those after it, spread evenly.
std::string pattern_from(const FilamentMixture& mixture, size_t part) {
  const int layers = layers_from(mixture, part), own = mixture.parts[part].layers;
  const std::string others = own < layers ? pattern_from(mixture, part + 1) : "";
  std::string pattern;
  for (int layer = 0, other = 0; layer < layers; ++layer) {
    const bool is_own = (layer + 1) * own / layers > layer * own / layers;
    pattern += is_own ? name_of(mixture, part) : others[static_cast<size_t>(other++)];
  }
  return pattern;
}

std::string row_of(const FilamentMixture& mixture, size_t identity) {
  const FilamentMixture::Part &one = mixture.parts[0], &two = mixture.parts[1];
  const int layers = layers_from(mixture, 0);
  ASSERT(layers > 0);
  const long percent = (200L * two.layers + layers) / (2L * layers);  // to the nearest
  return row(one.extruder, two.extruder, true, percent, identity) + ',' + pattern_from(mixture, 0);
}

}  // namespace

std::string snapmaker_mixtures(std::span<const FilamentMixture> mixtures) {
  std::vector<std::string> rows;
  for (const FilamentMixture& mixture : mixtures) rows.push_back(row_of(mixture, rows.size() + 1));
  // The programs may make a mixture of each pair of filaments by themselves; this one stays deleted.
  const FilamentMixture& last = mixtures.back();
  rows.push_back(row(last.parts[0].extruder, last.parts[1].extruder, false, 50, rows.size() + 1));
  return join(rows, ";");
}

}  // namespace ombre::formats
