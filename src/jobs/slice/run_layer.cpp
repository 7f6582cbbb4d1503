// `ombre layer` writes one layer of a job, as slicing would write it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>

#include "base/text/text.h"
#include "export/output_file.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/remarks.h"
#include "jobs/common/session.h"
#include "jobs/slice/channel_counts.h"
#include "jobs/slice/layer.h"
#include "jobs/slice/layer_files.h"
#include "jobs/slice/slice_choices.h"
#include "jobs/slice/slice_report.h"

namespace ombre::jobs {
namespace {

using compile::LayerChoices;

constexpr const char* layer_footer =
    "Lengths are millimetres in the design's space.\n\n"
    "Examples:\n"
    "  ombre layer part.vcad --z 3.2 -o layer.png           the layer at that height\n"
    "  ombre layer part.vcad --index 100 --printer j750     a layer of a printer's job, the lowest is 0\n"
    "  ombre layer part.vcad --z 0 --box -5,-5,5,5 -o -     a part of it, to stdout\n";

int64_t chosen_layer(const LayerChoices& a, const voxel::Lattice& lattice) {
  const int64_t count = lattice.count[2];
  if (!a.index.empty()) {
    const auto range =
        a.index.find(':') == std::string::npos ? compile::parse_layer_range(a.index, count) : std::nullopt;
    if (range) return range->begin;
    throw WrongArgument(spelled::option("--index", a.index) + " is none of the " +
                        format_count(static_cast<unsigned long long>(count)) + " layers, which are 0 to " +
                        std::to_string(count - 1));
  }
  if (const auto layer = compile::layer_at(lattice, *a.z_mm)) return *layer;
  const Box box = lattice.box();
  throw WrongArgument(spelled::option("--z", format_number(*a.z_mm)) + " is outside the part, which lies from " +
                      mm_text(box.lo.z) + " to " + mm_text(box.hi.z) + " mm along z");
}

std::optional<compile::LayerWindow> chosen_window(const LayerChoices& a, const voxel::Lattice& lattice) {
  if (!a.box) return std::nullopt;
  const auto& [lo, hi] = *a.box;
  if (const auto window = compile::window_over(lattice, lo.x, lo.y, hi.x, hi.y)) return window;
  const Box box = lattice.box();
  const std::vector<std::string> corners{format_number(lo.x), format_number(lo.y), format_number(hi.x),
                                         format_number(hi.y)};
  throw WrongArgument(spelled::option("--box", join(corners, ",")) + " is beside the images, which lie from " +
                      mm_text(box.lo.x) + "," + mm_text(box.lo.y) + " to " + mm_text(box.hi.x) + "," +
                      mm_text(box.hi.y) + " mm");
}

// Returns the names of files: part.vcad and slice_00012.png give part_slice_00012.png. If each material has a file, -o
// layer.png gives layer_red.png, layer_blue.png and so on; other channels likewise.
std::vector<std::string> output_files(const LayerChoices& a, const compile::SliceRequest& request, int64_t layer) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  if (a.output.empty()) {
    for (const std::string& name : compile::LayerFiles(request).names(layer))
      files.push_back(fs::path(a.design.design).stem().string() + "_" + name);
    return files;
  }
  if (!request.files.has_material()) return {a.output};
  if (a.output == "-") throw WrongArgument("each material has an image, and stdout holds one; give -o a file name");
  const fs::path path(a.output);
  for (const std::string& word : compile::file_words(compile::shown_names(request)))
    files.push_back((path.parent_path() / (path.stem().string() + "_" + word + path.extension().string())).string());
  return files;
}

void tell_layer(const Events& events, const compile::SliceRequest& request, int64_t layer, bool is_part,
                const compile::LayerImages& images, const std::vector<std::string>& files) {
  const auto face = [&](int64_t index) {
    return request.lattice.origin.z + request.lattice.pitch[2].times(static_cast<double>(index));
  };
  events.say("layer " + std::to_string(layer) + ", " + mm_text(face(layer)) + " to " + mm_text(face(layer + 1)) +
             " mm, written to " + join(files, ", "));
  for (const std::string& text : compile::count_texts(request, images.counts, std::nullopt))
    events.say("  " + text + (is_part ? " in the box" : ""));
  DataList names;
  for (const std::string& file : files) names.emplace_back(file);
  DataMembers members{
      {"files", names}, {"layer", static_cast<double>(layer)}, {"z_mm", DataList{face(layer), face(layer + 1)}}};
  std::ranges::move(compile::describe_counts(request, images.counts, std::nullopt), std::back_inserter(members));
  events.event("done", members);
}

// The layer, the window in it, and its files.
struct LayerPlan {
  compile::Plan plan;
  int64_t layer = 0;
  std::optional<compile::LayerWindow> window;
  std::vector<std::string> files;
};

void refuse_to_overwrite_any(const std::vector<std::string>& files, bool force) {
  for (const std::string& file : files)
    if (file != "-") refuse_to_overwrite(file, force);
}

int write_layer(const LayerChoices& a, const LayerPlan& layer_plan, Session& session) {
  const auto& [plan, layer, window, files] = layer_plan;
  const compile::SliceRequest& request = plan.request;
  const bool to_stdout = a.output == "-";
  const compile::StageLoan loan{a.work.threads, a.work.memory_bytes, nullptr, &session.stop};
  warn_of_memory(session.events, "the layer",
                 compile::layer_memory_bytes(request, window) + static_cast<double>(plan.stages->memory_bytes(loan)),
                 a.work.memory_bytes);
  plan.stages->prepare(loan);
  const compile::LayerImages images = compile::make_layer(request, plan.regions, layer, window, &session.stop);
  if (to_stdout) {
    session.events.print(images.bytes.front());
  } else {
    for (size_t i = 0; i < files.size(); ++i) exporting::write_file(files[i], images.bytes[i]);
    tell_layer(session.events, request, layer, window.has_value(), images, files);
  }
  tell_checks(session.events, images.checks);
  return done;
}

std::optional<LayerPlan> plan_job(const LayerChoices& a, compile::PlanOptions options, Session& session,
                                  Diagnostics& diagnostics) {
  if (!a.calibrations.apply(options, a.design.materials, diagnostics)) return std::nullopt;
  const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.work.threads);
  auto plan = loaded ? compile::plan_slice(loaded, options, diagnostics) : std::nullopt;
  if (!plan) return std::nullopt;
  const int64_t layer = chosen_layer(a, plan->request.lattice);
  const auto window = chosen_window(a, plan->request.lattice);
  std::vector<std::string> files = output_files(a, plan->request, layer);
  return LayerPlan{std::move(*plan), layer, window, std::move(files)};
}

// True if the names are known before the plan. Default names, and those of a file for each material, are not.
bool has_known_name(const LayerChoices& a, const compile::PlanOptions& options) {
  compile::SliceRequest images;
  if (options.value) images.channels.clear();  // no materials, which may have a file each
  compile::use_printer(images, options.printer, options.image);
  return !a.output.empty() && !images.files.has_material();
}

void check_choices(const LayerChoices& a, const Session& session) {
  if (!a.z_mm && a.index.empty())
    throw WrongArgument("which layer? write " + spelled::option("--z") + " with a height in mm, or " +
                        spelled::option("--index") + " with a number");
  if (a.output == "-" && session.events.prints_among_events())
    throw WrongArgument("-o - writes the image to stdout, where " + spelled::option("--json") +
                        " writes events; give -o a file name");
}

int layer(const LayerChoices& a, Session& session) {
  check_choices(a, session);
  Diagnostics of_printer;
  const auto options = plan_options(a.sampling, a.work, session, of_printer, a.images);
  session.events.diagnose(of_printer);
  if (!options) return wrong_input;
  JobSteps<LayerPlan> steps;
  steps.refuse = [&] {
    if (has_known_name(a, *options)) refuse_to_overwrite_any({a.output}, a.force);
  };
  steps.plan = [&](Diagnostics& diagnostics) { return plan_job(a, *options, session, diagnostics); };
  steps.check = [&](const LayerPlan& plan) { refuse_to_overwrite_any(plan.files, a.force); };
  steps.run = [&](const LayerPlan& plan) { return write_layer(a, plan, session); };
  return take_steps(steps, session);
}

}  // namespace

JobKind layer_kind() {
  return job_kind<LayerChoices>("layer", "Write one layer, with the pixels that slicing would write", layer_footer,
                                layer);
}

}  // namespace ombre::jobs
