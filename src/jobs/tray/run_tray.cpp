// `ombre tray` lays parts out on the tray of a printer, as one design.
#include <charconv>
#include <filesystem>
#include <set>

#include "base/text/error.h"
#include "base/text/text.h"
#include "design/design_file.h"
#include "export/output_file.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/tray/laid_out.h"
#include "jobs/tray/tray_choices.h"
#include "load/find_printer.h"
#include "load/load.h"
#include "load/node_registry.h"

namespace ombre::jobs {
namespace {

using compile::TrayChoices;

constexpr const char* tray_footer =
    "The parts keep their orientation, and stand where their voxels are those of the part alone. They are called by "
    "their\n"
    "files: knob_1, knob_2, ... The design is a file that all commands take.\n\n"
    "Examples:\n"
    "  ombre tray knob.vcad wheel.vcad --count 12,3 --printer j750 -o tray.json\n"
    "  ombre slice tray.json --printer j750 --tray\n";

constexpr int64_t most_copies = 100'000;

// Returns the copies of each design. Throws options::WrongValue.
std::vector<int64_t> counts_of(const TrayChoices& a) {
  std::vector<int64_t> counts;
  for (const std::string& text : split(a.count, ',')) {
    int64_t count = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (status != std::errc() || end != text.data() + text.size() || count < 1 || count > most_copies)
      throw WrongArgument('"' + text + "\" is no number of copies; write " + spelled::option("--count", "12") +
                          " for all designs, or a number for each, such as " + spelled::option("--count", "12,3"));
    counts.push_back(count);
  }
  if (counts.size() == 1) counts.resize(a.designs.size(), counts.front());
  if (counts.size() != a.designs.size())
    throw WrongArgument("there are " + format_count(a.designs.size()) + " designs and " + format_count(counts.size()) +
                        " numbers of copies; write one number for all, or one for each");
  return counts;
}

// Returns the names of the designs. Throws WrongArgument if two are the same.
std::vector<std::string> names_of(const TrayChoices& a) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const std::string& design : a.designs) {
    names.push_back(std::filesystem::path(design).stem().string());
    if (!known.insert(names.back()).second)
      throw WrongArgument("two designs are called \"" + names.back() +
                          "\", so their parts would be, too; rename one, " + "or write it once with a larger " +
                          spelled::option("--count"));
  }
  return names;
}

struct TrayPlan {
  std::string text;  // of the design file
  std::vector<std::string> parts;
  std::string printer;
};

std::optional<TrayPlan> plan(const TrayChoices& a, Session& session, Diagnostics& diagnostics) {
  const std::vector<int64_t> counts = counts_of(a);
  const std::vector<std::string> names = names_of(a);
  const auto printer = compile::find_printer(a.printer, diagnostics);
  if (!printer) return std::nullopt;
  if (!printer->build_mm)
    throw WrongArgument("the profile \"" + printer->name + "\" has no \"build_mm\", so its tray has no size; choose " +
                        "a printer that has one with " + spelled::option("--printer"));
  std::vector<compile::TrayItem> items;
  for (size_t n = 0; n < names.size(); ++n) {
    DesignArguments arguments;
    arguments.design = a.designs[n];
    arguments.materials = a.materials;
    auto loaded = load_design(arguments, session, diagnostics);
    if (!loaded) return std::nullopt;
    items.push_back({names[n], std::move(loaded), counts[n]});
  }
  const auto design = compile::laid_out(items, *printer, a.gap_mm.value_or(printer->gap_mm), diagnostics);
  if (!design) return std::nullopt;
  TrayPlan made{design::design_text(design->file, compile::node_registry(), a.output), design->parts, printer->title};
  if (!compile::load_text(made.text, a.output, {}, diagnostics)) return std::nullopt;
  return made;
}

int run(const TrayPlan& made, const TrayChoices& a, Session& session) {
  exporting::write_file(a.output, made.text);
  session.events.say("wrote " + a.output + ": " + format_count(made.parts.size()) +
                     (made.parts.size() == 1 ? " part" : " parts") + " on the tray of " + made.printer);
  session.events.event("tray", {{"file", a.output}, {"parts", DataList(made.parts.begin(), made.parts.end())}});
  return done;
}

int tray(const TrayChoices& a, Session& session) {
  JobSteps<TrayPlan> steps;
  steps.refuse = [&] {
    check_design_file(a.output);
    refuse_to_overwrite(a.output, a.force);
  };
  steps.plan = [&](Diagnostics& diagnostics) { return plan(a, session, diagnostics); };
  steps.run = [&](const TrayPlan& made) { return run(made, a, session); };
  return take_steps(steps, session);
}

}  // namespace

JobKind tray_kind() {
  return job_kind<TrayChoices>("tray", "Lay parts out on the tray of a printer, as one design", tray_footer, tray);
}

}  // namespace ombre::jobs
