// `ombre bundle` writes a design with the files that it reads into one file.
#include <filesystem>
#include <memory>

#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "jobs/bundle/bundle_choices.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/session.h"
#include "load/bundle.h"

namespace ombre::jobs {
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
    const auto quits = session.quit_at_once();
    contents = compile::write_bundle(a.design, output, options, diagnostics);
  }
  session.events.diagnose(diagnostics);
  if (!contents) return wrong_input;
  session.events.say("written to " + output + ": " + join(contents->files, ", "));
  for (const std::string& file : contents->left_outside)
    session.events.say("not in it: " + file + ", which belongs to the system");
  session.events.event("bundle",
                       {{"file", output},
                        {"design", contents->design},
                        {"files", DataList(contents->files.begin(), contents->files.end())},
                        {"left_outside", DataList(contents->left_outside.begin(), contents->left_outside.end())}});
  return done;
}

}  // namespace

JobKind bundle_kind() {
  return job_kind<BundleChoices>("bundle", "Put a design and the files that it reads into one file",
                                 "A bundle is a zip archive, which opens by itself wherever a design is expected.\n\n"
                                 "Examples:\n"
                                 "  ombre bundle part.vcad                 part.ombre\n"
                                 "  ombre slice part.ombre --printer j750\n"
                                 "  ombre studio part.ombre\n",
                                 write_bundle);
}

}  // namespace ombre::jobs
