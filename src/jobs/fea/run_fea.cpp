// `ombre fea` makes finite-element models of designs and solves them.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/system/stopwatch.h"
#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "fea/files/calculix.h"
#include "fea/files/inp_writer.h"
#include "fea/files/vtu_writer.h"
#include "fea/model/walls.h"
#include "fea/solve/mesh_elastic.h"
#include "formats/containers/file.h"
#include "jobs/common/events.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/session.h"
#include "jobs/common/solve_memory.h"
#include "jobs/common/study_source.h"
#include "jobs/fea/fea_files.h"
#include "jobs/fea/fea_repeat.h"
#include "jobs/fea/fea_report.h"
#include "jobs/fea/fea_rounds.h"
#include "jobs/fea/fea_selection.h"
#include "jobs/fea/fea_xdmf.h"

namespace ombre::jobs {
namespace {

using compile::FeaChoices;

constexpr const char* fea_footer =
    "Lengths are millimetres, forces newtons, stresses MPa; heat is in watts, temperatures are degrees Celsius.\n\n"
    "FILE ends in\n"
    "  .inp   a deck for Abaqus and CalculiX, complete with supports and loads\n"
    "  .vtu   a grid for ParaView and others with VTK: fractions, attributes, moduli; with --solve the results too\n"
    "  .xdmf  the same for ParaView and FEniCSx, its numbers in a file of HDF5 beside it, part.h5\n"
    "  .csv   with --rounds: a line for each round\n\n"
    "--rounds solves a design that reads its own results: the variable --follow gets the name of the .vtu file of the\n"
    "round before, until nothing changes. Files get the number of their round: part_1.vtu, part_2.vtu.\n\n"
    "STUDY is a JSON file with properties of materials, supports and loads.\n"
    "  {\"materials\": {\"red\": {\"modulus_mpa\": 2850, \"poissons_ratio\": 0.39, \"density_kg_m3\": 1180}},\n"
    "   \"supports\": [{\"on\": \"zmin\", \"fix\": \"xyz\"}],\n"
    "   \"loads\": [{\"on\": \"zmax\", \"force_n\": [0, 0, -10]}]}\n"
    "\"on\" is a side of the part (xmin to zmax), or braces with some of \"box\": [x0, y0, z0, x1, y1, z1], \"plane\": "
    "[x, y, z,\n"
    "nx, ny, nz], \"facing\": [0, 0, 1], \"material\": \"red\", \"part\": \"arm\" and \"where\": \"z > 9 && x < 2\". A "
    "support says\n"
    "\"fix\" or \"displacement_mm\": [null, null, -1]; a load \"force_n\" or \"pressure_mpa\"; \"gravity_mm_s2\" is a "
    "vector.\n"
    "With \"physics\": \"heat\" or \"electric\" materials have \"conductivity_w_mk\" or \"conductivity_s_m\", "
    "supports\n"
    "\"temperature_c\" or \"potential_v\", and loads \"heat_w\", \"flux_w_mm2\" or \"film_w_m2k\" with \"ambient_c\"; "
    "or\n"
    "\"current_a\" or \"current_a_mm2\". \"mean_strain\": [xx, yy, zz, xy, yz, zx] in place of supports and loads "
    "means a cell\n"
    "that repeats, whose deck ties copies of nodes.\n\n"
    "Examples:\n"
    "  ombre fea part.vcad --study pull.json --cell 1 -o part.inp\n"
    "  ombre fea part.vcad --study pull.json --cell 0.5 --solve -o part.vtu\n"
    "  ombre fea part.vcad --study pull.json --elements tet10 --size 1.5 --solve -o part.vtu\n"
    "  ombre fea part.vcad --study pull.json --elements tet4 --size-by \"min_cell + h*(max_cell - min_cell)\" \\\n"
    "            --min-cell 0.5 --max-cell 3 -o part.inp\n"
    "  ombre fea seat.vcad --study rider.json --cell 4 --rounds 5 --follow moved -o seat.vtu -o seat.csv\n";

std::optional<fea::Study> read_study(const std::string& path, Diagnostics& diagnostics) {
  const auto data = parse_json(study_source(path), diagnostics);
  return data ? fea::read_study(*data, diagnostics) : std::nullopt;
}

// The text that names the grid is written last, so if it exists the other file is whole.
void write_xdmf(const std::string& path, const Case& here, const compile::FeaResults& results) {
  const fea::ModelView model = here.view();
  const std::string beside = numbers_path(path);
  const compile::XdmfFiles files = compile::fea_xdmf(
      model.mesh, compile::fea_element_fields(model, here.conditions.physics, results),
      compile::fea_node_fields(here.conditions.physics, results), std::filesystem::path(beside).filename().string());
  exporting::write_file(beside, files.numbers);
  exporting::write_file(path, files.xdmf);
}

void write_output(const FeaChoices& a, const std::string& path, const Case& here, const compile::FeaResults& results) {
  if (ending_of(path) == ".xdmf") return write_xdmf(path, here, results);
  exporting::NewFile file(path);
  const fea::Sink sink = [&](std::string_view bytes) { file.append(bytes); };
  const fea::ModelView model = here.view();
  const fea::Physics physics = here.conditions.physics;
  if (ending_of(path) == ".inp")
    fea::write_inp(model, here.conditions, a.brick, std::filesystem::path(a.design.design).filename().string(), sink);
  else
    fea::write_vtu(model.mesh, compile::fea_element_fields(model, physics, results),
                   compile::fea_node_fields(physics, results), sink);
  file.close();
  file.commit();
}

std::optional<compile::BrickPlan> plan_bricks(const FeaChoices& a, const compile::LoadedPtr& loaded, Session& session,
                                              Diagnostics& diagnostics) {
  const auto options = plan_options(a.sampling(), a.work, session, diagnostics);
  if (!options) return std::nullopt;
  return compile::plan_model(loaded, *options, a.sections.fill, diagnostics);
}

// Makes the model of a study of this design; with a period the model is periodic.
class ModelMaker {
 public:
  ModelMaker(const FeaChoices& a, const compile::LoadedPtr& loaded, const fea::Study& study,
             const std::optional<Box>& period, Session& session, Diagnostics& diagnostics)
      : a_(a), loaded_(loaded), study_(study), period_(period), session_(session), diagnostics_(diagnostics) {}

  std::optional<fea::Model> bricks() {
    FeaChoices own = a_;
    compile::LoadedPtr sampled = loaded_;
    if (period_) {
      sampled = with_repeating_bricks(a_, loaded_, *period_, diagnostics_);
      own.cell.reset();  // the period's bricks decide the lattice, not --cell
    }
    if (!sampled) return std::nullopt;
    const auto plan = plan_bricks(own, sampled, session_, diagnostics_);
    if (!plan) return std::nullopt;
    JobProgress progress(session_.events, Counted::voxels);
    return compile::fea_model(sampled, *plan, study_, a_.sections.request(a_.work.threads), diagnostics_, &progress,
                              &session_.stop);
  }

  std::optional<compile::TetraModel> tetrahedra() {
    compile::TetraRequest request;
    request.size = a_.size();
    request.quadratic = a_.elements == FeaChoices::Elements::tet10;
    request.by_material = !a_.subdomains.empty();
    request.sections = a_.sections.request(a_.work.threads);
    request.seed = a_.seed;
    request.period = period_;
    request.memory_bytes = a_.work.memory_bytes;
    request.announce = [&](const compile::TetraPlan& plan) {
      session_.events.say("about " + format_rounded(plan.elements, 2) + " tetrahedra; meshing takes about " +
                          format_bytes(plan.memory_bytes));
    };
    JobProgress progress(session_.events, Counted::steps);
    return compile::tetra_model(loaded_, study_, request, diagnostics_, &progress, &session_.stop);
  }

 private:
  const FeaChoices& a_;
  const compile::LoadedPtr& loaded_;
  const fea::Study& study_;
  const std::optional<Box>& period_;
  Session& session_;
  Diagnostics& diagnostics_;
};

// Joins a model to its case; returns nothing if there is no model.
template <class Model>
std::optional<Case> case_of(std::optional<Model> model) {
  if (!model) return std::nullopt;
  return Case{std::move(*model), {}};
}

// Warns if bricks are too large for the walls.
void warn_of_thin_walls(const fea::ModelView& model, const fea::Study& study, Diagnostics& diagnostics) {
  constexpr double many = 0.1;
  if (!model.mesh.bricks()) return;
  const double share = fea::share_of_thin_walls(*model.mesh.bricks());
  if (share > many)
    diagnostics.warning(
        study.where,
        format_rounded(100 * share, 2) + " % of the volume lies in walls fewer than " + format_number(fea::few_bricks) +
            " bricks across, whose stresses and bending are rough",
        "choose a smaller " + spelled::option("--cell") + ", or " + spelled::option("--elements", "tet10"));
}

// Warns of elements that are too stiff for their material, and of meshes that miss some of the part.
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
  if (here.is_mechanics()) warn_of_thin_walls(model, study, diagnostics);
  if (!here.tetrahedra() || study.mean_strain) return;
  constexpr double most_off = 0.05;
  const double volume = model.mesh.total_volume_mm3(), wanted = here.tetrahedra()->surface_mm3;
  if (std::abs(volume - wanted) > most_off * wanted)
    diagnostics.warning(study.where,
                        "the tetrahedra fill " + format_rounded(volume, 4) + " mm3, the design's surface " +
                            "encloses " + format_rounded(wanted, 4) + " mm3",
                        "choose a smaller --size");
}

std::optional<Case> make_case(const FeaChoices& a, Session& session, Diagnostics& diagnostics) {
  const auto study = read_study(a.study, diagnostics);
  if (!study) return std::nullopt;
  if (study->mean_strain) check_repeats(a);
  const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.work.threads);
  if (!loaded) return std::nullopt;
  std::optional<Box> period;
  if (study->mean_strain) {
    period = period_of(*loaded, diagnostics);
    if (!period) return std::nullopt;
  }
  ModelMaker maker(a, loaded, *study, period, session, diagnostics);
  auto here = a.elements == FeaChoices::Elements::brick ? case_of(maker.bricks()) : case_of(maker.tetrahedra());
  if (!here) return std::nullopt;
  warn_of_mesh(*here, *study, diagnostics);
  const fea::ModelView view = here->view();
  if (period) {
    here->conditions = repeating_conditions(view, *period, *study->mean_strain);
    return here;
  }
  const auto choose = compile::node_chooser(*loaded, view.mesh, a.work.threads, &session.stop);
  auto conditions = fea::conditions_of(*study, view, diagnostics, choose);
  if (!conditions) return std::nullopt;
  here->conditions = std::move(*conditions);
  return here;
}

compile::FeaResults solve_elsewhere(const FeaChoices& a, const Case& here, Session& session) {
  const fea::CalculixOptions options{a.brick, a.work.threads};
  compile::FeaResults results;
  if (here.is_mechanics())
    results.solution = fea::solve_by_calculix(here.view(), here.conditions, options, &session.stop);
  else
    results.conduction = fea::conduct_by_calculix(here.view(), here.conditions, options, &session.stop);
  return results;
}

compile::FeaResults solve_case(const FeaChoices& a, const Case& here, Session& session) {
  const Stopwatch watch;
  fea::SolveOptions options;
  options.tolerance = a.tolerance;
  options.threads = a.work.threads;
  if (a.has_own_solver()) options.solver = a.solver;
  options.memory_bytes = static_cast<double>(a.work.memory_bytes) - here.solve_bytes();
  options.announce = [&](const fea::DirectUse& use) { tell_factorisation(session.events, use); };
  JobProgress progress(session.events, Counted::steps);
  const fea::ModelView model = here.view();
  compile::FeaResults results;
  if (!a.has_own_solver())
    results = solve_elsewhere(a, here, session);
  else if (!here.is_mechanics())
    results.conduction = fea::conduct(model, here.conditions, options, &progress, &session.stop);
  else if (const auto* bricks = std::get_if<fea::Model>(&here.made))
    results.solution = fea::solve(*bricks, here.conditions, options, &progress, &session.stop);
  else
    results.solution = fea::solve_mesh(model, here.conditions, options, &progress, &session.stop);
  if (results.solution) results.stresses = fea::stresses_of(model, *results.solution);
  progress.finish();
  tell_results(a, session.events, here, results, watch.seconds());
  if (results.solution) tell_mean_stress(session.events, here, *results.solution);
  return results;
}

void check_memory(const FeaChoices& a, const Case& here) {
  if (!a.solves() || !a.has_own_solver()) return;
  const Phrase option = here.tetrahedra() ? spelled::option("--size") : spelled::option("--cell");
  refuse_little_memory(here.solve_bytes(), a.work.memory_bytes, "choose larger elements with " + option);
}

// Returns the steps that solving and writing a model have in common: the plan, and the check of memory.
JobSteps<Case> steps_before(const FeaChoices& a, Session& session) {
  JobSteps<Case> steps;
  steps.plan = [&](Diagnostics& diagnostics) { return make_case(a, session, diagnostics); };
  steps.check = [&](const Case& here) {
    tell_model(session.events, here);
    check_memory(a, here);
  };
  return steps;
}

void write_outputs(const FeaChoices& a, Session& session, const Case& here, const compile::FeaResults& results,
                   int round, DataList& files) {
  for (const std::string& path : a.outputs) {
    if (ending_of(path) == ".csv") continue;
    const std::string name = round == 0 ? path : path_of_round(path, round);
    write_output(a, name, here, results);
    session.events.say(name + " written");
    files.emplace_back(name);
  }
}

// Returns the -D option for the next round: the file with the results of this one.
std::string definition_of(const FeaChoices& a, int round) {
  const auto grid = std::ranges::find_if(a.outputs, [](const std::string& path) { return ending_of(path) == ".vtu"; });
  return a.follow + "=" + std::filesystem::absolute(path_of_round(*grid, round)).string();
}

void write_history(const FeaChoices& a, const RoundHistory& history) {
  for (const std::string& path : a.outputs)
    if (ending_of(path) == ".csv") exporting::write_file(path, history.text());
}

void tell_change(const Events& events, int round, std::optional<double> change) {
  if (round == 1) return;
  events.say("round " + std::to_string(round) + ": " +
             (change ? "the mixture changed by at most " + format_rounded(*change, 3) : "other elements"));
}

// Rounds of a design that reads its own results.
class Rounds {
 public:
  Rounds(const FeaChoices& choices, Session& session) : a_(choices), session_(session) {
    a_.design.needed = {a_.follow};
  }

  int run() {
    const std::vector<std::string> definitions = a_.design.definitions;
    for (int round = 1; round <= a_.rounds && !is_over_; ++round) {
      JobSteps<Case> steps = steps_before(a_, session_);
      steps.run = [&](const Case& here) { return run(round, here, definitions); };
      if (const int code = take_steps(steps, session_); code != done) return code;
    }
    for (const std::string& path : a_.outputs)
      if (ending_of(path) == ".csv") files_.emplace_back(path);
    session_.events.say("the design that follows: -D " + a_.design.definitions.back());
    session_.events.event("done", {{"files", files_}, {"seconds", watch_.seconds()}});
    return done;
  }

 private:
  int run(int round, const Case& here, const std::vector<std::string>& definitions) {
    RoundModel now = round_model_of(here.view());
    const auto change = round == 1 ? std::nullopt : change_between(before_, now);
    tell_change(session_.events, round, change);
    is_over_ = change && *change <= a_.change;
    if (is_over_) {
      session_.events.say("nothing changes any more after " + counted(static_cast<size_t>(round - 1), "round"));
      return done;
    }
    const compile::FeaResults results = solve_case(a_, here, session_);
    write_outputs(a_, session_, here, results, round, files_);
    history_.add(round, now, change, here.conditions.physics, results);
    write_history(a_, history_);
    before_ = std::move(now);
    a_.design.definitions = definitions;
    a_.design.definitions.push_back(definition_of(a_, round));
    return done;
  }

  FeaChoices a_;
  Session& session_;
  Stopwatch watch_;
  RoundHistory history_;
  RoundModel before_;
  DataList files_;
  bool is_over_ = false;
};

int run_once(const FeaChoices& a, Session& session) {
  const Stopwatch watch;
  JobSteps<Case> steps = steps_before(a, session);
  steps.run = [&](const Case& here) {
    compile::FeaResults results;
    if (a.solves()) results = solve_case(a, here, session);
    DataList files;
    write_outputs(a, session, here, results, 0, files);
    session.events.event("done", {{"files", files}, {"seconds", watch.seconds()}});
    return done;
  };
  return take_steps(steps, session);
}

int run_fea(const FeaChoices& a, Session& session) {
  a.check();
  refuse_to_overwrite(a);
  return a.rounds > 0 ? Rounds(a, session).run() : run_once(a, session);
}

}  // namespace

JobKind fea_kind() {
  return job_kind<FeaChoices>("fea", "Write a finite-element model, or solve it under loads", fea_footer, run_fea);
}

}  // namespace ombre::jobs
