// `ombre sheet` draws a contact sheet of a finished job's layers.
#include <memory>

#include "export/output_file.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/session.h"
#include "jobs/stacks/job_sheet.h"
#include "jobs/stacks/sheet_choices.h"

namespace ombre::jobs {
namespace {

using compile::SheetChoices;

int sheet(const SheetChoices& a, Session& session) {
  refuse_to_overwrite(a.picture, a.force);
  std::string picture;
  {
    const auto quits = session.quit_at_once();
    picture = compile::contact_sheet(a.folder, a.layers);
  }
  exporting::write_file(a.picture, picture);
  session.events.say("wrote " + a.picture);
  session.events.event("done", {{"file", a.picture}});
  return done;
}

}  // namespace

JobKind sheet_kind() {
  return job_kind<SheetChoices>("sheet", "Draw layers of a job side by side, in true proportions, as one PNG",
                                "Example:\n  ombre sheet part_slices -o part.png\n", sheet);
}

}  // namespace ombre::jobs
