#include "jobs/slice/resolved_plan.h"

#include <algorithm>

#include "base/math/point_text.h"
#include "base/text/text.h"
#include "design/attributes.h"
#include "load/find_calibration.h"
#include "load/ink_step.h"
#include "questions/question.h"
#include "questions/reach_survey.h"
#include "questions/sampler.h"

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

std::vector<voxel::ValueStep> steps_of(const voxel::Printer& printer, const std::string& need) {
  std::vector<voxel::ValueStep> steps = printer.steps;
  std::erase_if(steps, [&](const voxel::ValueStep& step) { return step.of != need; });
  return steps;
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

// An attribute that may be out of reach.
struct ReachCheck {
  const ResolvedStep* step;
  std::string attribute, unit;
  std::string surveyed;  // the attribute, or its place in what is reached beside others
  Interval reach;        // of what is surveyed
};

std::vector<ReachCheck> checks_of(const Resolution& resolution) {
  std::vector<ReachCheck> checks;
  const auto add = [&checks](const std::vector<ResolvedStep>& steps) {
    for (const ResolvedStep& step : steps) {
      if (step.inks) continue;  // a rendering intent says what replaces colours that inks do not show
      const bool varies = !step.place_in_reach.empty();
      checks.push_back({&step, step.attribute, step.unit, varies ? step.place_in_reach : step.attribute,
                        varies ? Interval(1, 2) : step.reach});
      if (step.joint) continue;  // its place says whether both are reached
      for (const ReadAttribute& other : step.others)
        checks.push_back({&step, other.attribute, other.unit, other.attribute, other.reach});
    }
  };
  add(resolution.steps);
  add(resolution.agreeing);
  return checks;
}

// Returns a number of the design at a point.
double number_at(const design::Design& design, const std::string& attribute, const Vec3& point,
                 Diagnostics& diagnostics) {
  SampleQuery query;
  query.attributes = {attribute};
  double value = 0;
  double* const column = &value;
  if (const auto sampler = Sampler::build(design, query, diagnostics)) sampler->sample({&point, 1}, {&column, 1});
  return value;
}

// Returns the values that a step reaches at a point, where that varies with other attributes.
Interval reach_at(const ResolvedStep& step, const design::Design& design, const Vec3& point, Diagnostics& diagnostics) {
  std::vector<double> at = step.step.calibration->usual();
  for (const ReadAttribute& other : step.others)
    at[step.step.calibration->input_called(other.attribute)] = number_at(design, other.attribute, point, diagnostics);
  return step.step.calibration->reach(*step.step.input, at);
}

void report(const ReachCheck& check, const OutOfReach& beyond, const design::Design& design, const SourceRange& where,
            Diagnostics& diagnostics) {
  const bool varies = check.surveyed != check.attribute;
  const double worst = varies ? number_at(design, check.attribute, beyond.worst_mm, diagnostics) : beyond.worst;
  const Interval reach = varies ? reach_at(*check.step, design, beyond.worst_mm, diagnostics) : check.reach;
  std::vector<std::string> others;
  for (const ReadAttribute& other : check.step->others)
    if (varies) others.push_back(other.attribute);
  const std::string there = varies ? " beside this " + join(others, " and ") : "";
  diagnostics.error(Code::limit, where,
                    check.attribute + " is out of reach at " + format_count(beyond.voxels) + " voxels: it is " +
                        with_unit(worst, check.unit) + " at " + format_point(beyond.worst_mm) +
                        " mm, and the nearest value that " + check.step->step.calibration->name + " reaches" + there +
                        " is " + with_unit(std::clamp(worst, reach.lo, reach.hi), check.unit),
                    "ask for " + format_rounded(reach.lo, 6) + " to " + format_rounded(reach.hi, 6) +
                        (varies ? " there" : "") + ", or take the nearest with " +
                        spelled::option("--out-of-reach", "nearest"));
}

// Reports two properties that no mixture has both of.
void report_joint(const ReachCheck& check, const OutOfReach& beyond, const design::Design& design,
                  const SourceRange& where, Diagnostics& diagnostics) {
  const ResolvedStep& step = *check.step;
  const ReadAttribute& other = step.others[0];
  const double one = number_at(design, step.attribute, beyond.worst_mm, diagnostics);
  const double two = number_at(design, other.attribute, beyond.worst_mm, diagnostics);
  const auto reach = calibration::reach_beside(step.joint->first, step.joint->second, two);
  const auto range = [](const Interval& of, const std::string& unit) {
    return format_rounded(of.lo, 6) + " to " + with_unit(of.hi, unit);
  };
  const std::string can =
      reach ? "beside this " + other.attribute + " " + step.attribute + " is " + range(*reach, step.unit) + " by " +
                  step.step.names()
            : other.attribute + " is " + range(other.reach, other.unit) + " by " + step.step.beside->name;
  diagnostics.error(Code::limit, where,
                    step.attribute + " and " + other.attribute + " are out of reach together at " +
                        format_count(beyond.voxels) + " voxels: they are " + with_unit(one, step.unit) + " and " +
                        with_unit(two, other.unit) + " at " + format_point(beyond.worst_mm) + " mm, and " + can,
                    "ask for what a mixture of " + join(step.materials, ", ") + " has, or take a near one with " +
                        spelled::option("--out-of-reach", "nearest"));
}

}  // namespace

std::optional<Resolution> resolve_for_job(const LoadedPtr& loaded, const PlanOptions& options,
                                          Diagnostics& diagnostics) {
  if (!options.resolving) return Resolution{loaded};
  if (!options.value && !takes_fractions(options.printer, loaded, diagnostics)) return std::nullopt;
  const CalibrationNames& names = options.resolving->calibrations;
  const bool are_chosen = !names.chosen.empty();
  const auto calibrations = load_calibrations(names, diagnostics);
  if (!calibrations) return std::nullopt;
  const std::vector<std::string> attributes = attributes_of(*calibrations, loaded->design);
  const std::string need = need_of(*loaded, options);
  const std::vector<voxel::ValueStep> steps = steps_of(options.printer, need);
  if (!are_chosen && attributes.empty() && steps.empty()) {
    if (calibrations->empty() && !options.value) note_what_chooses_none(loaded, diagnostics);
    return Resolution{loaded};
  }
  const Needs needs{
      {need}, steps, options.resolving->deciding, are_chosen ? Unresolved::is_error : Unresolved::is_left};
  auto resolution = resolve(loaded, *calibrations, needs, diagnostics);
  if (!resolution || !resolution->steps.empty() || !resolution->rounded.empty()) return resolution;
  const bool names_some = need == calibration::fractions && names_materials(loaded->design);
  if (are_chosen || names_some) report_nothing_to_do(need, attributes, are_chosen, {loaded->source, 0, 0}, diagnostics);
  return are_chosen ? std::nullopt : std::move(resolution);
}

void report_out_of_reach(const design::Design& resolved, const voxel::Lattice& lattice, const Resolution& resolution,
                         const PlanOptions& options, const SourceRange& where, Diagnostics& diagnostics) {
  const std::vector<ReachCheck> checks = checks_of(resolution);
  if (checks.empty()) return;
  std::vector<AttributeReach> reaches;
  for (const ReachCheck& check : checks) reaches.push_back({check.surveyed, check.reach});
  const auto found = survey_reach(resolved, lattice, reaches, options.threads, options.stop, diagnostics);
  for (size_t n = 0; found && n < checks.size(); ++n)
    if ((*found)[n].voxels > 0)
      (checks[n].step->joint ? report_joint : report)(checks[n], (*found)[n], resolved, where, diagnostics);
}

}  // namespace ombre::compile
