// Colours of a slicer's extruders, as stored in its project.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "formats/mesh/mesh.h"

namespace ombre::formats {

class ExtruderColours {
 public:
  ExtruderColours() = default;

  // Read the settings of Bambu Studio and OrcaSlicer (JSON), and of PrusaSlicer and SuperSlicer (lines "; key =
  // value"). Unreadable settings have no colours.
  static ExtruderColours of_bambu(std::string_view settings);
  static ExtruderColours of_prusa(std::string_view settings);

  // Gives groups whose surface is painted the colours of their extruders, and returns the first extruder without one,
  // or 0.
  uint32_t paint_surfaces(std::vector<MeshGroup>& groups) const;

  // Gives the colour of this extruder, counted from 1, to groups without a colour.
  void paint(std::vector<MeshGroup>& groups, uint64_t extruder) const;

 private:
  std::vector<std::optional<Rgba>> colours_;
};

// Returns the number of an extruder in settings: that of the part, else of the object; 1 if neither is set.
uint64_t extruder_of(std::string_view part, std::string_view object);

}  // namespace ombre::formats
