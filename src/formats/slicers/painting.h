// Painted triangles: the codes by which slicers assign parts of a surface to extruders.
//
// PrusaSlicer's attribute slic3rpe:mmu_segmentation and paint_color of Bambu Studio and OrcaSlicer hold the same tree,
// as hexadecimal digits that are read from the right. A digit whose two low bits are 0 is a leaf, with the extruder in
// its two high bits; 3 there means that another digit follows, whose value is the extruder less 3. Otherwise the low
// bits are the number of sides that are split, and the triangles into which they cut it follow, one more than that.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ombre::formats {

// Extruders up to this one have codes that all versions of the slicers read.
inline constexpr uint32_t most_painted = 16;

// Returns the code of a whole triangle of an extruder, from 1 to most_painted.
std::string paint_code(uint32_t extruder);

struct Paint {
  uint32_t extruder = 0;    // of the largest part; 0 if that is unpainted
  bool is_divided = false;  // parts of the triangle have different extruders
};

// Returns nothing if the text is not a code.
std::optional<Paint> read_paint(std::string_view code);

}  // namespace ombre::formats
