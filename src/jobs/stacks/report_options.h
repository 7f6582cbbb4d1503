// Options of jobs that look at stacks, and may write a page with pictures of what they find.
#pragma once

#include <optional>
#include <string>

#include "jobs/common/job_options.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/session.h"

namespace ombre::jobs {

struct ReportOptions {
  std::string file;
  bool force = false;

  // `help` says what the page shows, `replaces` what --force replaces.
  static options::Spec<ReportOptions> options(const std::string& help,
                                              const std::string& replaces = "Replace an existing report") {
    using namespace options;
    return {option("--report", &ReportOptions::file, kind::file, help + ": an .html file", "FILE"),
            flag("--force", &ReportOptions::force, replaces)};
  }
};

// Plans and runs a job with such options, which is a value of the type Choices; returns an exit code.
template <class Planned, class Choices>
int take_report_steps(const Choices& a, Session& session,
                      std::optional<Planned> (&plan)(const Choices&, Session&, Diagnostics&),
                      int (&run)(const Choices&, const Planned&, Session&)) {
  JobSteps<Planned> steps;
  steps.refuse = [&] {
    if (!a.report.file.empty()) refuse_to_overwrite(a.report.file, a.report.force);
  };
  steps.plan = [&](Diagnostics& diagnostics) { return plan(a, session, diagnostics); };
  steps.run = [&](const Planned& planned) { return run(a, planned, session); };
  return take_steps(steps, session);
}

}  // namespace ombre::jobs
