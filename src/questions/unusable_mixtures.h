// Finds elements of a mesh where the design's mixture is not a number.
#pragma once

#include <span>

#include "base/system/progress.h"
#include "base/text/diagnostic.h"
#include "design/design.h"

namespace ombre::compile {

// The elements of a mesh with their materials.
struct ElementDraws {
  std::span<const Vec3> middles;  // middles of elements, mm
  std::span<const MaterialId> drawn;
};

// Warns of elements where the design's own checks find no usable fractions, or the fractions have no positive sum: how
// many there are, where the first is and which materials they got. Returns false, and adds an error, if all elements
// inside are such. Middles outside of the design are ignored. Throws Cancelled.
bool check_mixtures(const design::Design& design, const ElementDraws& elements, int threads, const StopFlag* stop,
                    Diagnostics& diagnostics);

}  // namespace ombre::compile
