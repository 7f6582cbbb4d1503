#include "formats/slicers/flavour.h"

#include <array>

namespace ombre::formats {
namespace {

struct FlavourRow {
  const char* word;
  std::string_view program;
};

// The rows have the order of the enumeration.
constexpr std::array<FlavourRow, 5> flavour_rows{{{"generic", "any program"},
                                                  {"prusa", "PrusaSlicer"},
                                                  {"bambu", "Bambu Studio"},
                                                  {"orca", "OrcaSlicer"},
                                                  {"snapmaker", "Snapmaker Orca"}}};

const FlavourRow& row_of(SlicerFlavour flavour) { return flavour_rows.at(static_cast<size_t>(flavour)); }

}  // namespace

std::vector<std::string> flavour_words() {
  std::vector<std::string> words;
  for (const FlavourRow& row : flavour_rows) words.emplace_back(row.word);
  return words;
}

std::string flavour_word(SlicerFlavour flavour) { return row_of(flavour).word; }

std::string_view program_of(SlicerFlavour flavour) { return row_of(flavour).program; }

}  // namespace ombre::formats
