// Reports of `ombre slice` before, instead of and after its work.
#include "jobs/slice/slice_report.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/text/text.h"
#include "jobs/common/events.h"
#include "jobs/common/pace.h"
#include "jobs/common/remarks.h"
#include "jobs/common/session.h"
#include "jobs/slice/channel_counts.h"
#include "stores/open_store.h"
#include "voxel/image_kinds.h"

namespace ombre::jobs {
namespace {

std::string counted(int64_t count, const std::string& noun) {
  return format_count(static_cast<unsigned long long>(count)) + ' ' + noun + (count == 1 ? "" : "s");
}

std::string place_text(Vec3 p) { return '(' + mm_text(p.x) + ", " + mm_text(p.y) + ", " + mm_text(p.z) + ')'; }

// Returns a text such as "doses of 8 bits: density from 0.2 (black) to 1.1 (white) g/cm3".
std::string channel_text(const voxel::Channel& channel) {
  const voxel::ChannelKind& kind = voxel::channel_kind(channel.type);
  const auto& [lo, hi] = channel.range;
  std::string text = kind.plural + ": " + channel.name;
  if (kind.last_shade == 0) return text;
  if (kind.is_dose())
    text += " from " + format_rounded(lo, 4) + " (black) to " + format_rounded(hi, 4) + " (white)";
  else
    text += ", white from " + format_rounded((lo + hi) / 2, 4);
  return text + (channel.unit.empty() ? "" : " " + channel.unit);
}

// Returns what the layers show, such as "materials: red, blue".
std::string shown_text(const compile::SliceRequest& request) {
  std::vector<std::string> names, texts;
  for (const compile::SliceMaterial& material : request.materials) names.push_back(material.name);
  for (const voxel::Channel& channel : request.channels)
    texts.push_back(channel.type == voxel::ChannelType::material ? "materials: " + join(names, ", ")
                                                                 : channel_text(channel));
  return join(texts, "; ");
}

// Returns the members that name what the layers show.
DataMembers shown_members(const compile::SliceRequest& request) {
  DataList materials, channels = compile::describe_channels(request);
  for (const compile::SliceMaterial& material : request.materials) materials.emplace_back(material.name);
  DataMembers members;
  if (request.has_materials()) members.emplace_back("materials", std::move(materials));
  if (!channels.empty()) members.emplace_back("channels", std::move(channels));
  return members;
}

// Returns why all layers are empty.
std::string emptiness_text(const compile::SliceRequest& request) {
  if (request.has_materials()) return "no voxel's centre is inside the design";
  return "no voxel's centre is inside the design, or all values there are 0 in the images";
}

void append(DataMembers& members, DataMembers more) { std::ranges::move(more, std::back_inserter(members)); }

// Returns for example "modulus to fractions of VeroClear, Agilus30Clr by agilus-vero-modulus (illustrative)".
std::string step_text(const Data& step) {
  const Data* const rounded = step.find("rounded_to");
  const std::string rounding =
      rounded ? ", rounded to multiples of " + format_rounded(*rounded->number()) + " as the machine takes them" : "";
  if (!step.find("calibration")) return *step.find("to")->string() + rounding;
  const auto texts = [&](const char* name) {
    std::vector<std::string> found;
    if (const Data* list = step.find(name))
      for (const Data& text : *list->list()) found.push_back(*text.string());
    return join(found, ", ");
  };
  const std::string materials = texts("materials");
  return texts("from") + " to " + *step.find("to")->string() + (materials.empty() ? "" : " of " + materials) + " by " +
         *step.find("calibration")->string() + (*step.find("illustrative")->boolean() ? " (illustrative)" : "") +
         rounding;
}

}  // namespace

void tell_plan(const Events& events, const compile::SliceRequest& request, const compile::SliceOptions& options) {
  const auto& [nx, ny, nz] = request.lattice.count;
  const auto& pitch = request.lattice.pitch;
  const Vec3 size = request.lattice.box().size();
  events.say("box " + format_rounded(size.x, 6) + " x " + format_rounded(size.y, 6) + " x " +
             format_rounded(size.z, 6) + " mm, voxels " + format_rounded(pitch[0].mm()) + " x " +
             format_rounded(pitch[1].mm()) + " x " + format_rounded(pitch[2].mm()) + " mm");
  events.say(counted(nz, "layer") + " of " + std::to_string(nx) + " x " + std::to_string(ny) + ", " +
             format_count(request.lattice.voxels()) + " voxels; " + shown_text(request));
  for (const Data& step : request.resolved) events.say(step_text(step));
  if (options.layers)
    events.say("layers " + std::to_string(options.layers->begin) + ':' + std::to_string(options.layers->end) +
               " of these");
  DataMembers members{{"folder", options.folder},
                      {"printer", request.printer},
                      {"voxels", DataList{number(nx), number(ny), number(nz)}},
                      {"pitch_mm", DataList{pitch[0].mm(), pitch[1].mm(), pitch[2].mm()}},
                      {"size_mm", DataList{size.x, size.y, size.z}}};
  append(members, shown_members(request));
  events.event("plan", members);
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
  std::string text = counted(report.layers_written, "layer") + " written to " +
                     (report.whole_job_finished ? options.folder : stores::pieces_folder(options.folder));
  if (report.layers_kept > 0) text += ", " + counted(report.layers_kept, "layer") + " finished before";
  if (report.layers_dropped > 0) text += ", " + counted(report.layers_dropped, "empty layer") + " left out";
  const double voxels = static_cast<double>(report.layers_written + report.layers_dropped) *
                        static_cast<double>(request.lattice.count[0]) * static_cast<double>(request.lattice.count[1]);
  text += "; " + format_bytes(static_cast<double>(report.bytes_written)) + " in " + format_rounded(report.seconds, 3) +
          " s";
  if (report.seconds > 0 && voxels > 0) text += ", " + rate_text(voxels / report.seconds);
  events.say(text);

  const double voxel_mm3 = compile::voxel_mm3(request.lattice);
  for (const std::string& counted : compile::count_texts(request, report.counts, voxel_mm3)) events.say("  " + counted);
  const bool has_all_layers = report.layers.begin == 0 && report.layers.end == request.lattice.count[2];
  if (has_all_layers && report.voxels_inside == 0) events.warn(emptiness_text(request) + ": all layers are empty");
  if (options.shard && !report.stopped_by_check)
    events.say("share " + std::to_string(options.shard->number) + " of " + std::to_string(options.shard->count) +
               " is done; once all are, the same command with --resume in place of --shard joins them");
  else if (!report.whole_job_finished && !report.stopped_by_check)
    events.say("other layers of the job are missing; --resume writes them");
  DataMembers members{{"folder", options.folder},
                      {"complete", report.whole_job_finished},
                      {"layers_written", number(report.layers_written)},
                      {"layers_kept", number(report.layers_kept)},
                      {"layers_dropped", number(report.layers_dropped)},
                      {"voxels_inside", number(report.voxels_inside)}};
  append(members, compile::describe_counts(request, report.counts, voxel_mm3));
  append(members, {{"bytes_written", number(report.bytes_written)}, {"seconds", report.seconds}});
  events.event("done", members);
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
