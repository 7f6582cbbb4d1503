// `ombre contours` writes outlines of layers for machines that draw them.
#include <cmath>
#include <filesystem>
#include <memory>

#include "base/system/stopwatch.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "export/outline_files.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/remarks.h"
#include "jobs/common/session.h"
#include "jobs/outline/contour_choices.h"

namespace ombre::jobs {
namespace {

using exporting::OutlineFormat;

using compile::ContourChoices;

constexpr const char* contours_footer =
    "Lengths are millimetres.\n\n"
    "An output that ends in .cli is one file of all layers (Common Layer Interface 2.0), with hatches by --hatch. One\n"
    "that ends in .svg is the layer at --z. Any other is a folder, with layer_0000.svg and so on.\n\n"
    "Borders are drawn in the middles of layers. Regions share them exactly: no gaps, no overlaps. Details\n"
    "thinner than a cell may be lost.\n\n"
    "Examples:\n"
    "  ombre contours part.vcad -o part/ --layer-height 0.05\n"
    "  ombre contours part.vcad -o part.cli --by materials\n"
    "  ombre contours part.vcad -o part.cli --by laser_power --bands 8 --hatch 0.1\n"
    "  ombre contours part.vcad -o cut.svg --z 3.2 --bands 4\n";

void refuse_to_overwrite_layers(const ContourChoices& a, OutlineFormat format) {
  if (format != OutlineFormat::svg_folder) return refuse_to_overwrite(a.output, a.force);
  std::error_code ignored;
  const auto status = std::filesystem::status(a.output, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_directory(status))
    throw Error(Code::cannot_write, a.output + " is no folder; choose another name, or let it end in .cli or .svg",
                {{"file", a.output}});
  if (!a.force && exporting::has_outline_layers(a.output))
    throw Error(Code::exists,
                a.output + " has layers already; replace them with " + spelled::option("--force") +
                    ", or choose another folder",
                {{"file", a.output}});
}

void refuse_too_many_hatches(const compile::ContourPlan& plan, double spacing_mm) {
  constexpr double most = 100'000;  // lines beside each other in a layer
  const Vec3 size = plan.box.size();
  const double across = std::hypot(size.x, size.y);
  if (across / spacing_mm <= most) return;
  throw WrongArgument("lines " + format_rounded(spacing_mm) + " mm apart are too many: a layer is " +
                      format_rounded(across) + " mm wide, and takes " + format_count(static_cast<uint64_t>(most)) +
                      " at most; write " + spelled::option("--hatch") + " with at least " +
                      format_rounded(across / most));
}

formats::OutlineDocument document_of(const compile::ContourPlan& plan, const std::string& title) {
  formats::OutlineDocument document{title, plan.box, {}};
  for (const compile::ContourRegion& region : plan.regions)
    document.regions.push_back({region.region.name.empty() ? title : region.region.name, region.colour});
  return document;
}

// Totals of the layers drawn so far.
struct Totals {
  explicit Totals(size_t regions) : volumes_mm3(regions) {}
  uint64_t polygons = 0, points = 0;
  std::vector<double> volumes_mm3;

  void add(const compile::LayerRegions& regions, double height_mm) {
    for (size_t n = 0; n < regions.size(); ++n) {
      polygons += regions[n].size();
      for (const surface::Polygon& polygon : regions[n]) points += polygon.size();
      volumes_mm3[n] += surface::area_mm2(regions[n]) * height_mm;
    }
  }
};

void tell_plan(const Events& events, const compile::ContourPlan& plan, int threads) {
  const auto& pitch = plan.corners.pitch;
  const compile::ContourWork work = compile::size_contour_work(plan, threads);
  events.say(format_count(static_cast<unsigned long long>(plan.layers())) +
             (plan.layers() == 1 ? " layer" : " layers") + " of " + mm_text(pitch[2].mm()) + " mm, cells of " +
             mm_text(pitch[0].mm()) + " mm; at most " + format_bytes(work.memory_bytes) +
             " of memory for layers in flight");
  warn_of_memory(events, "a layer", work.memory_bytes, plan.memory_bytes);
  events.event("plan", {{"layers", static_cast<double>(plan.layers())},
                        {"layer_height_mm", pitch[2].mm()},
                        {"tolerance_mm", plan.tolerance_mm},
                        {"cell_mm", pitch[0].mm()},
                        {"memory_bytes", work.memory_bytes}});
}

void tell_totals(const Events& events, const ContourChoices& a, const formats::OutlineDocument& document,
                 const compile::ContourPlan& plan, const Totals& totals, double seconds) {
  DataList regions;
  for (size_t n = 0; n < document.regions.size(); ++n) {
    events.say(document.regions[n].name + ": " + format_rounded(totals.volumes_mm3[n], 6) + " mm3");
    regions.push_back(DataMembers{{"name", document.regions[n].name}, {"volume_mm3", totals.volumes_mm3[n]}});
  }
  if (totals.polygons == 0)
    events.warn("no cell's corner is inside the design: there is nothing drawn; choose a smaller " +
                spelled::option("--cell"));
  events.say(a.output + " written: " + format_count(static_cast<uint64_t>(plan.layers())) + " layers, " +
             format_count(totals.polygons) + " polygons, " + format_count(totals.points) + " points, in " +
             format_rounded(seconds, 3) + " s");
  events.event("done", {{"output", a.output},
                        {"layers", static_cast<double>(plan.layers())},
                        {"polygons", static_cast<double>(totals.polygons)},
                        {"points", static_cast<double>(totals.points)},
                        {"regions", regions},
                        {"seconds", seconds}});
}

int write(const ContourChoices& a, OutlineFormat format, const compile::ContourPlan& plan, Session& session,
          const StopFlag& stop) {
  const Stopwatch watch;
  const auto document = document_of(plan, std::filesystem::path(a.design.design).stem().string());
  Totals totals(plan.regions.size());
  const auto files = exporting::begin_outline_files(
      {a.output, format, static_cast<uint64_t>(plan.layers()), plan.face_mm(0), a.cli()}, document);
  JobProgress progress(session.events, Counted::steps);
  compile::draw_contours(
      plan, a.work.threads,
      [&](int64_t layer, const compile::LayerRegions& regions) {
        files->add(plan.middle_mm(layer), plan.face_mm(layer + 1), regions);
        totals.add(regions, plan.corners.pitch[2].mm());
      },
      &progress, &stop);
  files->commit();
  progress.finish();
  tell_totals(session.events, a, document, plan, totals, watch.seconds());
  return done;
}

int contours(const ContourChoices& a, Session& session) {
  compile::ContourRequest request = a.request();
  const OutlineFormat format = exporting::outline_format_of(a.output);
  if (format == OutlineFormat::svg && !request.z_mm)
    throw WrongArgument(spelled::option("-o", a.output) + " holds one layer; say which with " + spelled::option("--z") +
                        ", or name a folder: -o " + std::filesystem::path(a.output).stem().string() + "/");
  if ((a.hatch_mm || a.binary) && format != OutlineFormat::cli)
    throw WrongArgument(spelled::option(a.binary ? "--binary" : "--hatch") + " is for .cli files; name one with " +
                        spelled::option("-o", "part.cli"));
  request.stop = &session.stop;
  JobSteps<compile::ContourPlan> steps;
  steps.refuse = [&] { refuse_to_overwrite_layers(a, format); };
  steps.plan = [&](Diagnostics& diagnostics) {
    const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.work.threads);
    auto planned = loaded ? compile::plan_contours(*loaded, request, diagnostics) : std::nullopt;
    if (planned && a.hatch_mm) refuse_too_many_hatches(*planned, *a.hatch_mm);
    return planned;
  };
  steps.check = [&](const compile::ContourPlan& plan) { tell_plan(session.events, plan, a.work.threads); };
  steps.run = [&](const compile::ContourPlan& plan) { return write(a, format, plan, session, session.stop); };
  return take_steps(steps, session);
}

}  // namespace

JobKind contours_kind() {
  JobKind kind = job_kind<ContourChoices>("contours", "Write outlines of layers: SVG, CLI", contours_footer, contours);
  kind.endings = {".svg", ".cli"};
  return kind;
}

}  // namespace ombre::jobs
