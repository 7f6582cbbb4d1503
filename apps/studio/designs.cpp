#include "studio/designs.h"

#include <algorithm>

#include "studio/workspace/guard.h"

namespace ombre::studio {

namespace {

constexpr size_t most_results = 3000;  // of the statements of a script, and of its expressions

}  // namespace

RequestError design_error(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.list()) {
    if (diagnostic.severity != Severity::error) continue;
    text += (text.empty() ? "" : "\n") + sentence_of(diagnostic, FrontEnd::studio);
  }
  return {"design", text};
}

CutDesignPtr OpenDesign::cut(const JobChoices& choices) {
  std::shared_ptr<Slot> slot;
  {
    const std::lock_guard lock(mutex_);
    auto& place = slots_[choices.key()];
    if (!place) place = std::make_shared<Slot>();
    slot = place;
  }
  const std::lock_guard lock(slot->mutex);
  if (!slot->made) slot->made = make(choices);
  return slot->made;
}

namespace {

compile::PlanOptions plan_options(const JobChoices& choices, const std::string& program, Diagnostics& remarks) {
  try {
    auto options = compile::plan_options(program, choices.sampling, choices.images, remarks);
    if (!options) throw design_error(remarks);
    return *options;
  } catch (const options::WrongValue& error) {
    throw wrong_value(error);
  }
}

// Makes the job's voxels 2^level times as long along x and y.
void make_coarser(compile::PlanOptions& options, const design::Design& design, int level) {
  const auto& pitch = design.sampling && !options.printer_given ? design.sampling->pitch : options.printer.pitch;
  for (size_t axis = 0; axis < 2; ++axis) {
    const Pitch own = options.pitch[axis].value_or(pitch[axis]);
    options.pitch[axis] = Pitch::from_ratio(own.numerator << level, own.denominator).value_or(own);
  }
}

}  // namespace

CutDesignPtr OpenDesign::make(const JobChoices& choices) const {
  auto made = std::make_shared<CutDesign>();
  compile::PlanOptions options = plan_options(choices, program_, made->remarks);
  // Designs are loaded with the usual materials.
  if (!choices.calibrations.apply(options, "", made->remarks)) throw design_error(made->remarks);
  made->printer = options.printer;
  options.memory = &memory;
  if (choices.level > 0) make_coarser(options, loaded->design, choices.level);
  auto plan = compile::plan_slice(loaded, options, made->remarks);
  if (!plan || made->remarks.has_errors()) throw design_error(made->remarks);
  made->plan = std::move(*plan);
  made->plan.stages->prepare({});
  return made;
}

void ScriptResults::add(const SourceRange& statement, std::vector<design::NodePtr> solids) {
  constexpr size_t most_solids = 1000;  // of one statement
  const bool is_one_node = solids.size() == 1 && solids.front()->where().begin == statement.begin &&
                           solids.front()->where().source == statement.source;
  if (is_one_node || solids.size() > most_solids || solids_.size() >= most_results) return;
  solids_.try_emplace(statement.begin, std::move(solids));
}

void ScriptResults::add(const SourceRange& expression, Data value) {
  if (values_.size() < most_results) values_.push_back({expression, std::move(value)});
}

Designs::Designs(design::SubDesignMemory& memory) : memory_(memory), start_(random_token().substr(0, 8)) {}

OpenDesignPtr Designs::add(const DesignOrigin& origin, ReadDesign design, const std::string& program) {
  const std::lock_guard lock(mutex_);
  const std::string handle = start_ + "-" + std::to_string(++count_);
  kept_.push_front(std::make_shared<OpenDesign>(handle, origin, std::move(design), program, memory_));
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
