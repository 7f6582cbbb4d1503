// `ombre homogenise` finds the stiffness or the conductivity of a cell of a design as a material.
#include <memory>

#include "base/system/stopwatch.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "fea/solve/conduction.h"
#include "fea/solve/homogenise.h"
#include "fea/solve/homogenise_conductivity.h"
#include "formats/containers/file.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/session.h"
#include "jobs/common/solve_memory.h"
#include "jobs/common/study_source.h"
#include "jobs/fea/periodic_box.h"
#include "jobs/homogenise/homogenise_choices.h"
#include "jobs/homogenise/homogenise_job.h"

namespace ombre::jobs {
namespace {

using compile::HomogeniseChoices;

constexpr const char* homogenise_footer =
    "The box is cut into bricks and repeated in all directions. Six strains, one after the other, give the stiffness "
    "of the\n"
    "equivalent homogeneous material: stresses over strains as xx, yy, zz, xy, yz, zx, in MPa. Void carries no "
    "load.\n\n"
    "Properties of materials come from the study (\"materials\") or the materials file:\n"
    "  {\"materials\": {\"red\": {\"modulus_mpa\": 2850, \"poissons_ratio\": 0.39}}}\n\n"
    "With \"physics\": \"heat\" or \"electric\" and \"conductivity_w_mk\" or \"conductivity_s_m\" of materials\n"
    "the result is the conductivity, from three gradients.\n\n"
    "Examples:\n"
    "  ombre homogenise cell.vcad --cell 0.25 -o cell.svg\n"
    "  ombre homogenise part.vcad --box 0,0,0,2,2,2 --cell 0.05 --assign draw --seed 3   # what dithering prints "
    "there\n";

std::optional<fea::Study> study_of(const HomogeniseChoices& a, Diagnostics& diagnostics) {
  if (a.study.empty()) return fea::Study{};
  const auto data = parse_json(study_source(a.study), diagnostics);
  return data ? fea::read_study(*data, diagnostics) : std::nullopt;
}

std::optional<fea::Model> make_model(const HomogeniseChoices& a, const fea::Study& study, Session& session,
                                     Diagnostics& diagnostics) {
  const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.work.threads);
  if (!loaded) return std::nullopt;
  const auto box = compile::periodic_box(loaded, a.box, a.cell_mm, diagnostics);
  if (!box) return std::nullopt;
  const compile::LoadedPtr sampled = compile::sampled_by(loaded, *box);
  compile::SamplingOptions sampling;
  sampling.rules.seed = a.seed;
  const auto options = plan_options(sampling, a.work, session, diagnostics);
  if (!options) return std::nullopt;
  const auto plan = compile::plan_model(sampled, *options, compile::FeaRequest::Fill::exact, diagnostics);
  if (!plan) return std::nullopt;
  const compile::FeaRequest request = a.sections.request(a.work.threads);
  JobProgress progress(session.events);
  auto model = compile::fea_model(sampled, *plan, study, request, diagnostics, &progress, &session.stop);
  progress.finish();
  if (!model || diagnostics.has_errors()) return std::nullopt;
  return compile::repeating(std::move(*model), *box, &session.stop);
}

std::string percent(double share) { return format_rounded(100 * share, 4) + " %"; }

Data rows_of(const fea::Stiffness& stiffness) {
  DataList rows;
  for (const auto& row : stiffness) rows.emplace_back(DataList(row.begin(), row.end()));
  return rows;
}

Data list_of(const std::array<double, 3>& values) { return DataList(values.begin(), values.end()); }

std::string text_of(const std::array<double, 3>& values) {
  return format_rounded(values[0], 4) + ", " + format_rounded(values[1], 4) + ", " + format_rounded(values[2], 4);
}

// Returns a text with the share of the design's own volume beside that of the bricks.
std::string share_text(double design_share, double brick_share) {
  return percent(design_share) + " of the box is solid, " + percent(brick_share) + " by its bricks";
}

double design_share(const fea::Model& model) {
  const fea::Bricks& bricks = model.bricks;
  return model.design_mm3 / (bricks.volume_mm3() * bricks.period[0] * bricks.period[1] * bricks.period[2]);
}

// Young's moduli with bricks of twice the size, and Richardson's extrapolation, for errors that go with the square of
// the size.
struct Extrapolated {
  std::array<double, 3> coarse{}, limit{}, error{};

  Extrapolated(const std::array<double, 3>& fine, const std::array<double, 3>& twice) : coarse(twice) {
    for (size_t n = 0; n < 3; ++n) {
      limit[n] = fine[n] + (fine[n] - twice[n]) / 3;
      error[n] = std::abs(fine[n] - twice[n]) / 3;
    }
  }
};

void tell_extrapolated(const Events& events, const Extrapolated& moduli, DataMembers& event) {
  events.say("  with bricks of twice the size " + text_of(moduli.coarse) + " MPa; extrapolated " +
             text_of(moduli.limit) + " MPa, within about " + text_of(moduli.error));
  event.emplace_back("coarse_modulus_mpa", list_of(moduli.coarse));
  event.emplace_back("extrapolated_modulus_mpa", list_of(moduli.limit));
  event.emplace_back("modulus_error_mpa", list_of(moduli.error));
}

void tell(const Events& events, const fea::Homogenised& found, const std::optional<fea::Homogenised>& coarse,
          double share, double seconds) {
  events.say(share_text(share, found.solid_share) + "; solved in " + format_count(found.iterations) +
             " iterations and " + format_rounded(seconds, 3) + " s");
  events.say("stiffness, MPa (xx, yy, zz, xy, yz, zx):");
  // Values below a millionth of the greatest come from rounding, and are shown as 0.
  const double greatest = std::max({found.stiffness_mpa[0][0], found.stiffness_mpa[1][1], found.stiffness_mpa[2][2]});
  for (const auto& row : found.stiffness_mpa) {
    std::string line;
    for (const double value : row) {
      const std::string text = format_rounded(std::abs(value) < 1e-6 * greatest ? 0 : value, 5);
      line += std::string(text.size() < 12 ? 12 - text.size() : 1, ' ') + text;
    }
    events.say(line);
  }
  const auto constants = fea::constants_of(found.stiffness_mpa);
  DataMembers event{{"stiffness_mpa", rows_of(found.stiffness_mpa)},
                    {"voigt_mpa", rows_of(found.voigt_mpa)},
                    {"reuss_mpa", rows_of(found.reuss_mpa)},
                    {"solid_share", share},
                    {"brick_share", found.solid_share},
                    {"iterations", static_cast<double>(found.iterations)},
                    {"seconds", seconds}};
  if (!constants) {
    events.say("it holds no load in some direction: what is solid does not hang together there");
  } else {
    events.say("Young's modulus along x, y, z: " + text_of(constants->modulus_mpa) + " MPa");
    if (const auto twice = coarse ? fea::constants_of(coarse->stiffness_mpa) : std::nullopt)
      tell_extrapolated(events, {constants->modulus_mpa, twice->modulus_mpa}, event);
    events.say("shear modulus xy, yz, zx: " + text_of(constants->shear_modulus_mpa) + " MPa");
    events.say("Poisson's ratio xy, yz, zx: " + text_of(constants->poissons_ratio));
    events.say("bulk modulus " + format_rounded(constants->bulk_modulus_mpa, 4) + " MPa; universal anisotropy " +
               format_rounded(constants->universal_anisotropy, 3) + " (0: isotropic)");
    event.emplace_back("modulus_mpa", list_of(constants->modulus_mpa));
    event.emplace_back("shear_modulus_mpa", list_of(constants->shear_modulus_mpa));
    event.emplace_back("poissons_ratio", list_of(constants->poissons_ratio));
    event.emplace_back("bulk_modulus_mpa", constants->bulk_modulus_mpa);
    event.emplace_back("mean_shear_modulus_mpa", constants->mean_shear_modulus_mpa);
    event.emplace_back("universal_anisotropy", constants->universal_anisotropy);
  }
  events.event("homogenised", std::move(event));
}

void tell(const Events& events, const fea::HomogenisedConductivity& found, const fea::PhysicsWords& words, double share,
          double seconds) {
  events.say(share_text(share, found.solid_share) + "; solved in " + format_count(found.iterations) +
             " iterations and " + format_rounded(seconds, 3) + " s");
  events.say("conductivity, " + words.conductivity.unit + " (x, y, z):");
  DataList rows;
  for (const auto& row : found.conductivity) {
    std::string line;
    for (const double value : row) {
      const std::string text = format_rounded(std::abs(value) < 1e-6 * found.arithmetic_mean ? 0 : value, 5);
      line += std::string(text.size() < 12 ? 12 - text.size() : 1, ' ') + text;
    }
    events.say(line);
    rows.emplace_back(list_of(row));
  }
  events.say("between " + format_rounded(found.harmonic_mean, 5) + " and " + format_rounded(found.arithmetic_mean, 5) +
             ", as all that has these shares");
  events.event("homogenised", {{words.conductivity.member, rows},
                               {"arithmetic_mean", found.arithmetic_mean},
                               {"harmonic_mean", found.harmonic_mean},
                               {"solid_share", share},
                               {"brick_share", found.solid_share},
                               {"iterations", static_cast<double>(found.iterations)},
                               {"seconds", seconds}});
}

// The variable that is changed to get a share of solid, and its bounds.
struct Variable {
  std::string name;
  double low = 0, high = 0;
};

// Reads NAME=LOW:HIGH.
Variable variable_of(const HomogeniseChoices& a) {
  const std::vector<std::string> sides = split(a.by, '='), bounds = split(sides.back(), ':');
  const auto low = parse_number(bounds.front()), high = parse_number(bounds.back());
  if (sides.size() != 2 || bounds.size() != 2 || !low || !high || !(*low < *high))
    throw WrongArgument(spelled::option("--density") + " needs a variable of the design and its bounds: write " +
                        spelled::option("--by", "thickness=0.2:2"));
  return {std::string(trim(sides.front())), *low, *high};
}

void check_output(const HomogeniseChoices& a) {
  if (a.density > 0) variable_of(a);
  if (a.density == 0 && !a.by.empty())
    throw WrongArgument(spelled::option("--by") + " is of a density: add " + spelled::option("--density", "0.25"));
  if (a.output.empty()) return;
  if (!to_lower(a.output).ends_with(".svg"))
    throw WrongArgument(spelled::option("-o", a.output) + " does not say a format; let it end in .svg");
  refuse_to_overwrite(a.output, a.force);
}

// Reports the size. Throws Error if solving takes more memory than is allowed.
void tell_size(const HomogeniseChoices& a, const Events& events, const fea::Bricks& bricks, double bytes) {
  events.say(std::to_string(bricks.period[0]) + " x " + std::to_string(bricks.period[1]) + " x " +
             std::to_string(bricks.period[2]) + " bricks of " + format_rounded(bricks.size_mm.x, 4) + " x " +
             format_rounded(bricks.size_mm.y, 4) + " x " + format_rounded(bricks.size_mm.z, 4) +
             " mm; solving takes about " + format_bytes(bytes));
  refuse_little_memory(bytes, a.work.memory_bytes, "choose larger bricks with " + spelled::option("--cell"));
}

// A model, and the physics of its study.
struct HomogenisePlan {
  fea::Model model;
  std::optional<fea::Model> coarse;  // model of bricks of twice the size, if that is the same design
  fea::Physics physics = fea::Physics::mechanics;

  bool is_mechanics() const { return physics == fea::Physics::mechanics; }
  double solve_bytes() const {
    return is_mechanics() ? fea::solve_bytes(model.bricks) : fea::conduct_bytes(model.bricks);
  }
};

void solve_stiffness(const HomogeniseChoices& a, const HomogenisePlan& plan, const fea::SolveOptions& options,
                     Session& session, DataList& files) {
  const fea::Model& model = plan.model;
  const Stopwatch watch;
  JobProgress progress(session.events, Counted::steps);
  const fea::Homogenised found = fea::homogenise(model, options, &progress, &session.stop);
  std::optional<fea::Homogenised> coarse;
  if (plan.coarse) coarse = fea::homogenise(*plan.coarse, options, nullptr, &session.stop);
  progress.finish();
  tell(session.events, found, coarse, design_share(model), watch.seconds());
  if (a.output.empty()) return;
  exporting::write_file(a.output, fea::stiffness_chart(found.stiffness_mpa, a.design.design));
  session.events.say(a.output + " written");
  files.emplace_back(a.output);
}

void solve_conductivity(const fea::Model& model, const fea::SolveOptions& options, const fea::PhysicsWords& words,
                        Session& session) {
  const Stopwatch watch;
  JobProgress progress(session.events, Counted::steps);
  const fea::HomogenisedConductivity found = fea::homogenise_conductivity(model, options, &progress, &session.stop);
  progress.finish();
  tell(session.events, found, words, design_share(model), watch.seconds());
}

// Finds how much of the box is solid for a value of the variable; a cell without bricks is empty.
class Shares {
 public:
  Shares(const HomogeniseChoices& a, Variable variable, const fea::Study& study, Session& session,
         Diagnostics& diagnostics)
      : a_(a), variable_(std::move(variable)), study_(study), session_(session), diagnostics_(diagnostics) {}

  HomogeniseChoices with(double value) const {
    HomogeniseChoices with = a_;
    with.design.needed = {variable_.name};
    with.design.definitions.push_back(variable_.name + "=" + format_number(value));
    return with;
  }

  std::optional<double> at(double value) {
    Diagnostics found;
    const auto model = make_model(with(value), study_, session_, found);
    if (model) return design_share(*model);
    for (const Diagnostic& diagnostic : found.list())
      if (diagnostic.code == Code::nothing_inside) return 0;
    diagnostics_.add_all(found);
    return std::nullopt;
  }

 private:
  const HomogeniseChoices& a_;
  Variable variable_;
  const fea::Study& study_;
  Session& session_;
  Diagnostics& diagnostics_;
};

// Finds the variable's value for a density by bisection, since the share of samples jumps and slopes would mislead.
std::optional<HomogeniseChoices> with_density(const HomogeniseChoices& a, const fea::Study& study, Session& session,
                                              Diagnostics& diagnostics) {
  constexpr int most_halves = 30;
  constexpr double close = 1e-3;
  const Variable variable = variable_of(a);
  Shares shares(a, variable, study, session, diagnostics);
  double low = variable.low, high = variable.high;
  const auto at_low = shares.at(low), at_high = at_low ? shares.at(high) : std::nullopt;
  if (!at_high) return std::nullopt;
  if ((*at_low - a.density) * (*at_high - a.density) > 0) {
    diagnostics.error(Code::option, {make_source(a.design.design, ""), 0, 0},
                      percent(*at_low) + " of the box is solid with " + variable.name + " = " + format_number(low) +
                          ", " + percent(*at_high) + " with " + format_number(high) + ": never " + percent(a.density),
                      "choose other bounds in " + spelled::option("--by"));
    return std::nullopt;
  }
  double value = low, share = *at_low;
  for (int n = 0; n < most_halves && std::abs(share - a.density) > close * a.density; ++n) {
    value = 0.5 * (low + high);
    const auto here = shares.at(value);
    if (!here) return std::nullopt;
    share = *here;
    ((share < a.density) == (*at_low < a.density) ? low : high) = value;
  }
  session.events.say(variable.name + " = " + format_rounded(value, 6) + ": " + percent(share) + " of the box is solid");
  session.events.event("density", {{"variable", variable.name}, {"value", value}, {"solid_share", share}});
  return shares.with(value);
}

std::optional<HomogenisePlan> plan_job(const HomogeniseChoices& a, Session& session, Diagnostics& diagnostics) {
  const auto study = study_of(a, diagnostics);
  if (!study) return std::nullopt;
  if (study->physics != fea::Physics::mechanics && !a.output.empty())
    throw WrongArgument("-o is a chart of stiffness: conductivities have none");
  std::optional<HomogeniseChoices> chosen = a;
  if (a.density > 0) chosen = with_density(a, *study, session, diagnostics);
  if (!chosen) return std::nullopt;
  auto model = make_model(*chosen, *study, session, diagnostics);
  if (!model) return std::nullopt;
  HomogenisePlan plan{std::move(*model), std::nullopt, study->physics};
  // Another draw of a mixture would be another design.
  const bool is_drawn = a.sections.assign == compile::FeaRequest::Assign::draw && plan.model.sections.size() > 1;
  if (!plan.is_mechanics() || is_drawn) return plan;
  chosen->cell_mm *= 2;
  Diagnostics ignored;  // a cell of few bricks has no coarser ones
  plan.coarse = make_model(*chosen, *study, session, ignored);
  if (plan.coarse && plan.coarse->bricks.period[0] * 2 != plan.model.bricks.period[0]) plan.coarse.reset();
  return plan;
}

void check_size(const HomogeniseChoices& a, const HomogenisePlan& plan, const Events& events) {
  tell_size(a, events, plan.model.bricks, plan.solve_bytes());
}

int solve(const HomogeniseChoices& a, const HomogenisePlan& plan, Session& session) {
  fea::SolveOptions options;
  options.tolerance = a.tolerance;
  options.threads = a.work.threads;
  options.solver = "auto";
  options.memory_bytes = static_cast<double>(a.work.memory_bytes) - plan.solve_bytes();
  DataList files;
  if (plan.is_mechanics())
    solve_stiffness(a, plan, options, session, files);
  else
    solve_conductivity(plan.model, options, fea::words_of(plan.physics), session);
  session.events.event("done", {{"files", files}});
  return done;
}

int run_homogenise(const HomogeniseChoices& a, Session& session) {
  JobSteps<HomogenisePlan> steps;
  steps.refuse = [&] { check_output(a); };
  steps.plan = [&](Diagnostics& diagnostics) { return plan_job(a, session, diagnostics); };
  steps.check = [&](const HomogenisePlan& plan) { check_size(a, plan, session.events); };
  steps.run = [&](const HomogenisePlan& plan) { return solve(a, plan, session); };
  return take_steps(steps, session);
}

}  // namespace

std::optional<bool> gives_stiffness(const HomogeniseChoices& a, Session& session, Diagnostics& diagnostics) {
  const auto study = study_of(a, diagnostics);
  auto model = study ? make_model(a, *study, session, diagnostics) : std::nullopt;
  if (!model) return std::nullopt;
  const HomogenisePlan plan{std::move(*model), std::nullopt, study->physics};
  check_size(a, plan, session.events);
  return plan.is_mechanics();
}

JobKind homogenise_kind() {
  return job_kind<HomogeniseChoices>("homogenise", "Say how stiff a cell of a design is as a material",
                                     homogenise_footer, run_homogenise);
}

}  // namespace ombre::jobs
