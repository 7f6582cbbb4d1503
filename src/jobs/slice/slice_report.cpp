// Reports of `ombre slice` before, instead of and after its work.
#include "jobs/slice/slice_report.h"

#include <utility>

#include "base/text/text.h"
#include "jobs/common/events.h"
#include "jobs/common/pace.h"
#include "jobs/common/remarks.h"
#include "jobs/common/session.h"

namespace ombre::jobs {
namespace {

std::string counted(int64_t count, const std::string& noun) {
  return format_count(static_cast<unsigned long long>(count)) + ' ' + noun + (count == 1 ? "" : "s");
}

std::string place_text(Vec3 p) { return '(' + mm_text(p.x) + ", " + mm_text(p.y) + ", " + mm_text(p.z) + ')'; }

double voxel_mm3(const compile::SliceRequest& request) {
  const auto& pitch = request.lattice.pitch;
  return pitch[0].mm() * pitch[1].mm() * pitch[2].mm();
}

// Returns a text such as "shades: density from 0.2 (black) to 1.1 (white) g/cm3".
std::string shades_text(const compile::ShadeMeaning& shades) {
  return "shades: " + shades.of + " from " + format_rounded(shades.range.lo, 4) + " (black) to " +
         format_rounded(shades.range.hi, 4) + " (white)" + (shades.unit.empty() ? "" : " " + shades.unit);
}

}  // namespace

void tell_plan(const Events& events, const compile::SliceRequest& request, const compile::SliceOptions& options) {
  const auto& [nx, ny, nz] = request.lattice.count;
  const auto& pitch = request.lattice.pitch;
  const Vec3 size = request.lattice.box().size();
  std::vector<std::string> names;
  DataList material_names;
  for (const compile::SliceMaterial& material : request.materials) {
    if (!request.shades) names.push_back(material.name);
    material_names.emplace_back(material.name);
  }
  const std::string shown = request.shades ? shades_text(*request.shades) : "materials: " + join(names, ", ");
  events.say("box " + format_rounded(size.x, 6) + " x " + format_rounded(size.y, 6) + " x " +
             format_rounded(size.z, 6) + " mm, voxels " + format_rounded(pitch[0].mm()) + " x " +
             format_rounded(pitch[1].mm()) + " x " + format_rounded(pitch[2].mm()) + " mm");
  events.say(counted(nz, "layer") + " of " + std::to_string(nx) + " x " + std::to_string(ny) + ", " +
             format_count(request.lattice.voxels()) + " voxels; " + shown);
  if (options.layers)
    events.say("layers " + std::to_string(options.layers->begin) + ':' + std::to_string(options.layers->end) +
               " of these");
  events.event("plan", {{"folder", options.folder},
                        {"printer", request.printer},
                        {"voxels", DataList{number(nx), number(ny), number(nz)}},
                        {"pitch_mm", DataList{pitch[0].mm(), pitch[1].mm(), pitch[2].mm()}},
                        {"size_mm", DataList{size.x, size.y, size.z}},
                        {"materials", material_names}});
}

void tell_estimate(const Events& events, const compile::SliceRequest& request, const compile::SliceEstimate& estimate) {
  const std::string memory = "at most " + format_bytes(static_cast<double>(estimate.memory_bytes)) +
                             " of memory for layers in flight; nothing was written";
  if (estimate.is_least)
    events.say("more than " + duration_text(estimate.seconds) +
               ": a few rows of a layer alone take longer than this look at them; " + memory);
  else
    events.say("about " + duration_text(estimate.seconds) + ", " + format_bytes(static_cast<double>(estimate.bytes)) +
               " of images (" + voxel::to_text(request.format) + "), " + memory);
  events.event("estimate", {{"seconds", estimate.seconds},
                            {"bytes", number(estimate.bytes)},
                            {"is_least", estimate.is_least},
                            {"memory_bytes", number(estimate.memory_bytes)}});
}

void tell_report(const Events& events, const compile::SliceRequest& request, const compile::SliceOptions& options,
                 const compile::SliceReport& report) {
  std::string text = counted(report.layers_written, "layer") + " written to " + options.folder;
  if (report.layers_kept > 0) text += ", " + counted(report.layers_kept, "layer") + " finished before";
  if (report.layers_dropped > 0) text += ", " + counted(report.layers_dropped, "empty layer") + " left out";
  const double voxels = static_cast<double>(report.layers_written + report.layers_dropped) *
                        static_cast<double>(request.lattice.count[0]) * static_cast<double>(request.lattice.count[1]);
  text += "; " + format_bytes(static_cast<double>(report.bytes_written)) + " in " + format_rounded(report.seconds, 3) +
          " s";
  if (report.seconds > 0 && voxels > 0) text += ", " + rate_text(voxels / report.seconds);
  events.say(text);

  DataList materials;
  for (size_t i = 0; i < request.materials.size(); ++i) {
    const uint64_t count = report.material_voxels[i];
    const double volume = static_cast<double>(count) * voxel_mm3(request);
    if (!request.shades)
      events.say("  " + request.materials[i].name + ": " + format_count(count) + " voxels, " + format_rounded(volume) +
                 " mm3");
    materials.emplace_back(
        DataMembers{{"name", request.materials[i].name}, {"voxels", number(count)}, {"volume_mm3", volume}});
  }
  const bool has_all_layers = report.layers.begin == 0 && report.layers.end == request.lattice.count[2];
  if (has_all_layers && report.voxels_inside == 0)
    events.warn("no voxel's centre is inside the design: all layers are empty");
  if (!report.whole_job_finished && !report.stopped_by_check)
    events.say("other layers of the job are missing; --resume writes them");
  events.event("done", {{"folder", options.folder},
                        {"complete", report.whole_job_finished},
                        {"layers_written", number(report.layers_written)},
                        {"layers_kept", number(report.layers_kept)},
                        {"layers_dropped", number(report.layers_dropped)},
                        {"voxels_inside", number(report.voxels_inside)},
                        {"materials", materials},
                        {"bytes_written", number(report.bytes_written)},
                        {"seconds", report.seconds}});
}

void tell_checks(const Events& events, const std::vector<compile::CheckReport>& checks) {
  for (const compile::CheckReport& check : checks) {
    events.event("check", {{"text", check.text},
                           {"voxels", number(check.voxels)},
                           {"first_mm", DataList{check.first_mm.x, check.first_mm.y, check.first_mm.z}}});
    events.warn(check.text + " (" + counted(static_cast<int64_t>(check.voxels), "voxel") + ", the lowest at " +
                place_text(check.first_mm) + " mm)");
  }
}

}  // namespace ombre::jobs
