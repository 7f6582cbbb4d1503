#include "jobs/slice/resolved_plan.h"

#include <algorithm>

#include "base/math/point_text.h"
#include "base/text/text.h"
#include "design/attributes.h"
#include "load/find_calibration.h"
#include "load/ink_step.h"
#include "questions/question.h"
#include "questions/reach_survey.h"

namespace ombre::compile {
namespace {

std::string with_unit(double value, const std::string& unit) {
  return format_rounded(value, 6) + (unit.empty() || unit == "1" ? "" : ' ' + unit);
}

// Returns what the job's layers show: an attribute, or fractions of materials.
std::string need_of(const Loaded& loaded, const PlanOptions& options) {
  if (!options.value || loaded.design.materials.find(options.value->of)) return std::string(calibration::fractions);
  return std::string(design::attribute_of_part(options.value->of));
}

// Returns false, and adds an error, if the printer takes no fractions of materials.
bool takes_fractions(const voxel::Printer& printer, const LoadedPtr& loaded, Diagnostics& diagnostics) {
  if (std::ranges::find(printer.needs, calibration::fractions) != printer.needs.end()) return true;
  diagnostics.error(Code::option, {loaded->source, 0, 0},
                    printer.title + " takes " + join(printer.needs, " and ") + ", not layers of materials",
                    "write ombre resolve DESIGN --printer " + printer.name +
                        " -o resolved.json, and then ombre mesh resolved.json --by " + join(printer.needs, ","));
  return false;
}

// Returns the attributes of the design that the calibrations read or give.
std::vector<std::string> attributes_of(const std::vector<calibration::CalibrationPtr>& calibrations,
                                       const design::Design& design) {
  const auto knows = [&](const std::string& name) {
    return std::ranges::any_of(calibrations, [&](const auto& calibration) { return calibration->concerns(name); });
  };
  std::vector<std::string> names;
  for (const design::AttributeDeclaration& declared : declared_attributes(design))
    if ((declared.type == design::ValueType::number || is_colour(declared)) && knows(declared.name))
      names.push_back(declared.name);
  return names;
}

// Reports that calibrations have nothing to do: an error if they were chosen.
void report_nothing_to_do(const std::string& need, const std::vector<std::string>& attributes, bool are_chosen,
                          const SourceRange& where, Diagnostics& diagnostics) {
  const bool has_materials = need == calibration::fractions;
  if (are_chosen)
    diagnostics.error(Code::option, where,
                      has_materials ? "the design names its materials itself" : "the design gives " + need + " itself",
                      "leave out " + spelled::option("--calibration"));
  else if (has_materials)
    diagnostics.note(where, "the design names materials, so " + join(attributes, " and ") + " does not choose any");
}

// Tells of colours that would choose materials by a profile of inks.
void note_colours(const LoadedPtr& loaded, Diagnostics& diagnostics) {
  for (const design::AttributeDeclaration& declared : declared_attributes(loaded->design))
    if (is_colour(declared))
      diagnostics.note({loaded->source, 0, 0},
                       declared.name +
                           " does not choose materials, since the job has no calibration with an ICC profile of inks; "
                           "colour_mixture shows colours by the mean of the droplets' light without one");
}

// Tells of properties that would choose materials by a calibration that comes with Ombre, if the job had one.
void note_what_chooses_none(const LoadedPtr& loaded, Diagnostics& diagnostics) {
  std::vector<calibration::CalibrationPtr> shipped;
  for (const std::string& name : calibration_names())
    if (const auto found = find_calibration(name, diagnostics); found && found->has_fractions())
      shipped.push_back(found);
  const std::vector<std::string> attributes = attributes_of(shipped, loaded->design);
  if (names_materials(loaded->design)) return;
  note_colours(loaded, diagnostics);
  if (attributes.empty()) return;
  diagnostics.note({loaded->source, 0, 0},
                   join(attributes, " and ") +
                       " does not choose materials, since the job has no calibration; \"ombre " +
                       "calibrations\" lists those that come with Ombre");
}

}  // namespace

std::optional<Resolution> resolve_for_job(const LoadedPtr& loaded, const PlanOptions& options,
                                          Diagnostics& diagnostics) {
  if (!options.resolving) return Resolution{loaded, {}, {}};
  if (!options.value && !takes_fractions(options.printer, loaded, diagnostics)) return std::nullopt;
  const CalibrationNames& names = options.resolving->calibrations;
  const bool are_chosen = !names.chosen.empty();
  const auto calibrations = load_calibrations(names, diagnostics);
  if (!calibrations) return std::nullopt;
  const std::vector<std::string> attributes = attributes_of(*calibrations, loaded->design);
  if (!are_chosen && attributes.empty()) {
    if (calibrations->empty() && !options.value) note_what_chooses_none(loaded, diagnostics);
    return Resolution{loaded, {}, {}};
  }
  const std::string need = need_of(*loaded, options);
  auto resolution =
      resolve(loaded, *calibrations, {need}, are_chosen ? Unresolved::is_error : Unresolved::is_left, diagnostics);
  if (!resolution || !resolution->steps.empty()) return resolution;
  const bool names_some = need == calibration::fractions && names_materials(loaded->design);
  if (are_chosen || names_some) report_nothing_to_do(need, attributes, are_chosen, {loaded->source, 0, 0}, diagnostics);
  return are_chosen ? std::nullopt : std::move(resolution);
}

void report_out_of_reach(const design::Design& resolved, const voxel::Lattice& lattice,
                         const std::vector<ResolvedStep>& all_steps, const PlanOptions& options,
                         const SourceRange& where, Diagnostics& diagnostics) {
  // A rendering intent says what replaces colours that inks do not show.
  std::vector<ResolvedStep> steps;
  std::ranges::remove_copy_if(all_steps, std::back_inserter(steps),
                              [](const ResolvedStep& step) { return !!step.inks; });
  if (steps.empty()) return;
  std::vector<AttributeReach> reaches;
  for (const ResolvedStep& step : steps) reaches.push_back({step.attribute, step.reach});
  const auto found = survey_reach(resolved, lattice, reaches, options.threads, options.stop, diagnostics);
  for (size_t n = 0; found && n < steps.size(); ++n) {
    const OutOfReach& beyond = (*found)[n];
    if (beyond.voxels == 0) continue;
    const std::string& unit = steps[n].unit;
    const double nearest = std::clamp(beyond.worst, steps[n].reach.lo, steps[n].reach.hi);
    diagnostics.error(Code::limit, where,
                      steps[n].attribute + " is out of reach at " + format_count(beyond.voxels) + " voxels: it is " +
                          with_unit(beyond.worst, unit) + " at " + format_point(beyond.worst_mm) +
                          " mm, and the nearest value that " + steps[n].step.calibration->name + " reaches is " +
                          with_unit(nearest, unit),
                      "ask for " + format_rounded(steps[n].reach.lo, 6) + " to " +
                          format_rounded(steps[n].reach.hi, 6) + ", or take the nearest with " +
                          spelled::option("--out-of-reach", "nearest"));
  }
}

}  // namespace ombre::compile
