// ombre sheet: a contact sheet of a finished job's layers.
#include <memory>

#include "export/output_file.h"
#include "jobs/slice/job_sheet.h"
#include "jobs/slice/sheet_choices.h"
#include "ombre/command_line.h"
#include "ombre/command_options.h"
#include "ombre/commands.h"
#include "ombre/interrupt.h"
#include "ombre/overwrite.h"

namespace ombre::cli {
namespace {

using compile::SheetChoices;

int sheet(const SheetChoices& a, Session& session) {
  refuse_to_overwrite(a.picture, a.force);
  std::string picture;
  {
    const QuitAtOnce quits;
    picture = compile::contact_sheet(a.folder, a.layers);
  }
  exporting::write_file(a.picture, picture);
  session.console.say("wrote " + a.picture);
  session.console.event("done", {{"file", a.picture}});
  return done;
}

}  // namespace

Command add_sheet(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("sheet", "Draw layers of a job side by side, in true proportions, as one PNG");
  auto arguments = std::make_shared<SheetChoices>();
  add_options(*app, *arguments);
  add_output_options(*app, output);
  app->footer("Example:\n  ombre sheet part_slices -o part.png\n");
  return {app, [arguments](Session& session) { return sheet(*arguments, session); }, SheetChoices::options().options()};
}

}  // namespace ombre::cli
