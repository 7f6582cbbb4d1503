// ombre fea: a design as a finite-element model, and what it does under load.
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/json.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "compile/fea_job.h"
#include "compile/find_printer.h"
#include "export/output_file.h"
#include "fea/inp_writer.h"
#include "fea/vtu_writer.h"
#include "formats/file.h"
#include "ombre/arguments.h"
#include "ombre/checks.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"
#include "ombre/job_arguments.h"
#include "ombre/overwrite.h"
#include "ombre/progress_line.h"

namespace ombre::cli {
namespace {

struct FeaArguments {
  DesignArguments design;
  std::vector<std::string> outputs;
  std::string study, cell, assign = "draw", modulus, element = "C3D8", seed = "0", memory = "8G";
  double tolerance = 1e-8;
  int threads = 0, sections = 64;
  bool solve = false, force = false;
};

constexpr const char* fea_footer =
    "Lengths are millimetres, forces newtons, stresses MPa.\n\n"
    "FILE ends in\n"
    "  .inp   a deck for Abaqus and CalculiX, complete with supports and loads\n"
    "  .vtu   a grid for ParaView and others with VTK: fractions, attributes, moduli; with --solve the results too\n\n"
    "STUDY is a JSON file: properties of materials, what is held, what pulls.\n"
    "  {\"materials\": {\"red\": {\"modulus_mpa\": 2850, \"poissons_ratio\": 0.39, \"density_kg_m3\": 1180}},\n"
    "   \"supports\": [{\"on\": \"zmin\", \"fix\": \"xyz\"}],\n"
    "   \"loads\": [{\"on\": \"zmax\", \"force_n\": [0, 0, -10]}]}\n"
    "\"on\" is a side of the part (xmin to zmax) or {\"box\": [x0, y0, z0, x1, y1, z1]}. A support says \"fix\" or\n"
    "\"displacement_mm\": [null, null, -1]; a load \"force_n\" or \"pressure_mpa\"; \"gravity_mm_s2\" is a vector.\n\n"
    "Examples:\n"
    "  ombre fea part.vcad --study pull.json --cell 1 -o part.inp\n"
    "  ombre fea part.vcad --study pull.json --cell 0.5 --solve -o part.vtu\n"
    "  ombre fea part.vcad --study pull.json --cell 1 --assign mix --solve\n";

void add_arguments(CLI::App& app, FeaArguments& a) {
  add_design_arguments(app, a.design);
  app.add_option("--study", a.study, "The study: properties, supports and loads; a .json file")
      ->required()
      ->type_name("FILE");
  app.add_option("--cell", a.cell, "Size of the bricks: one length, or x,y,z; mm")->required()->type_name("X,Y,Z");
  app.add_option("-o,--output", a.outputs, "A file to write, .inp or .vtu; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_flag("--solve", a.solve, "Solve it: displacements, stresses, reactions");
  app.add_option("--assign", a.assign,
                 "What a brick of a mixture is made of: draw (default: one material, by the odds of its fractions) or\n"
                 "mix (mean properties)")
      ->check(one_of({"draw", "mix"}))
      ->type_name("RULE");
  app.add_option("--modulus", a.modulus, "An attribute of the design that is Young's modulus in MPa")
      ->type_name("NAME");
  app.add_option("--sections", a.sections,
                 "With mix or --modulus: into how many sections bricks are gathered (default 64)")
      ->check(whole_between(1, 60000))
      ->type_name("N");
  app.add_option("--element", a.element, "Elements of a deck: C3D8 (default), C3D8I or C3D8R")
      ->check(one_of({"C3D8", "C3D8I", "C3D8R"}))
      ->type_name("TYPE");
  app.add_option("--tolerance", a.tolerance, "How near the forces must come to the loads, as a share (default 1e-8)")
      ->check(between(1e-14, 0.1))
      ->type_name("X");
  app.add_option("--seed", a.seed, "Seed of draw (default 0)")->type_name("N");
  add_threads(app, a.threads);
  app.add_option("--memory", a.memory, "Most memory for solving (default 8G)")->type_name("SIZE");
  app.add_flag("--force", a.force, "Replace files that are there");
}

std::string ending_of(const std::string& path) { return to_lower(std::filesystem::path(path).extension().string()); }

void check_outputs(const FeaArguments& a) {
  if (a.outputs.empty() && !a.solve)
    throw WrongArgument("there is nothing to do: write -o part.inp or -o part.vtu, or --solve");
  for (const std::string& path : a.outputs) {
    const std::string ending = ending_of(path);
    if (ending != ".inp" && ending != ".vtu")
      throw WrongArgument("-o " + path + " does not say a format; let it end in .inp or .vtu");
    refuse_to_overwrite(path, a.force);
  }
}

fea::BrickType type_of(const std::string& name) {
  if (name == "C3D8I") return fea::BrickType::c3d8i;
  return name == "C3D8R" ? fea::BrickType::c3d8r : fea::BrickType::c3d8;
}

std::optional<fea::Study> read_study(const std::string& path, Diagnostics& diagnostics) {
  const auto data = parse_json(make_source(path, formats::read_file(path)), diagnostics);
  return data ? fea::read_study(*data, diagnostics) : std::nullopt;
}

std::string text_of(Vec3 v, int digits = 4) {
  return "(" + format_rounded(v.x, digits) + ", " + format_rounded(v.y, digits) + ", " + format_rounded(v.z, digits) +
         ")";
}

std::string counted(size_t count, const std::string& what) {
  return format_count(count) + " " + what + (count == 1 ? "" : "s");
}

Data triple(Vec3 v) { return DataList{v.x, v.y, v.z}; }

void tell_model(const Console& console, const fea::Model& model, double bytes) {
  const fea::Bricks& bricks = model.bricks;
  console.say(counted(bricks.count(), "brick") + " of " + format_rounded(bricks.size_mm.x) + " x " +
              format_rounded(bricks.size_mm.y) + " x " + format_rounded(bricks.size_mm.z) + " mm, " +
              format_count(bricks.node_count()) + " nodes, " + counted(model.sections.size(), "section") + ", " +
              format_rounded(static_cast<double>(bricks.count()) * bricks.volume_mm3(), 6) +
              " mm3; solving takes about " + format_bytes(bytes));
  DataList sections;
  for (const fea::Section& section : model.sections)
    sections.push_back(DataMembers{{"name", section.name},
                                   {"modulus_mpa", section.elastic.modulus_mpa},
                                   {"poissons_ratio", section.elastic.poissons_ratio}});
  console.event("model", {{"bricks", static_cast<double>(bricks.count())},
                          {"nodes", static_cast<double>(bricks.node_count())},
                          {"sections", sections},
                          {"memory_bytes", bytes}});
}

void tell_solution(const Console& console, const fea::Model& model, const fea::Solution& solution, double seconds) {
  size_t far = 0, strong = 0;
  for (size_t n = 0; n < solution.displacement_mm.size(); ++n)
    if (length(solution.displacement_mm[n]) > length(solution.displacement_mm[far])) far = n;
  std::vector<double> mises;
  for (const auto& stress : solution.stress_mpa) mises.push_back(fea::von_mises(stress));
  strong = static_cast<size_t>(std::ranges::max_element(mises) - mises.begin());
  Vec3 reaction;
  for (const fea::Prescribed& here : solution.reactions_n) reaction[here.axis] += here.value;
  const Vec3 u = solution.displacement_mm[far];
  console.say("solved in " + counted(solution.iterations, "iteration") + " and " + format_rounded(seconds, 3) + " s");
  console.say("moves by at most " + format_rounded(length(u)) + " mm, " + text_of(u) + " at " +
              text_of(model.bricks.node(far)));
  console.say("von Mises stress at most " + format_rounded(mises[strong]) + " MPa, at " +
              text_of(model.bricks.centroid(strong)));
  console.say("the supports hold with " + text_of(reaction, 5) + " N; strain energy " +
              format_rounded(solution.energy_mj, 5) + " mJ");
  console.event("solution", {{"iterations", static_cast<double>(solution.iterations)},
                             {"residual", solution.residual},
                             {"seconds", seconds},
                             {"greatest_displacement_mm", triple(u)},
                             {"greatest_displacement_at_mm", triple(model.bricks.node(far))},
                             {"greatest_von_mises_mpa", mises[strong]},
                             {"greatest_von_mises_at_mm", triple(model.bricks.centroid(strong))},
                             {"reaction_n", triple(reaction)},
                             {"strain_energy_mj", solution.energy_mj}});
}

void write_output(const FeaArguments& a, const std::string& path, const fea::Model& model,
                  const fea::Conditions& conditions, const fea::Solution* solution) {
  exporting::NewFile file(path);
  const fea::Sink sink = [&](std::string_view bytes) { file.append(bytes); };
  if (ending_of(path) == ".inp")
    fea::write_inp(model, conditions, type_of(a.element), std::filesystem::path(a.design.design).filename().string(),
                   sink);
  else
    fea::write_vtu(model.bricks, compile::fea_brick_fields(model, solution), compile::fea_node_fields(solution), sink);
  file.close();
  file.commit();
}

std::optional<compile::Plan> plan_bricks(const FeaArguments& a, const compile::LoadedPtr& loaded, Session& session,
                                         Diagnostics& diagnostics) {
  JobArguments job;
  static_cast<DesignArguments&>(job) = a.design;
  job.voxel = a.cell;
  job.seed = a.seed;
  auto options = plan_options(job, diagnostics);
  if (!options) return std::nullopt;
  options->threads = a.threads;
  options->stop = &session.stop;
  return compile::plan_slice(loaded, *options, diagnostics);
}

compile::FeaRequest request_of(const FeaArguments& a) {
  compile::FeaRequest request;
  if (a.assign == "mix") request.assign = compile::FeaRequest::Assign::mix;
  if (!a.modulus.empty()) request.modulus = a.modulus;
  request.most_sections = static_cast<size_t>(a.sections);
  request.threads = a.threads;
  return request;
}

struct Case {
  fea::Model model;
  fea::Conditions conditions;
};

std::optional<Case> make_case(const FeaArguments& a, Session& session, Diagnostics& diagnostics) {
  const auto study = read_study(a.study, diagnostics);
  if (!study) return std::nullopt;
  const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.threads);
  if (!loaded) return std::nullopt;
  const auto plan = plan_bricks(a, loaded, session, diagnostics);
  if (!plan) return std::nullopt;
  ProgressLine progress(session.console);
  auto model = compile::fea_model(loaded, *plan, *study, request_of(a), diagnostics, &progress, &session.stop);
  progress.finish();
  if (!model) return std::nullopt;
  auto conditions = fea::conditions_of(*study, *model, diagnostics);
  if (!conditions) return std::nullopt;
  return Case{std::move(*model), std::move(*conditions)};
}

fea::Solution solve_case(const FeaArguments& a, const Case& here, Session& session) {
  const Stopwatch watch;
  fea::SolveOptions options;
  options.tolerance = a.tolerance;
  options.threads = a.threads;
  ProgressLine progress(session.console, Counted::steps);
  const fea::Solution solution = fea::solve(here.model, here.conditions, options, &progress, &session.stop);
  progress.finish();
  tell_solution(session.console, here.model, solution, watch.seconds());
  return solution;
}

int run_fea(const FeaArguments& a, Session& session) {
  check_outputs(a);
  parse_voxel(a.cell);
  const auto allowed = static_cast<double>(parse_memory(a.memory));
  const Stopwatch watch;
  Diagnostics diagnostics;
  const auto made = make_case(a, session, diagnostics);
  session.console.diagnose(diagnostics);
  if (!made || diagnostics.has_errors()) return wrong_input;
  const double bytes = fea::solve_bytes(made->model.bricks);
  tell_model(session.console, made->model, bytes);
  if (a.solve && bytes > allowed)
    throw Error("solving takes about " + format_bytes(bytes) + " of memory, more than the " + format_bytes(allowed) +
                " allowed; choose larger bricks with --cell, or more --memory");
  std::optional<fea::Solution> solution;
  if (a.solve) solution = solve_case(a, *made, session);
  DataList files;
  for (const std::string& path : a.outputs) {
    write_output(a, path, made->model, made->conditions, solution ? &*solution : nullptr);
    session.console.say(path + " written");
    files.emplace_back(path);
  }
  session.console.event("done", {{"files", files}, {"seconds", watch.seconds()}});
  return done;
}

}  // namespace

Command add_fea(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("fea", "Write a finite-element model, or solve it under loads");
  auto arguments = std::make_shared<FeaArguments>();
  add_arguments(*app, *arguments);
  add_output_options(*app, output);
  app->footer(fea_footer);
  return {app, [arguments](Session& session) { return run_fea(*arguments, session); }};
}

}  // namespace ombre::cli
