// Elements of a mesh where the design's mixture is no number.
#pragma once

#include <span>

#include "base/system/progress.h"
#include "base/text/diagnostic.h"
#include "design/design.h"

namespace ombre::compile {

// What the elements of a mesh got.
struct ElementDraws {
  std::span<const Vec3> middles;  // mm
  std::span<const MaterialId> drawn;
};

// Warns of elements where the design's own checks find no usable fractions, or the fractions have no sum that is
// positive: how many they are, where the first is and what they were taken for. False, and an error, when all are such.
// Middles that lie outside of the design do not count. Throws Cancelled.
bool check_mixtures(const design::Design& design, const ElementDraws& elements, int threads, const StopFlag* stop,
                    Diagnostics& diagnostics);

}  // namespace ombre::compile
