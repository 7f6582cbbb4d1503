// `ombre printers` lists the profiles, or shows one.
#include <algorithm>
#include <memory>

#include "base/text/text.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"
#include "load/find_printer.h"
#include "voxel/image_kinds.h"

namespace ombre::jobs {
namespace {

std::string row(const std::string& name, const std::string& value) {
  return name + std::string(name.size() < 18 ? 18 - name.size() : 1, ' ') + value + '\n';
}

std::string pitch_text(const Pitch& pitch) {
  const double dpi = 25.4 / pitch.mm();
  return pitch.text() + " mm (" + format_rounded(dpi, 5) + " dpi)";
}

std::string describe(const voxel::Printer& printer) {
  std::string text = printer.name + ": " + printer.title + '\n';
  text += row("figures from", printer.source);
  for (int axis = 0; axis < 3; ++axis)
    text += row(axis == 2 ? "layer height" : std::string("pitch ") + "xy"[axis], pitch_text(printer.pitch[axis]));
  if (printer.build_mm) {
    const Vec3 build = *printer.build_mm;
    text += row("build box", format_rounded(build.x, 6) + " x " + format_rounded(build.y, 6) + " x " +
                                 format_rounded(build.z, 6) + " mm");
  }
  text += row("images", voxel::to_text(printer.format) + (printer.files.has_material() ? ", for each material" : ""));
  text += row("images cover", printer.origin == voxel::Placement::center ? "the build plate, the part in its middle"
                                                                         : "the design's box");
  if (printer.flip_x || printer.flip_y)
    text += row("flipped", std::string(printer.flip_x ? "x" : "") + (printer.flip_x && printer.flip_y ? ", " : "") +
                               (printer.flip_y ? "y" : ""));
  const voxel::NamePattern files = printer.files.of_material("MATERIAL");
  text += row("files", files.name(printer.first_index) + ", " + files.name(printer.first_index + 1) + ", ...");
  text += row("empty layers", printer.drop_empty_layers ? "dropped" : "kept");
  text += row("most materials", std::to_string(printer.max_materials));
  if (printer.smallest_feature)
    text += row("details", "distort under " + format_number(printer.smallest_feature->distorts_mm) +
                               " mm, fail under " + format_number(printer.smallest_feature->fails_mm) + " mm");
  for (const voxel::ForbiddenNeighbour& rule : printer.forbidden_neighbours)
    text += row("keep apart", rule.material + " and " + rule.near + ", by " + format_number(rule.within_mm) + " mm");
  return text;
}

int show_printer(const std::string& name, Session& session) {
  Diagnostics diagnostics;
  const auto printer = compile::find_printer(name, diagnostics);
  session.events.diagnose(diagnostics);
  if (!printer) return wrong_input;
  if (session.events.wants_data()) {
    session.events.event("printer", {{"name", printer->name}, {"title", printer->title}});
    return done;
  }
  session.events.print(describe(*printer));
  return done;
}

int list_printers(Session& session) {
  const std::vector<std::string> names = compile::printer_names();
  size_t width = 0;
  for (const std::string& name : names) width = std::max(width, name.size());
  for (const std::string& name : names) {
    Diagnostics diagnostics;
    const auto printer = compile::find_printer(name, diagnostics);
    session.events.diagnose(diagnostics);
    if (!printer) continue;
    if (session.events.wants_data())
      session.events.event("printer", {{"name", name}, {"title", printer->title}});
    else
      session.events.print(name + std::string(width + 2 - name.size(), ' ') + printer->title + '\n');
  }
  return done;
}

struct PrintersChoices {
  std::string printer;

  static const options::Spec<PrintersChoices>& options() {
    using namespace options;
    static const options::Spec<PrintersChoices> spec{option("printer", &PrintersChoices::printer, kind::text,
                                                            "A profile's name, or the path of a .json file", "NAME")};
    return spec;
  }
};

int show_printers(const PrintersChoices& a, Session& session) {
  return a.printer.empty() ? list_printers(session) : show_printer(a.printer, session);
}

}  // namespace

JobKind printers_kind() {
  return job_kind<PrintersChoices>("printers", "List the printer profiles, or show one",
                                   "Examples:\n  ombre printers\n  ombre printers j750\n", show_printers);
}

}  // namespace ombre::jobs
