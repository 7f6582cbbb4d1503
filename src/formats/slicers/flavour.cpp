#include "formats/slicers/flavour.h"

#include <array>

namespace ombre::formats {
namespace {

struct FlavourRow {
  const char* word;
  std::string_view program;
  size_t most_extruders;  // with mixtures
};

// The rows have the order of the enumeration. PrusaSlicer 2.9.6 counts to TRIANGLE_STATE_TYPE_COUNT - 1, Snapmaker Orca
// to MAXIMUM_FILAMENT_NUMBER.
constexpr std::array<FlavourRow, 5> flavour_rows{{{"generic", "any program", most_filaments},
                                                  {"prusa", "PrusaSlicer", 255},
                                                  {"bambu", "Bambu Studio", most_filaments},
                                                  {"orca", "OrcaSlicer", most_filaments},
                                                  {"snapmaker", "Snapmaker Orca", 64}}};

const FlavourRow& row_of(SlicerFlavour flavour) { return flavour_rows.at(static_cast<size_t>(flavour)); }

}  // namespace

std::vector<std::string> flavour_words() {
  std::vector<std::string> words;
  for (const FlavourRow& row : flavour_rows) words.emplace_back(row.word);
  return words;
}

std::string flavour_word(SlicerFlavour flavour) { return row_of(flavour).word; }

std::string_view program_of(SlicerFlavour flavour) { return row_of(flavour).program; }

size_t most_extruders(SlicerFlavour flavour) { return row_of(flavour).most_extruders; }

}  // namespace ombre::formats
