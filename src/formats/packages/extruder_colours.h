// The colours of a slicer's extruders, as its project says them.
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

  // Settings of Bambu Studio and OrcaSlicer (JSON), and of PrusaSlicer and SuperSlicer (lines "; key = value"). What
  // cannot be read has no colours.
  static ExtruderColours of_bambu(std::string_view settings);
  static ExtruderColours of_prusa(std::string_view settings);

  // Gives groups the colour of this extruder, counted from 1, unless they have one.
  void paint(std::vector<MeshGroup>& groups, uint64_t extruder) const;

 private:
  std::vector<std::optional<Rgba>> colours_;
};

// The number of an extruder as settings say it: of a part, or else of the object; 1 if neither does.
uint64_t extruder_of(std::string_view part, std::string_view object);

}  // namespace ombre::formats
