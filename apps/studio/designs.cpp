#include "studio/designs.h"

#include <algorithm>

#include "compile/find_printer.h"

namespace ombre::studio {

RequestError design_error(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.list()) {
    if (diagnostic.severity != Severity::error) continue;
    text += (text.empty() ? "" : "\n") + sentence_of(diagnostic, FrontEnd::studio);
  }
  return {"design", text};
}

CutDesignPtr OpenDesign::cut(const Cutting& cutting) {
  std::shared_ptr<Slot> slot;
  {
    const std::lock_guard lock(mutex_);
    auto& place = slots_[cutting];
    if (!place) place = std::make_shared<Slot>();
    slot = place;
  }
  const std::lock_guard lock(slot->mutex);
  if (!slot->made) slot->made = make(cutting);
  return slot->made;
}

CutDesignPtr OpenDesign::make(const Cutting& cutting) const {
  auto made = std::make_shared<CutDesign>();
  const auto printer = compile::find_printer(cutting.printer, made->remarks);
  if (!printer) throw design_error(made->remarks);
  made->printer = *printer;
  compile::PlanOptions options;
  options.program = program_;
  options.memory = &memory;
  options.printer = *printer;
  options.printer_given = cutting.printer != "generic";
  const auto dither = voxel::dither(cutting.dither);
  if (!dither) throw RequestError("request", "there is no way of dithering called \"" + cutting.dither + "\"");
  options.dither = *dither;
  options.whole_tray = cutting.place == "tray";
  if (cutting.place == "design") options.place = voxel::Placement::design;
  if (cutting.place == "center") options.place = voxel::Placement::center;
  if (cutting.level > 0) {
    const bool own = loaded->design.sampling && !options.printer_given;
    const auto& pitch = own ? loaded->design.sampling->pitch : printer->pitch;
    for (size_t axis = 0; axis < 2; ++axis)
      options.pitch[axis] =
          Pitch::from_ratio(pitch[axis].numerator << cutting.level, pitch[axis].denominator).value_or(pitch[axis]);
  }
  auto plan = compile::plan_slice(loaded, options, made->remarks);
  if (!plan || made->remarks.has_errors()) throw design_error(made->remarks);
  made->plan = std::move(*plan);
  made->plan.stages->prepare({});
  return made;
}

OpenDesignPtr Designs::add(const compile::LoadedPtr& loaded, const Box& bounds, const std::string& program) {
  const std::lock_guard lock(mutex_);
  kept_.push_front(std::make_shared<OpenDesign>("d" + std::to_string(++count_), loaded, bounds, program, memory_));
  if (kept_.size() > most) kept_.pop_back();
  return kept_.front();
}

OpenDesignPtr Designs::find(const std::string& handle) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(
      kept_, handle, [](const OpenDesignPtr& design) -> const std::string& { return design->handle; });
  if (found == kept_.end()) throw RequestError("gone", "the design is no longer loaded");
  kept_.splice(kept_.begin(), kept_, found);
  return kept_.front();
}

}  // namespace ombre::studio
