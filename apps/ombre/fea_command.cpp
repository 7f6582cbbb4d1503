// ombre fea: a design as a finite-element model, and what it does under load.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/json.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "compile/fea_selection.h"
#include "compile/fea_xdmf.h"
#include "compile/find_printer.h"
#include "export/output_file.h"
#include "fea/calculix.h"
#include "fea/inp_writer.h"
#include "fea/mesh_elastic.h"
#include "fea/vtu_writer.h"
#include "formats/file.h"
#include "ombre/checks.h"
#include "ombre/commands.h"
#include "ombre/fea_repeat.h"
#include "ombre/fea_report.h"
#include "ombre/fea_rounds.h"
#include "ombre/progress_line.h"

namespace ombre::cli {
namespace {

fea::BrickType type_of(const std::string& name) {
  if (name == "C3D8I") return fea::BrickType::c3d8i;
  return name == "C3D8R" ? fea::BrickType::c3d8r : fea::BrickType::c3d8;
}

std::optional<fea::Study> read_study(const std::string& path, Diagnostics& diagnostics) {
  const auto data = parse_json(make_source(path, formats::read_file(path)), diagnostics);
  return data ? fea::read_study(*data, diagnostics) : std::nullopt;
}

// The grid has its name last, so what has it is whole.
void write_xdmf(const std::string& path, const Case& here, const compile::FeaResults& results) {
  const fea::ModelView model = here.view();
  const std::string beside = numbers_path(path);
  const compile::XdmfFiles files = compile::fea_xdmf(
      model.mesh, compile::fea_element_fields(model, here.conditions.physics, results),
      compile::fea_node_fields(here.conditions.physics, results), std::filesystem::path(beside).filename().string());
  exporting::write_file(beside, files.numbers);
  exporting::write_file(path, files.xdmf);
}

void write_output(const FeaArguments& a, const std::string& path, const Case& here,
                  const compile::FeaResults& results) {
  if (ending_of(path) == ".xdmf") return write_xdmf(path, here, results);
  exporting::NewFile file(path);
  const fea::Sink sink = [&](std::string_view bytes) { file.append(bytes); };
  const fea::ModelView model = here.view();
  const fea::Physics physics = here.conditions.physics;
  if (ending_of(path) == ".inp")
    fea::write_inp(model, here.conditions, type_of(a.element),
                   std::filesystem::path(a.design.design).filename().string(), sink);
  else
    fea::write_vtu(model.mesh, compile::fea_element_fields(model, physics, results),
                   compile::fea_node_fields(physics, results), sink);
  file.close();
  file.commit();
}

std::optional<compile::PlanOptions> plan_options_of(const FeaArguments& a, Diagnostics& diagnostics) {
  compile::SamplingOptions sampling;
  if (!a.cell.empty()) sampling.voxel = parse_voxel(a.cell, "--cell");
  sampling.rules.seed = options::parse_seed(a.seed);
  return plan_options(sampling, diagnostics);
}

std::optional<compile::Plan> plan_bricks(const FeaArguments& a, const compile::LoadedPtr& loaded, Session& session,
                                         Diagnostics& diagnostics) {
  auto options = plan_options_of(a, diagnostics);
  if (!options) return std::nullopt;
  options->threads = a.threads;
  options->stop = &session.stop;
  return compile::plan_slice(loaded, *options, diagnostics);
}

compile::FeaRequest request_of(const FeaArguments& a) {
  compile::FeaRequest request;
  if (a.assign == "mix") request.assign = compile::FeaRequest::Assign::mix;
  if (!a.modulus.empty()) request.modulus = a.modulus;
  if (!a.conductivity.empty()) request.conductivity = a.conductivity;
  request.most_sections = static_cast<size_t>(a.sections);
  request.threads = a.threads;
  return request;
}

compile::SizeRequest size_of(const FeaArguments& a) {
  if (a.size_by.empty()) return {a.size, a.size, ""};
  return {a.min_cell, a.max_cell, a.size_by};
}

// The model of a study of this design; with a period it repeats.
class ModelMaker {
 public:
  ModelMaker(const FeaArguments& a, const compile::LoadedPtr& loaded, const fea::Study& study,
             const std::optional<Box>& period, Session& session, Diagnostics& diagnostics)
      : a_(a), loaded_(loaded), study_(study), period_(period), session_(session), diagnostics_(diagnostics) {}

  std::optional<fea::Model> bricks() {
    FeaArguments own = a_;
    compile::LoadedPtr sampled = loaded_;
    if (period_) {
      sampled = with_repeating_bricks(a_, loaded_, *period_, diagnostics_);
      own.cell.clear();  // the bricks of the period are the design's own
    }
    if (!sampled) return std::nullopt;
    const auto plan = plan_bricks(own, sampled, session_, diagnostics_);
    if (!plan) return std::nullopt;
    ProgressLine progress(session_.console, Counted::voxels);
    return compile::fea_model(sampled, *plan, study_, request_of(a_), diagnostics_, &progress, &session_.stop);
  }

  std::optional<compile::TetraModel> tetrahedra() {
    const auto options = plan_options_of(a_, diagnostics_);
    if (!options) return std::nullopt;
    compile::TetraRequest request;
    request.size = size_of(a_);
    request.quadratic = a_.elements == "tet10";
    request.by_material = !a_.subdomains.empty();
    request.sections = request_of(a_);
    request.seed = options->seed;
    request.period = period_;
    request.memory_bytes = parse_memory(a_.memory);
    request.announce = [&](const compile::TetraPlan& plan) {
      session_.console.say("about " + format_rounded(plan.elements, 2) + " tetrahedra; meshing takes about " +
                           format_bytes(plan.memory_bytes));
    };
    ProgressLine progress(session_.console, Counted::steps);
    return compile::tetra_model(loaded_, study_, request, diagnostics_, &progress, &session_.stop);
  }

 private:
  const FeaArguments& a_;
  const compile::LoadedPtr& loaded_;
  const fea::Study& study_;
  const std::optional<Box>& period_;
  Session& session_;
  Diagnostics& diagnostics_;
};

// Nothing where the maker found nothing.
template <class Model>
std::optional<Case> case_of(std::optional<Model> model) {
  if (!model) return std::nullopt;
  return Case{std::move(*model), {}};
}

// Elements that are too stiff for their material, and meshes that miss some of the part.
void warn_of_mesh(const Case& here, const fea::Study& study, Diagnostics& diagnostics) {
  const fea::ModelView model = here.view();
  const bool locks = std::ranges::any_of(model.sections, [](const fea::Section& section) {
    return section.elastic.poissons_ratio > fea::most_poissons_ratio_of_c3d4;
  });
  if (here.is_mechanics() && model.mesh.kind() == fea::ElementKind::c3d4 && locks)
    diagnostics.warning(study.where,
                        "tet4 is far too stiff where poissons_ratio is above " +
                            format_number(fea::most_poissons_ratio_of_c3d4) + ", since its change of volume locks",
                        "use --elements tet10 or brick");
  if (!here.tetrahedra() || study.mean_strain) return;
  constexpr double most_off = 0.05;
  const double volume = model.mesh.total_volume_mm3(), wanted = here.tetrahedra()->surface_mm3;
  if (std::abs(volume - wanted) > most_off * wanted)
    diagnostics.warning(study.where,
                        "the tetrahedra fill " + format_rounded(volume, 4) + " mm3, the design's surface " +
                            "encloses " + format_rounded(wanted, 4) + " mm3",
                        "choose a smaller --size");
}

std::optional<Case> make_case(const FeaArguments& a, Session& session, Diagnostics& diagnostics) {
  const auto study = read_study(a.study, diagnostics);
  if (!study) return std::nullopt;
  if (study->mean_strain) check_repeats(a);
  const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.threads);
  if (!loaded) return std::nullopt;
  std::optional<Box> period;
  if (study->mean_strain) {
    period = period_of(*loaded, diagnostics);
    if (!period) return std::nullopt;
  }
  ModelMaker maker(a, loaded, *study, period, session, diagnostics);
  auto here = a.elements == "brick" ? case_of(maker.bricks()) : case_of(maker.tetrahedra());
  if (!here) return std::nullopt;
  warn_of_mesh(*here, *study, diagnostics);
  const fea::ModelView view = here->view();
  if (period) {
    here->conditions = repeating_conditions(view, *period, *study->mean_strain);
    return here;
  }
  const auto choose = compile::node_chooser(*loaded, view.mesh, a.threads, &session.stop);
  auto conditions = fea::conditions_of(*study, view, diagnostics, choose);
  if (!conditions) return std::nullopt;
  here->conditions = std::move(*conditions);
  return here;
}

compile::FeaResults solve_elsewhere(const FeaArguments& a, const Case& here, Session& session) {
  const fea::CalculixOptions options{type_of(a.element), a.threads};
  compile::FeaResults results;
  if (here.is_mechanics())
    results.solution = fea::solve_by_calculix(here.view(), here.conditions, options, &session.stop);
  else
    results.conduction = fea::conduct_by_calculix(here.view(), here.conditions, options, &session.stop);
  return results;
}

fea::Solver solver_of(const FeaArguments& a) {
  if (a.solver == "direct") return fea::Solver::direct;
  return a.solver == "multigrid" ? fea::Solver::multigrid : fea::Solver::automatic;
}

compile::FeaResults solve_case(const FeaArguments& a, const Case& here, Session& session) {
  const Stopwatch watch;
  fea::SolveOptions options;
  options.tolerance = a.tolerance;
  options.threads = a.threads;
  options.solver = solver_of(a);
  options.memory_bytes = static_cast<double>(parse_memory(a.memory)) - here.solve_bytes();
  options.announce = [&](const fea::DirectUse& use) { tell_factorisation(session.console, use); };
  ProgressLine progress(session.console, Counted::steps);
  const fea::ModelView model = here.view();
  compile::FeaResults results;
  if (a.solver == "calculix")
    results = solve_elsewhere(a, here, session);
  else if (!here.is_mechanics())
    results.conduction = fea::conduct(model, here.conditions, options, &progress, &session.stop);
  else if (const auto* bricks = std::get_if<fea::Model>(&here.made))
    results.solution = fea::solve(*bricks, here.conditions, options, &progress, &session.stop);
  else
    results.solution = fea::solve_mesh(model, here.conditions, options, &progress, &session.stop);
  progress.finish();
  tell_results(a, session.console, here, results, watch.seconds());
  if (results.solution) tell_mean_stress(session.console, here, *results.solution);
  return results;
}

void check_memory(const FeaArguments& a, const Case& here) {
  const auto allowed = static_cast<double>(parse_memory(a.memory));
  if (const double bytes = here.solve_bytes(); a.solve && a.solver != "calculix" && bytes > allowed)
    throw Error(Code::memory, "solving takes about " + format_bytes(bytes) + " of memory, more than the " +
                                  format_bytes(allowed) + " allowed; choose larger elements with " +
                                  (here.tetrahedra() ? spelled::option("--size") : spelled::option("--cell")) +
                                  ", or more " + spelled::option("--memory"));
}

// The model of the design, said and found to fit; nothing, and diagnostics said, where something is wrong.
std::optional<Case> next_case(const FeaArguments& a, Session& session) {
  Diagnostics diagnostics;
  auto made = make_case(a, session, diagnostics);
  session.console.diagnose(diagnostics);
  if (!made || diagnostics.has_errors()) return std::nullopt;
  tell_model(session.console, *made);
  check_memory(a, *made);
  return made;
}

void write_outputs(const FeaArguments& a, Session& session, const Case& here, const compile::FeaResults& results,
                   int round, DataList& files) {
  for (const std::string& path : a.outputs) {
    if (ending_of(path) == ".csv") continue;
    const std::string name = round == 0 ? path : path_of_round(path, round);
    write_output(a, name, here, results);
    session.console.say(name + " written");
    files.emplace_back(name);
  }
}

// -D for the next round: the file with the results of this one.
std::string definition_of(const FeaArguments& a, int round) {
  const auto grid = std::ranges::find_if(a.outputs, [](const std::string& path) { return ending_of(path) == ".vtu"; });
  return a.follow + "=" + std::filesystem::absolute(path_of_round(*grid, round)).string();
}

void write_history(const FeaArguments& a, const RoundHistory& history) {
  for (const std::string& path : a.outputs)
    if (ending_of(path) == ".csv") exporting::write_file(path, history.text());
}

void tell_change(const Console& console, int round, std::optional<double> change) {
  if (round == 1) return;
  console.say("round " + std::to_string(round) + ": " +
              (change ? "the mixture changed by at most " + format_rounded(*change, 3) : "other elements"));
}

int run_rounds(FeaArguments a, Session& session) {
  const Stopwatch watch;
  const std::vector<std::string> definitions = a.design.definitions;
  a.design.needed = {a.follow};
  RoundHistory history;
  RoundModel before;
  DataList files;
  for (int round = 1; round <= a.rounds; ++round) {
    const auto made = next_case(a, session);
    if (!made) return wrong_input;
    RoundModel now = round_model_of(made->view());
    const auto change = round == 1 ? std::nullopt : change_between(before, now);
    tell_change(session.console, round, change);
    if (change && *change <= a.change) {
      session.console.say("nothing changes any more after " + counted(static_cast<size_t>(round - 1), "round"));
      break;
    }
    const compile::FeaResults results = solve_case(a, *made, session);
    write_outputs(a, session, *made, results, round, files);
    history.add(round, now, change, made->conditions.physics, results);
    write_history(a, history);
    before = std::move(now);
    a.design.definitions = definitions;
    a.design.definitions.push_back(definition_of(a, round));
  }
  for (const std::string& path : a.outputs)
    if (ending_of(path) == ".csv") files.emplace_back(path);
  session.console.say("the design that follows: -D " + a.design.definitions.back());
  session.console.event("done", {{"files", files}, {"seconds", watch.seconds()}});
  return done;
}

int run_fea(FeaArguments a, Session& session) {
  a.solve = a.solve || a.rounds > 0;
  check(a);
  if (a.rounds > 0) return run_rounds(a, session);
  const Stopwatch watch;
  const auto made = next_case(a, session);
  if (!made) return wrong_input;
  compile::FeaResults results;
  if (a.solve) results = solve_case(a, *made, session);
  DataList files;
  write_outputs(a, session, *made, results, 0, files);
  session.console.event("done", {{"files", files}, {"seconds", watch.seconds()}});
  return done;
}

}  // namespace

Command add_fea(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("fea", "Write a finite-element model, or solve it under loads");
  auto arguments = std::make_shared<FeaArguments>();
  add_arguments(*app, *arguments);
  add_output_options(*app, output);
  return {app, [arguments](Session& session) { return run_fea(*arguments, session); }};
}

}  // namespace ombre::cli