// ombre homogenise: how stiff a cell of a design is as a material, or how well it conducts.
#include <memory>

#include "base/error.h"
#include "base/json.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "compile/homogenise_choices.h"
#include "compile/homogenise_job.h"
#include "export/output_file.h"
#include "fea/conduction.h"
#include "fea/homogenise.h"
#include "fea/homogenise_conductivity.h"
#include "formats/file.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"
#include "ombre/job_arguments.h"
#include "ombre/job_steps.h"
#include "ombre/options.h"
#include "ombre/overwrite.h"
#include "ombre/progress_line.h"
#include "ombre/solve_memory.h"

namespace ombre::cli {
namespace {

using compile::HomogeniseChoices;

constexpr const char* homogenise_footer =
    "The box is cut into bricks and repeated in all directions. Six strains, one after the other, give the stiffness "
    "of the\n"
    "even material that it is equal to: stresses over strains as xx, yy, zz, xy, yz, zx, in MPa. Void holds "
    "nothing.\n\n"
    "Properties of materials come from the study (\"materials\") or the materials file:\n"
    "  {\"materials\": {\"red\": {\"modulus_mpa\": 2850, \"poissons_ratio\": 0.39}}}\n\n"
    "With \"physics\": \"heat\" or \"electric\" and \"conductivity_w_mk\" or \"conductivity_s_m\" of materials "
    "it is the\n"
    "conductivity, from three gradients.\n\n"
    "Examples:\n"
    "  ombre homogenise cell.vcad --cell 0.25 -o cell.svg\n"
    "  ombre homogenise part.vcad --box 0,0,0,2,2,2 --cell 0.05 --assign draw --seed 3   # what dithering prints "
    "there\n";

std::optional<fea::Study> study_of(const HomogeniseChoices& a, Diagnostics& diagnostics) {
  if (a.study.empty()) return fea::Study{};
  const auto data = parse_json(make_source(a.study, formats::read_file(a.study)), diagnostics);
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
  const auto plan = compile::plan_model(sampled, *options, a.fill, diagnostics);
  if (!plan) return std::nullopt;
  compile::FeaRequest request;
  request.assign = a.assign;
  request.fill = a.fill;
  request.threads = a.work.threads;
  ProgressLine progress(session.console);
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

void tell(const Console& console, const fea::Homogenised& found, double seconds) {
  console.say(percent(found.solid_share) + " of the box is solid; solved in " + format_count(found.iterations) +
              " iterations and " + format_rounded(seconds, 3) + " s");
  console.say("stiffness, MPa (xx, yy, zz, xy, yz, zx):");
  // Values below a millionth of the greatest come from rounding, and are shown as 0.
  const double greatest = std::max({found.stiffness_mpa[0][0], found.stiffness_mpa[1][1], found.stiffness_mpa[2][2]});
  for (const auto& row : found.stiffness_mpa) {
    std::string line;
    for (const double value : row) {
      const std::string text = format_rounded(std::abs(value) < 1e-6 * greatest ? 0 : value, 5);
      line += std::string(text.size() < 12 ? 12 - text.size() : 1, ' ') + text;
    }
    console.say(line);
  }
  const auto constants = fea::constants_of(found.stiffness_mpa);
  DataMembers event{{"stiffness_mpa", rows_of(found.stiffness_mpa)},
                    {"voigt_mpa", rows_of(found.voigt_mpa)},
                    {"reuss_mpa", rows_of(found.reuss_mpa)},
                    {"solid_share", found.solid_share},
                    {"iterations", static_cast<double>(found.iterations)},
                    {"seconds", seconds}};
  if (!constants) {
    console.say("it holds no load in some direction: what is solid does not hang together there");
  } else {
    console.say("Young's modulus along x, y, z: " + text_of(constants->modulus_mpa) + " MPa");
    console.say("shear modulus xy, yz, zx: " + text_of(constants->shear_modulus_mpa) + " MPa");
    console.say("Poisson's ratio xy, yz, zx: " + text_of(constants->poissons_ratio));
    console.say("bulk modulus " + format_rounded(constants->bulk_modulus_mpa, 4) + " MPa; universal anisotropy " +
                format_rounded(constants->universal_anisotropy, 3) + " (0: isotropic)");
    event.emplace_back("modulus_mpa", list_of(constants->modulus_mpa));
    event.emplace_back("shear_modulus_mpa", list_of(constants->shear_modulus_mpa));
    event.emplace_back("poissons_ratio", list_of(constants->poissons_ratio));
    event.emplace_back("bulk_modulus_mpa", constants->bulk_modulus_mpa);
    event.emplace_back("mean_shear_modulus_mpa", constants->mean_shear_modulus_mpa);
    event.emplace_back("universal_anisotropy", constants->universal_anisotropy);
  }
  console.event("homogenised", std::move(event));
}

void tell(const Console& console, const fea::HomogenisedConductivity& found, bool is_heat, double seconds) {
  console.say(percent(found.solid_share) + " of the box is solid; solved in " + format_count(found.iterations) +
              " iterations and " + format_rounded(seconds, 3) + " s");
  console.say(std::string("conductivity, ") + (is_heat ? "W/(m K)" : "S/m") + " (x, y, z):");
  DataList rows;
  for (const auto& row : found.conductivity) {
    std::string line;
    for (const double value : row) {
      const std::string text = format_rounded(std::abs(value) < 1e-6 * found.arithmetic_mean ? 0 : value, 5);
      line += std::string(text.size() < 12 ? 12 - text.size() : 1, ' ') + text;
    }
    console.say(line);
    rows.emplace_back(list_of(row));
  }
  console.say("between " + format_rounded(found.harmonic_mean, 5) + " and " + format_rounded(found.arithmetic_mean, 5) +
              ", as all that has these shares");
  console.event("homogenised", {{is_heat ? "conductivity_w_mk" : "conductivity_s_m", rows},
                                {"arithmetic_mean", found.arithmetic_mean},
                                {"harmonic_mean", found.harmonic_mean},
                                {"solid_share", found.solid_share},
                                {"iterations", static_cast<double>(found.iterations)},
                                {"seconds", seconds}});
}

void check_output(const HomogeniseChoices& a) {
  if (a.output.empty()) return;
  if (!to_lower(a.output).ends_with(".svg"))
    throw WrongArgument(spelled::option("-o", a.output) + " does not say a format; let it end in .svg");
  refuse_to_overwrite(a.output, a.force);
}

// Throws Error where it takes more than is allowed.
void tell_size(const HomogeniseChoices& a, const Console& console, const fea::Bricks& bricks, double bytes) {
  console.say(std::to_string(bricks.period[0]) + " x " + std::to_string(bricks.period[1]) + " x " +
              std::to_string(bricks.period[2]) + " bricks of " + format_rounded(bricks.size_mm.x, 4) + " x " +
              format_rounded(bricks.size_mm.y, 4) + " x " + format_rounded(bricks.size_mm.z, 4) +
              " mm; solving takes about " + format_bytes(bytes));
  refuse_little_memory(bytes, a.work.memory_bytes, "choose larger bricks with " + spelled::option("--cell"));
}

void solve_stiffness(const HomogeniseChoices& a, const fea::Model& model, const fea::SolveOptions& options,
                     Session& session, DataList& files) {
  const Stopwatch watch;
  ProgressLine progress(session.console, Counted::steps);
  const fea::Homogenised found = fea::homogenise(model, options, &progress, &session.stop);
  progress.finish();
  tell(session.console, found, watch.seconds());
  if (a.output.empty()) return;
  exporting::write_file(a.output, fea::stiffness_chart(found.stiffness_mpa, a.design.design));
  session.console.say(a.output + " written");
  files.emplace_back(a.output);
}

void solve_conductivity(const fea::Model& model, const fea::SolveOptions& options, bool is_heat, Session& session) {
  const Stopwatch watch;
  ProgressLine progress(session.console, Counted::steps);
  const fea::HomogenisedConductivity found = fea::homogenise_conductivity(model, options, &progress, &session.stop);
  progress.finish();
  tell(session.console, found, is_heat, watch.seconds());
}

// A model, and the physics of its study.
struct HomogenisePlan {
  fea::Model model;
  fea::Physics physics = fea::Physics::mechanics;

  bool is_mechanics() const { return physics == fea::Physics::mechanics; }
  double solve_bytes() const {
    return is_mechanics() ? fea::solve_bytes(model.bricks) : fea::conduct_bytes(model.bricks);
  }
};

std::optional<HomogenisePlan> plan_job(const HomogeniseChoices& a, Session& session, Diagnostics& diagnostics) {
  const auto study = study_of(a, diagnostics);
  if (!study) return std::nullopt;
  if (study->physics != fea::Physics::mechanics && !a.output.empty())
    throw WrongArgument("-o is a chart of stiffness: conductivities have none");
  auto model = make_model(a, *study, session, diagnostics);
  return model ? std::optional(HomogenisePlan{std::move(*model), study->physics}) : std::nullopt;
}

int solve(const HomogeniseChoices& a, const HomogenisePlan& plan, Session& session) {
  fea::SolveOptions options;
  options.tolerance = a.tolerance;
  options.threads = a.work.threads;
  options.solver = fea::Solver::automatic;
  options.memory_bytes = static_cast<double>(a.work.memory_bytes) - plan.solve_bytes();
  DataList files;
  if (plan.is_mechanics())
    solve_stiffness(a, plan.model, options, session, files);
  else
    solve_conductivity(plan.model, options, plan.physics == fea::Physics::heat, session);
  session.console.event("done", {{"files", files}});
  return done;
}

int run_homogenise(const HomogeniseChoices& a, Session& session) {
  JobSteps<HomogenisePlan> steps;
  steps.refuse = [&] { check_output(a); };
  steps.plan = [&](Diagnostics& diagnostics) { return plan_job(a, session, diagnostics); };
  steps.check = [&](const HomogenisePlan& plan) {
    tell_size(a, session.console, plan.model.bricks, plan.solve_bytes());
  };
  steps.run = [&](const HomogenisePlan& plan) { return solve(a, plan, session); };
  return take_steps(steps, session);
}

}  // namespace

Command add_homogenise(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("homogenise", "Say how stiff a cell of a design is as a material");
  auto arguments = std::make_shared<HomogeniseChoices>();
  add_options(*app, *arguments);
  add_output_options(*app, output);
  app->footer(homogenise_footer);
  return {app, [arguments](Session& session) { return run_homogenise(*arguments, session); },
          HomogeniseChoices::options().options()};
}

}  // namespace ombre::cli
