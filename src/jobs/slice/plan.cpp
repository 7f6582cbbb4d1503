// Decides the lattice of a job and everything else that its bytes depend on.
#include "jobs/slice/plan.h"

#include <cmath>
#include <map>

#include "base/system/tasks.h"
#include "base/text/text.h"
#include "export/image_stack.h"
#include "jobs/slice/coverage_layers.h"
#include "jobs/slice/resolved_plan.h"
#include "jobs/slice/seen_materials.h"
#include "jobs/slice/value_layers.h"
#include "questions/build.h"
#include "questions/design_stages.h"
#include "questions/region_survey.h"
#include "voxel/image_kinds.h"
#include "voxel/layers.h"

namespace ombre::compile {
namespace {

constexpr int64_t most_along_axis = 1'000'000,  // also the limit of libpng
    most_in_layer = int64_t{1} << 34;

std::string size_text(Vec3 v) {
  return format_rounded(v.x) + " x " + format_rounded(v.y) + " x " + format_rounded(v.z) + " mm";
}

std::array<Pitch, 3> job_pitch(const design::Design& design, const PlanOptions& options) {
  std::array<Pitch, 3> pitch = options.printer.pitch;
  if (design.sampling && !options.printer_given) pitch = design.sampling->pitch;
  for (size_t axis = 0; axis < 3; ++axis)
    if (options.pitch[axis]) pitch[axis] = *options.pitch[axis];
  return pitch;
}

class LatticePlanner {
 public:
  LatticePlanner(const Loaded& loaded, const PlanOptions& options, const Box& part, Diagnostics& diagnostics)
      : printer_(options.printer), part_(part), diagnostics_(diagnostics), where_{loaded.source, 0, 0} {
    lattice_.pitch = job_pitch(loaded.design, options);
    place_ = options.whole_tray ? voxel::Placement::design : options.place.value_or(printer_.origin);
    whole_tray_ = options.whole_tray;
  }

  std::optional<voxel::Lattice> run() {
    lattice_.origin = part_.lo;
    const Vec3 size = part_.size();
    for (int axis = 0; axis < 3; ++axis) {
      const double voxels = size[axis] / pitch(axis).mm();
      if (!(voxels <= static_cast<double>(most_along_axis)))
        return fail(Code::too_large,
                    "the part is " + format_count(static_cast<unsigned long long>(std::min(voxels, 1e18))) +
                        " voxels long along " + letter(axis) + ", at most " + format_count(most_along_axis) +
                        " are possible",
                    "choose larger voxels with " + spelled::option("--voxel") + " or " + spelled::option("--dpi"));
      count(axis) = voxel::voxels_along(size[axis], pitch(axis));
    }
    if (printer_.build_mm && !fits(size)) return std::nullopt;
    if ((whole_tray_ || place_ == voxel::Placement::center) && !cover_tray()) return std::nullopt;
    if (count(0) > most_in_layer / count(1))
      return fail(
          Code::too_large,
          "one layer would have " +
              format_count(static_cast<unsigned long long>(count(0)) * static_cast<unsigned long long>(count(1))) +
              " voxels",
          "choose larger voxels with " + spelled::option("--voxel") + " or " + spelled::option("--dpi"));
    return lattice_;
  }

 private:
  std::nullopt_t fail(Code code, const std::string& message, const Phrase& hint) {
    diagnostics_.error(code, where_, message, hint);
    return std::nullopt;
  }

  static std::string letter(int axis) { return {static_cast<char>('x' + axis)}; }
  Pitch pitch(int axis) const { return lattice_.pitch[static_cast<size_t>(axis)]; }
  int64_t& count(int axis) { return lattice_.count[static_cast<size_t>(axis)]; }

  bool fits(Vec3 size) {
    const Vec3 build = *printer_.build_mm;
    constexpr double slack = 1e-6;
    if (size.x <= build.x + slack && size.y <= build.y + slack && size.z <= build.z + slack) return true;
    fail(Code::outside_box,
         "the part is " + size_text(size) + ", larger than what " + printer_.title + " builds, " + size_text(build),
         "scale or split it, or choose another printer");
    return false;
  }

  // Extends the lattice to the tray. Parts move on it by whole voxels, so they keep their own voxels.
  bool cover_tray() {
    if (!printer_.build_mm) {
      fail(Code::outside_box, "the profile \"" + printer_.name + "\" has no tray size",
           "choose a printer with " + spelled::option("--printer") + ", or leave out " + spelled::option("--tray") +
               " and " + spelled::option("--place", "center"));
      return false;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const int64_t part = count(axis);
      // The tray has a whole number of voxels, rounded as printers do; a part as large as the tray fits.
      const int64_t tray = std::max<int64_t>(part, std::llround((*printer_.build_mm)[axis] / pitch(axis).mm()));
      int64_t before = 0;  // voxels between the tray's corner and the part's
      if (place_ == voxel::Placement::center)
        before = axis == 2 ? 0 : (tray - part) / 2;
      else
        before = static_cast<int64_t>(std::llround(part_.lo[axis] / pitch(axis).mm()));
      if (before < 0 || before + part > tray) {
        fail(Code::outside_box,
             "the part lies from " + format_rounded(part_.lo[axis]) + " to " + format_rounded(part_.hi[axis]) +
                 " mm along " + letter(axis) + ", the tray from 0 to " + format_rounded((*printer_.build_mm)[axis]) +
                 " mm",
             "move it with translate, or write " + spelled::option("--place", "center"));
        return false;
      }
      lattice_.origin[axis] = part_.lo[axis] - pitch(axis).times(static_cast<double>(before));
      // Layers above the part are empty, so they are left out.
      count(axis) = axis == 2 ? before + part : tray;
    }
    return true;
  }

  const voxel::Printer& printer_;
  Box part_;
  Diagnostics& diagnostics_;
  SourceRange where_;
  voxel::Lattice lattice_;
  voxel::Placement place_ = voxel::Placement::design;
  bool whole_tray_ = false;
};

std::string place_text(const SourceRange& where) {
  if (!where.source) return "";
  const Place place = where.source->place(where.begin);
  return where.source->name() + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

void warn_of_features(const voxel::Printer& printer, const Vec3 size, const SourceRange& where,
                      Diagnostics& diagnostics) {
  if (!printer.smallest_feature) return;
  const double least = std::min({size.x, size.y, size.z});
  if (least < printer.smallest_feature->fails_mm)
    diagnostics.warning(where, "the part is only " + format_rounded(least) + " mm thick; " + printer.title +
                                   " fails below " + format_rounded(printer.smallest_feature->fails_mm) + " mm");
  else if (least < printer.smallest_feature->distorts_mm)
    diagnostics.warning(where, "the part is only " + format_rounded(least) + " mm thick; " + printer.title +
                                   " distorts details below " + format_rounded(printer.smallest_feature->distorts_mm) +
                                   " mm");
}

// Warns of materials that images of one channel cannot distinguish.
void warn_of_grays(const SliceRequest& request, const SourceRange& where, Diagnostics& diagnostics) {
  if (request.format != ImageFormat::gray) return;
  const auto gray = [&](formats::Rgba colour) { return static_cast<int>(exporting::shown(colour, request.format)[0]); };
  std::map<int, std::string> names{{gray(request.background), "void"}};
  // Each material has an image of its own, or all share one.
  const bool alone = request.files.has_material();
  for (const SliceMaterial& material : request.materials) {
    const auto [same, is_new] = names.try_emplace(gray(material.rgba), material.name);
    if (!is_new && (!alone || same->second == "void"))
      diagnostics.warning(
          where,
          material.name + " and " + same->second + " are both gray " + std::to_string(same->first) + " in the images",
          "give them colours of different brightness in a materials file");
  }
}

// Returns whether the chosen images take the channel; if not, adds a diagnostic.
bool images_take(const PlanOptions& options, const voxel::Channel& channel, const SourceRange& where,
                 Diagnostics& diagnostics) {
  if (!options.image || voxel::takes(*options.image, channel.type)) return true;
  std::vector<std::string> taken;
  for (const voxel::ChannelType type : voxel::image_kind(*options.image).takes)
    taken.push_back(voxel::channel_kind(type).plural);
  const std::vector<std::string> others = voxel::image_formats_of(channel.type);
  diagnostics.error(Code::option, where,
                    "images of the format \"" + voxel::to_text(*options.image) + "\" hold " + join(taken, " or ") +
                        ", but the layers hold " + voxel::channel_kind(channel.type).plural + " of \"" + channel.name +
                        '"',
                    "write " + spelled::option("--format", join(others, " or ")) + ", or leave it out");
  return false;
}

// Returns the part of the request that is the same for every job on the lattice.
SliceRequest base_request(const PlanOptions& options, const voxel::Lattice& lattice, const Hash& design_hash,
                          const voxel::Channel& channel) {
  SliceRequest request;
  request.channels = {channel};
  use_printer(request, options.printer, options.image);
  request.program = options.program;
  request.design_hash = design_hash.hex();
  request.lattice = lattice;
  static_cast<SamplingRules&>(request) = options;
  if (request.evaluator == voxel::Evaluator::batch) request.evaluator = voxel::best_evaluator(lattice);
  return request;
}

// Sets the light of layers that show doses, if the machine's irradiance is known: white gets its dose in this time.
// Returns false, and adds an error, if black would need light, too.
bool set_light(SliceRequest& request, const SourceRange& where, Diagnostics& diagnostics) {
  const voxel::Channel& channel = request.channels.front();
  if (!request.exposure || !request.exposure->irradiance || channel.unit != "mJ/cm2") return true;
  request.exposure->seconds = channel.range.hi / *request.exposure->irradiance;
  if (channel.range.lo == 0) return true;
  diagnostics.error(Code::option, where,
                    "black gets no light, and the range of " + channel.name + " begins at " +
                        format_rounded(channel.range.lo) + " mJ/cm2",
                    "write " + spelled::option("--range", "0," + format_rounded(channel.range.hi)));
  return false;
}

// Diffuses errors within this lattice only.
std::vector<voxel::LayerResult> diffused_alone(const voxel::MaterialProgram& program, const voxel::Lattice& lattice,
                                               uint64_t seed, const voxel::EvaluatorOptions& how,
                                               const StopFlag* stop) {
  const voxel::LayerEvaluator evaluator(program, lattice, voxel::Dither::diffusion, seed, how);
  return evaluator.layers(0, lattice.count[2], stop);
}

design::Design design_on(const design::Design& design, const voxel::Lattice& lattice, const PlanOptions& options) {
  const StageLoan loan{options.threads, options.memory_bytes, nullptr, options.stop, options.memory};
  return with_stages(design::for_lattice(design, {lattice.origin, lattice.pitch}), loan);
}

// Warns of materials that images of coverage do not tell apart. Returns false, and adds a diagnostic, if they cannot be
// found.
bool warn_of_joined(const design::Design& design, const Box& box, int threads, const SourceRange& where,
                    Diagnostics& diagnostics) {
  const auto found = find_materials(design, box, threads, diagnostics);
  if (found && found->names.size() > 1)
    diagnostics.warning(where, "images of coverage show " + join(found->names, " and ") + " alike, as one material",
                        "write " + spelled::option("--by", found->names.front()) + " in place of " +
                            spelled::option("--antialias") + " for one of them");
  return found.has_value();
}

std::optional<Plan> plan_value(const LoadedPtr& loaded, const PlanOptions& options, const Box& box,
                               const voxel::Lattice& lattice, Diagnostics& diagnostics) {
  const design::Design design = design_on(loaded->design, lattice, options);
  const auto channel = value_channel(design, box, *options.value, diagnostics);
  if (!channel || !images_take(options, *channel, {loaded->source, 0, 0}, diagnostics)) return std::nullopt;
  if (is_coverage(*channel) && !warn_of_joined(design, box, options.threads, {loaded->source, 0, 0}, diagnostics))
    return std::nullopt;
  Plan plan;
  plan.stages = stages_of(design);
  plan.request = base_request(options, lattice, design::hash(loaded->design), *channel);
  if (!set_light(plan.request, {loaded->source, 0, 0}, diagnostics)) return std::nullopt;
  const bool has_own_range = options.value->range && voxel::channel_kind(channel->type).is_dose();
  const RangeChecks checks = has_own_range ? RangeChecks::both_ends : RangeChecks::none;
  if (checks == RangeChecks::both_ends) plan.request.check_texts = texts_of_range_checks(*channel);
  auto regions = value_layers(design, lattice, plan.request.channels, plan.request.evaluator, diagnostics, checks);
  if (!regions) return std::nullopt;
  plan.regions = [loaded, regions = std::move(*regions)](const voxel::TileBox& region, const StopFlag* stop) {
    return regions(region, stop);
  };
  plan.samples = plan.regions;
  plan.producer = whole_layers(plan.regions, lattice);
  return plan;
}

// Keeps in the request how the design was resolved. Returns false, and adds diagnostics, if some values are out of
// reach and the job does not take the nearest.
bool take_resolution(Plan& plan, const design::Design& on_lattice, const Resolution& resolution,
                     const PlanOptions& options, Diagnostics& diagnostics) {
  for (const voxel::ValueStep& step : resolution.rounded) plan.request.resolved.push_back(compile::describe(step));
  for (const ResolvedStep& step : resolution.steps) plan.request.resolved.push_back(describe(step));
  if (resolution.steps.empty()) return true;
  if (options.resolving->takes_nearest) return true;
  const size_t errors = diagnostics.error_count();
  stages_of(on_lattice)
      ->prepare({options.threads, options.memory_bytes, options.progress, options.stop, options.memory});
  report_out_of_reach(on_lattice, plan.request.lattice, resolution, options, {resolution.loaded->source, 0, 0},
                      diagnostics);
  return diagnostics.error_count() == errors;
}

// Removes materials from the request that no voxel has, if there seem to be more materials than the printer has: other
// solids hide them everywhere. Returns false, and adds a diagnostic, if too many are left.
bool prints_materials(Plan& plan, const PlanOptions& options, const SourceRange& where, Diagnostics& diagnostics) {
  const auto most = static_cast<size_t>(options.printer.max_materials);
  std::vector<SliceMaterial>& materials = plan.request.materials;
  if (materials.size() <= most) return true;
  SliceOptions work;
  work.threads = options.threads;
  work.memory_bytes = options.memory_bytes;
  plan.stages->prepare({options.threads, options.memory_bytes, options.progress, options.stop, options.memory});
  const std::set<MaterialId> seen =
      seen_materials(plan.request, plan.producer, most, work, options.progress, options.stop);
  if (seen.size() > most) {
    diagnostics.error(Code::limit, where,
                      "the design uses more than the " + std::to_string(most) +
                          (most == 1 ? " material that " : " materials that ") + options.printer.title + " prints",
                      "use fewer, or choose another printer");
    return false;
  }
  const MaterialId kept = materials.front().id;  // a job has a material even if everything is void
  std::erase_if(materials, [&](const SliceMaterial& material) {
    return !seen.contains(material.id) && !(seen.empty() && material.id == kept);
  });
  return true;
}

}  // namespace

std::optional<Plan> plan_slice(const LoadedPtr& loaded, const PlanOptions& options, Diagnostics& diagnostics) {
  const auto box = design_box(loaded->design, diagnostics);
  return box ? plan_over(loaded, *box, options, diagnostics) : std::nullopt;
}

std::optional<Plan> plan_over(const LoadedPtr& as_written, const Box& box, const PlanOptions& options,
                              Diagnostics& diagnostics) {
  const auto resolution = resolve_for_job(as_written, options, diagnostics);
  if (!resolution) return std::nullopt;
  const LoadedPtr& loaded = resolution->loaded;
  const design::Design& design = loaded->design;
  const auto lattice = LatticePlanner(*loaded, options, box, diagnostics).run();
  if (!lattice) return std::nullopt;
  warn_of_features(options.printer, box.size(), {loaded->source, 0, 0}, diagnostics);
  if (options.value) {
    auto plan = plan_value(loaded, options, box, *lattice, diagnostics);
    if (!plan || !take_resolution(*plan, design_on(design, *lattice, options), *resolution, options, diagnostics))
      return std::nullopt;
    return plan;
  }
  const voxel::Channel materials;
  if (!images_take(options, materials, {loaded->source, 0, 0}, diagnostics)) return std::nullopt;
  const design::Design on_lattice = design_on(design, *lattice, options);
  Hash design_hash;
  std::optional<Built> built;
  const auto hash = [&] { design_hash = design::hash(design); };
  const auto build = [&] { built = build_flat_program(on_lattice, diagnostics, options.threads); };
  if (options.threads == 1) {  // one after the other, since both take memory
    hash();
    build();
  } else {
    run_parallel(2, options.threads, [&](size_t task) { task == 0 ? build() : hash(); });
  }
  if (!built) return std::nullopt;
  leave_out_impossible(*built, lattice->box(), options.threads);

  Plan plan;
  plan.stages = stages_of(on_lattice);
  SliceRequest& request = plan.request = base_request(options, *lattice, design_hash, materials);
  for (const MaterialId id : built->materials.materials) {
    if (id == 0) continue;
    const design::Material& material = design.materials.all()[id];
    request.materials.push_back({material.name, id, material.colour});
  }
  for (const design::Check& check : built->checks) {
    request.check_texts.push_back(check.message);
    request.check_places.push_back(place_text(check.where));
  }
  voxel::EvaluatorOptions how = options.speed;
  how.evaluator = request.evaluator;
  auto evaluator =
      std::make_shared<const voxel::LayerEvaluator>(built->materials, *lattice, options.dither, options.seed, how);
  plan.regions = [loaded, evaluator](const voxel::TileBox& region, const StopFlag* stop) {
    return evaluator->region(region, stop);
  };
  plan.samples = plan.regions;
  if (options.dither == voxel::Dither::diffusion)
    plan.samples = [loaded, program = built->materials, lattice = *lattice, seed = options.seed, how](
                       const voxel::TileBox& region, const StopFlag* stop) {
      return diffused_alone(program, voxel::part_of(lattice, region), seed, how, stop);
    };
  plan.producer = whole_layers(plan.regions, *lattice);
  if (options.finds_short_periods) plan.periods = find_short_periods(built->materials.program, *lattice);
  if (!take_resolution(plan, on_lattice, *resolution, options, diagnostics)) return std::nullopt;
  if (!prints_materials(plan, options, {loaded->source, 0, 0}, diagnostics)) return std::nullopt;
  warn_of_grays(request, {loaded->source, 0, 0}, diagnostics);
  return plan;
}

}  // namespace ombre::compile
