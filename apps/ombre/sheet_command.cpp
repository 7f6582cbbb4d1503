// ombre sheet: a contact sheet of a finished job's layers.
#include <memory>

#include "compile/job_sheet.h"
#include "ombre/checks.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"
#include "ombre/overwrite.h"

namespace ombre::cli {
Command add_sheet(CLI::App& program, OutputOptions& output) {
  struct Arguments {
    std::string folder, image = "sheet.png";
    int layers = 12;
    bool force = false;
  };
  CLI::App* app = program.add_subcommand("sheet", "Draw layers of a job side by side, in true proportions, as one PNG");
  auto arguments = std::make_shared<Arguments>();
  app->add_option("folder", arguments->folder, "Folder of a slice job")->required()->type_name("DIR");
  app->add_option("-o,--output", arguments->image, "The picture to write (default sheet.png)")->type_name("FILE");
  app->add_option("--count", arguments->layers, "How many layers, evenly spaced (default 12)")
      ->check(whole_between(1, 200))
      ->type_name("N");
  app->add_flag("--force", arguments->force, "Replace the picture if it is there");
  add_output_options(*app, output);
  app->footer("Example:\n  ombre sheet part_slices -o part.png\n");
  return {app, [arguments](Session& session) {
            refuse_to_overwrite(arguments->image, arguments->force);
            compile::write_contact_sheet(arguments->folder, arguments->image, arguments->layers);
            session.console.say("wrote " + arguments->image);
            session.console.event("done", {{"file", arguments->image}});
            return done;
          }};
}

}  // namespace ombre::cli
