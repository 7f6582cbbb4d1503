// The steps of commands that write files, in their order.
#pragma once

#include <functional>
#include <optional>

#include "base/text/diagnostic.h"
#include "jobs/common/session.h"

namespace ombre::jobs {

// The steps of a command, which are always taken in this order. A missing step is empty.
template <class Plan>
struct JobSteps {
  // Throws WrongArgument if options exclude each other, and Error if an existing file may not be replaced. Nothing is
  // loaded yet, so a slip shows at once.
  std::function<void()> refuse;
  // Loads the design and plans the work. Returns nothing, and adds diagnostics, if the design is wrong.
  std::function<std::optional<Plan>(Diagnostics& diagnostics)> plan;
  // Reports the plan. Throws Error if the disk or the memory is too small for it.
  std::function<void(const Plan& plan)> check = nullptr;
  // Does the work, or estimates it (--dry-run), and reports the result. Returns an exit code.
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
