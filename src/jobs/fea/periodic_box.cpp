#include "jobs/fea/periodic_box.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "questions/build.h"

namespace ombre::compile {
namespace {

constexpr int32_t most_bricks_of_cell = 4096;

// Returns the nearest number of the form m * 2^k with m up to 7.
int32_t halvable(double wanted) {
  constexpr double most_odd = 7;
  int32_t twos = 1;
  while (wanted / twos > most_odd) twos *= 2;
  return std::max(1, static_cast<int32_t>(std::lround(wanted / twos))) * twos;
}

}  // namespace

std::optional<PeriodicBox> periodic_box(const LoadedPtr& loaded, const std::optional<Box>& box, double cell_mm,
                                        Diagnostics& diagnostics) {
  const SourceRange whole{loaded->source, 0, 0};
  const std::optional<Box> wanted = box ? box : design_box(loaded->design, diagnostics);
  if (!wanted) return std::nullopt;
  PeriodicBox result{*wanted, {}};
  for (int axis = 0; axis < 3; ++axis) {
    const double count = result.box.size()[axis] / cell_mm;
    if (!(count >= 0.5) || count > most_bricks_of_cell) {
      diagnostics.error(Code::option, whole,
                        "the box has " + format_rounded(count) + " bricks along " + std::string(1, "xyz"[axis]) +
                            "; from 1 to " + std::to_string(most_bricks_of_cell) + " are possible",
                        "choose another " + spelled::option("--cell") + " or " + spelled::option("--box"));
      return std::nullopt;
    }
    result.count[static_cast<size_t>(axis)] = halvable(count);
  }
  return result;
}

LoadedPtr sampled_by(const LoadedPtr& loaded, const PeriodicBox& box) {
  Loaded copy = *loaded;
  design::Sampling sampling;
  sampling.box = box.box;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = box.box.size()[axis];
    const int32_t count = box.count[static_cast<size_t>(axis)];
    const auto whole = Pitch::from_mm(size);
    const auto part = whole ? Pitch::from_ratio(whole->numerator, whole->denominator * count) : std::nullopt;
    sampling.pitch[static_cast<size_t>(axis)] = part ? *part : *Pitch::from_mm(size / count);
  }
  copy.design.sampling = sampling;
  return std::make_shared<const Loaded>(std::move(copy));
}

fea::Model repeating(fea::Model model, const PeriodicBox& box, const StopFlag* stop) {
  fea::Bricks& bricks = model.bricks;
  std::vector<fea::Fill> fills = std::move(bricks.fills);
  bricks = fea::make_bricks(bricks.origin, bricks.size_mm, std::move(bricks.cells), box.count, stop);
  bricks.fills = std::move(fills);
  return model;
}

}  // namespace ombre::compile
