// ombre bundle: a design with the files that it reads, in one file.
#include <filesystem>
#include <memory>

#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "jobs/check/bundle_choices.h"
#include "load/bundle.h"
#include "ombre/command_line.h"
#include "ombre/command_options.h"
#include "ombre/commands.h"
#include "ombre/interrupt.h"
#include "ombre/overwrite.h"

namespace ombre::cli {
namespace {

using compile::BundleChoices;

int write_bundle(const BundleChoices& a, Session& session) {
  namespace fs = std::filesystem;
  const fs::path design(a.design);
  if (ending_of(design) == ".py")
    throw WrongArgument(a.design +
                        " is a Python script, which may read anything; write its design into a file first: " +
                        "ombre slice " + a.design + " --emit json > " + design.stem().string() + ".json");
  if (compile::is_bundle(a.design)) throw WrongArgument(a.design + " is a bundle already");
  const std::string output = a.output.empty() ? design.stem().string() + std::string(compile::bundle_ending) : a.output;
  if (!compile::is_bundle(output))
    throw WrongArgument(spelled::option("-o", output) + ": bundles end in .ombre; write for example -o " +
                        fs::path(output).replace_extension(".ombre").string());
  refuse_to_overwrite(output, a.force);
  Diagnostics diagnostics;
  compile::LoadOptions options{a.materials, {}};
  options.stop = &session.stop;
  std::optional<compile::BundleContents> contents;
  {
    const QuitAtOnce quits;
    contents = compile::write_bundle(a.design, output, options, diagnostics);
  }
  session.console.diagnose(diagnostics);
  if (!contents) return wrong_input;
  session.console.say("written to " + output + ": " + join(contents->files, ", "));
  for (const std::string& file : contents->left_outside)
    session.console.say("not in it: " + file + ", which belongs to the system");
  session.console.event("bundle",
                        {{"file", output},
                         {"design", contents->design},
                         {"files", DataList(contents->files.begin(), contents->files.end())},
                         {"left_outside", DataList(contents->left_outside.begin(), contents->left_outside.end())}});
  return done;
}

}  // namespace

Command add_bundle(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("bundle", "Put a design and the files that it reads into one file");
  auto arguments = std::make_shared<BundleChoices>();
  add_options(*app, *arguments);
  add_output_options(*app, output);
  app->footer(
      "A bundle is a zip archive, which opens by itself wherever a design is expected.\n\n"
      "Examples:\n"
      "  ombre bundle part.vcad                 part.ombre\n"
      "  ombre slice part.ombre --printer j750\n"
      "  ombre studio part.ombre\n");
  return {app, [arguments](Session& session) { return write_bundle(*arguments, session); },
          BundleChoices::options().options()};
}

}  // namespace ombre::cli
