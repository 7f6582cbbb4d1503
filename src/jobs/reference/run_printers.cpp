// `ombre printers` lists the profiles, or shows one.
#include <algorithm>
#include <memory>

#include "base/text/markdown.h"
#include "base/text/record.h"
#include "base/text/text.h"
#include "calibration/calibration.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"
#include "jobs/reference/list_or_page.h"
#include "load/find_printer.h"
#include "load/load.h"
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
  if (printer.overhang_degrees)
    text += row("overhang", "at most " + format_number(*printer.overhang_degrees) + " degrees from the vertical");
  if (printer.is_vat) text += row("vat", "layers are made in a bath of resin");
  text += row("needs", join(printer.needs, " and "));
  for (const voxel::ValueStep& step : printer.steps)
    text += row("steps", step.of + ": multiples of " + format_rounded(step.size));
  if (!printer.calibrations.empty()) text += row("calibrations", join(printer.calibrations, ", "));
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

void list_printers(const Session& session) {
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
}

std::string printer_row(const voxel::Printer& printer) {
  const auto dpi = [&](size_t axis) { return format_rounded(25.4 / printer.pitch[axis].mm(), 5); };
  std::string box = "any size";
  if (const auto& build = printer.build_mm)
    box = format_rounded(build->x, 6) + " x " + format_rounded(build->y, 6) + " x " + format_rounded(build->z, 6);
  return table_row({"`" + printer.name + "`", printer.title, dpi(0) + " x " + dpi(1),
                    format_number(1000 * printer.pitch[2].mm()), voxel::to_text(printer.format),
                    std::to_string(printer.max_materials), box});
}

std::string image_row(const std::string& name) {
  const voxel::ImageKind& kind = voxel::image_kind(*voxel::image_format(name));
  std::vector<std::string> shown;
  for (const voxel::ChannelType type : kind.takes) shown.push_back(voxel::channel_kind(type).plural);
  return table_row({"`" + name + "`", kind.pixels, join(shown, ", ")});
}

std::string member_rows(const std::vector<MemberInfo>& members) {
  std::string text = "| member | | means |\n| --- | --- | --- |\n";
  for (const MemberInfo& member : members)
    text += table_row({"`" + member.name + "`", member.is_required ? "required" : "", member.meaning});
  return text;
}

// Returns the reference: tables of the profiles, of the kinds of images, and of the members of JSON files.
std::string printers_reference() {
  std::string text =
      "# Printers and materials\n\nMade by `ombre printers --markdown`; `ombre printers NAME` shows one profile.\n\n"
      "## Profiles\n\n| name | machine | dots per inch, x and y | layers, µm | images | most materials | build box, mm "
      "|\n| --- | --- | --- | --- | --- | --- | --- |\n";
  Diagnostics diagnostics;
  for (const std::string& name : compile::printer_names())
    if (const auto printer = compile::find_printer(name, diagnostics)) text += printer_row(*printer);
  text += "\n## Kinds of images\n\n| name | pixels | show |\n| --- | --- | --- |\n";
  for (const std::string& name : voxel::image_format_names()) text += image_row(name);
  text += "\n## Members of a profile\n\nA profile is one object. A member that is not listed here is an error.\n\n" +
          member_rows(voxel::printer_members());
  return text +
         "\n## Members of a material\n\nA file of materials has a list of objects, `{\"materials\": [...]}`. Members "
         "that are not listed here are kept with the\nmaterial.\n\n" +
         member_rows(design::material_members()) +
         "\n## Members of a calibration\n\nA [calibration](../user/properties.md) is one object. A member that is not "
         "listed here is an error.\n\n" +
         member_rows(calibration::calibration_members()) + "\nAn input:\n\n" +
         member_rows(calibration::input_members()) + "\nA point:\n\n" + member_rows(calibration::point_members()) +
         "\nThe constants of a law:\n\n" + member_rows(calibration::constant_members()) +
         "\n## Members of a calibration of inks\n\nA calibration with a `\"profile\"` gives the shares of "
         "[inks](../user/colour.md) for colours.\n\n" +
         member_rows(calibration::ink_members());
}

constexpr OneThing one_printer{"printer", "A profile's name, or the path of a .json file"};

}  // namespace

JobKind printers_kind() {
  return one_or_all_kind<one_printer, show_printer, list_printers, printers_reference>(
      "printers", "List the printer profiles, or show one", "Examples:\n  ombre printers\n  ombre printers j750\n");
}

}  // namespace ombre::jobs
