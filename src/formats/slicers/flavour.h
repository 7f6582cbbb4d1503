// The programs that 3MF files are written for.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

// The target program of a 3MF file; slicers read the material of a region from their own files inside of it.
enum class SlicerFlavour : uint8_t {
  generic,    // any program: an object for each body, together one part, with the settings of PrusaSlicer and Bambu
              // Studio
  prusa,      // PrusaSlicer: a project of one object, whose bodies are ranges of its triangles
  bambu,      // Bambu Studio: a project of one object, whose bodies are components
  orca,       // OrcaSlicer: as for Bambu Studio
  snapmaker,  // Snapmaker Orca and FullSpectrum: as for OrcaSlicer, with mixed filaments in a text of their own
};

// Words for options, in the order of the enumeration, and the names of the programs.
std::vector<std::string> flavour_words();
std::string flavour_word(SlicerFlavour flavour);
std::string_view program_of(SlicerFlavour flavour);

inline bool is_project(SlicerFlavour flavour) { return flavour != SlicerFlavour::generic; }
inline bool is_of_orca(SlicerFlavour flavour) {
  return flavour == SlicerFlavour::orca || flavour == SlicerFlavour::snapmaker;
}
inline bool is_of_bambu(SlicerFlavour flavour) { return flavour == SlicerFlavour::bambu || is_of_orca(flavour); }

// Number of filaments that a project can have.
inline constexpr size_t most_filaments = 16;
// Number of filaments and mixtures together that the program takes in a project with mixtures.
size_t most_extruders(SlicerFlavour flavour);

}  // namespace ombre::formats
