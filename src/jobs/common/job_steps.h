// The order in which commands that write files go about their work.
#pragma once

#include <functional>
#include <optional>

#include "base/text/diagnostic.h"
#include "jobs/common/session.h"

namespace ombre::jobs {

// The steps of a command, which are always taken in this order. A step that a command does not have is empty.
template <class Plan>
struct JobSteps {
  // Throws WrongArgument where options do not fit each other, and Error where something is there that may not be
  // replaced. Nothing is loaded yet: a slip shows at once.
  std::function<void()> refuse;
  // Loads the design and finds out what there is to do. Nothing, and diagnostics, where the design is wrong.
  std::function<std::optional<Plan>(Diagnostics& diagnostics)> plan;
  // Reports the plan. Throws Error where the disk or the memory is too small for it.
  std::function<void(const Plan& plan)> check = nullptr;
  // Does the work, or estimates it (--dry-run), and reports what was done. Returns an exit code.
  std::function<int(Plan& plan)> run;
};

template <class Plan>
int take_steps(const JobSteps<Plan>& steps, Session& session) {
  if (steps.refuse) steps.refuse();
  Diagnostics diagnostics;
  std::optional<Plan> plan = steps.plan(diagnostics);
  session.events.diagnose(diagnostics);
  if (!plan || diagnostics.has_errors()) return wrong_input;
  if (steps.check) steps.check(*plan);
  return steps.run(*plan);
}

}  // namespace ombre::jobs
