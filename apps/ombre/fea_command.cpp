// ombre fea: a design as a finite-element model, and what it does under load.
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <variant>

#include "base/error.h"
#include "base/json.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "compile/fea_job.h"
#include "compile/fea_selection.h"
#include "compile/fea_xdmf.h"
#include "compile/find_printer.h"
#include "compile/tetra_job.h"
#include "export/output_file.h"
#include "fea/calculix.h"
#include "fea/inp_writer.h"
#include "fea/mesh_elastic.h"
#include "fea/node_matrix.h"
#include "fea/vtu_writer.h"
#include "formats/file.h"
#include "ombre/arguments.h"
#include "ombre/checks.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"
#include "ombre/fea_rounds.h"
#include "ombre/job_arguments.h"
#include "ombre/overwrite.h"
#include "ombre/progress_line.h"

namespace ombre::cli {
namespace {

struct FeaArguments {
  DesignArguments design;
  std::vector<std::string> outputs;
  std::string study, elements = "brick", cell, size_by, subdomains, assign = "draw", modulus, conductivity,
                     element = "C3D8", solver = "built-in", seed = "0", memory = "8G";
  std::string follow;
  double size = 0, min_cell = 0, max_cell = 0, tolerance = 1e-8, change = 1e-3;
  int threads = 0, sections = 64, rounds = 0;
  bool solve = false, force = false;
};

constexpr const char* fea_footer =
    "Lengths are millimetres, forces newtons, stresses MPa; heat is in watts, temperatures are degrees Celsius.\n\n"
    "FILE ends in\n"
    "  .inp   a deck for Abaqus and CalculiX, complete with supports and loads\n"
    "  .vtu   a grid for ParaView and others with VTK: fractions, attributes, moduli; with --solve the results too\n"
    "  .xdmf  the same for ParaView and FEniCSx, its numbers in a file of HDF5 beside it, part.h5\n"
    "  .csv   with --rounds: a line for each round\n\n"
    "--rounds solves a design that reads its own results: the variable --follow gets the name of the .vtu file of the\n"
    "round before, until nothing changes. Files get the number of their round: part_1.vtu, part_2.vtu.\n\n"
    "STUDY is a JSON file: properties of materials, what is held, what pulls.\n"
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
    "\"current_a\" or \"current_a_mm2\".\n\n"
    "Examples:\n"
    "  ombre fea part.vcad --study pull.json --cell 1 -o part.inp\n"
    "  ombre fea part.vcad --study pull.json --cell 0.5 --solve -o part.vtu\n"
    "  ombre fea part.vcad --study pull.json --elements tet10 --size 1.5 --solve -o part.vtu\n"
    "  ombre fea part.vcad --study pull.json --elements tet4 --size-by \"min_cell + h*(max_cell - min_cell)\" \\\n"
    "            --min-cell 0.5 --max-cell 3 -o part.inp\n"
    "  ombre fea seat.vcad --study rider.json --cell 4 --rounds 5 --follow moved -o seat.vtu -o seat.csv\n";

void add_arguments(CLI::App& app, FeaArguments& a) {
  add_design_arguments(app, a.design);
  app.add_option("--study", a.study, "The study: properties, supports and loads; a .json file")
      ->required()
      ->type_name("FILE");
  app.add_option("--elements", a.elements,
                 "brick (default: voxels whose centre is inside), or up to the surface tet4 or tet10: tetrahedra with\n"
                 "linear or quadratic displacements")
      ->check(one_of({"brick", "tet4", "tet10"}))
      ->type_name("KIND");
  app.add_option("--cell", a.cell, "Size of bricks: one length, or x,y,z; mm")->type_name("X,Y,Z");
  app.add_option("--size", a.size, "About the length of edges of tetrahedra; mm")
      ->check(between(1e-6, 1e6))
      ->type_name("MM");
  app.add_option(
         "--size-by", a.size_by,
         "The same by a formula over x, y, z, attributes, min_cell, max_cell and h, which is 1 where there is one\n"
         "material and 0 in an even mixture of all")
      ->type_name("FORMULA");
  app.add_option("--min-cell", a.min_cell, "The least that --size-by may give; mm")
      ->check(between(1e-6, 1e6))
      ->type_name("MM");
  app.add_option("--max-cell", a.max_cell, "The most that --size-by may give; mm")
      ->check(between(1e-6, 1e6))
      ->type_name("MM");
  app.add_option("--subdomains", a.subdomains,
                 "materials: borders between materials become faces of tetrahedra, each of one material")
      ->check(one_of({"materials"}))
      ->type_name("RULE");
  app.add_option("-o,--output", a.outputs, "A file to write, .inp, .vtu, .xdmf or, of rounds, .csv; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_flag("--solve", a.solve, "Solve it: displacements, stresses, reactions");
  app.add_option("--solver", a.solver,
                 "built-in (default), or calculix: the program ccx, where it is installed; with --solve")
      ->check(one_of({"built-in", "calculix"}))
      ->type_name("NAME");
  app.add_option("--rounds", a.rounds, "Solve, hand the results to the design, and again: at most so many times")
      ->check(whole_between(1, 1000))
      ->type_name("N");
  app.add_option("--follow", a.follow, "Of rounds: the variable of the design that names the file with the results")
      ->type_name("NAME");
  app.add_option("--change", a.change,
                 "Of rounds: the greatest change of a fraction or an attribute that counts as none (default 0.001)")
      ->check(between(0, 1))
      ->type_name("X");
  app.add_option("--assign", a.assign,
                 "What an element of a mixture is made of: draw (default: one material, by the odds of its fractions)\n"
                 "or mix (mean properties)")
      ->check(one_of({"draw", "mix"}))
      ->type_name("RULE");
  app.add_option("--modulus", a.modulus, "An attribute of the design that is Young's modulus in MPa")
      ->type_name("NAME");
  app.add_option("--conductivity", a.conductivity,
                 "In conduction: an attribute that is the conductivity in W/(m K) or S/m")
      ->type_name("NAME");
  app.add_option("--sections", a.sections,
                 "With mix, --modulus or --conductivity: into how many sections elements are gathered (default 64)")
      ->check(whole_between(1, 60000))
      ->type_name("N");
  app.add_option("--element", a.element, "Bricks of a deck: C3D8 (default), C3D8I or C3D8R")
      ->check(one_of({"C3D8", "C3D8I", "C3D8R"}))
      ->type_name("TYPE");
  app.add_option("--tolerance", a.tolerance, "How near the forces must come to the loads, as a share (default 1e-8)")
      ->check(between(1e-14, 0.1))
      ->type_name("X");
  app.add_option("--seed", a.seed, "Seed of draw (default 0)")->type_name("N");
  add_threads(app, a.threads);
  app.add_option("--memory", a.memory, "Most memory for meshing or solving (default 8G)")->type_name("SIZE");
  app.add_flag("--force", a.force, "Replace files that are there");
}

std::string ending_of(const std::string& path) { return to_lower(std::filesystem::path(path).extension().string()); }

void check_rounds(const FeaArguments& a) {
  if (a.rounds == 0) {
    if (!a.follow.empty()) throw WrongArgument("--follow is of rounds: add --rounds 5");
    return;
  }
  if (a.follow.empty())
    throw WrongArgument("--rounds needs the variable of the design that names the results: write --follow moved");
  if (std::ranges::none_of(a.outputs, [](const std::string& path) { return ending_of(path) == ".vtu"; }))
    throw WrongArgument("--rounds needs a file for the results that the design reads: write -o part.vtu");
}

// The names that an output has: with rounds one for each, but for their history.
std::vector<std::string> names_of(const FeaArguments& a, const std::string& path) {
  if (a.rounds == 0 || ending_of(path) == ".csv") return {path};
  std::vector<std::string> names;
  for (int round = 1; round <= a.rounds; ++round) names.push_back(path_of_round(path, round));
  return names;
}

// The file of HDF5 beside an .xdmf file.
std::string numbers_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".h5").string();
}

void check_outputs(const FeaArguments& a) {
  if (a.solver != "built-in" && !a.solve) throw WrongArgument("--solver calculix does nothing without --solve");
  if (a.outputs.empty() && !a.solve)
    throw WrongArgument("there is nothing to do: write -o part.inp or -o part.vtu, or --solve");
  for (const std::string& path : a.outputs) {
    const std::string ending = ending_of(path);
    if (ending == ".csv" && a.rounds == 0) throw WrongArgument("-o " + path + " is of rounds: add --rounds 5");
    if (ending != ".inp" && ending != ".vtu" && ending != ".xdmf" && ending != ".csv")
      throw WrongArgument("-o " + path + " does not say a format; let it end in .inp, .vtu or .xdmf");
    for (const std::string& name : names_of(a, path)) {
      refuse_to_overwrite(name, a.force);
      if (ending == ".xdmf") refuse_to_overwrite(numbers_path(name), a.force);
    }
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

// A model of bricks or tetrahedra with its supports and loads.
struct Case {
  std::variant<fea::Model, compile::TetraModel> made;
  fea::Conditions conditions;

  fea::ModelView view() const {
    if (const auto* bricks = std::get_if<fea::Model>(&made)) return *bricks;
    return std::get<compile::TetraModel>(made).model;
  }
  const compile::TetraModel* tetrahedra() const { return std::get_if<compile::TetraModel>(&made); }
  bool is_mechanics() const { return conditions.physics == fea::Physics::mechanics; }
  // Bricks have a solver of their own.
  double solve_bytes() const {
    const fea::ModelView model = view();
    if (const fea::Bricks* bricks = model.mesh.bricks())
      return is_mechanics() ? fea::solve_bytes(*bricks) : fea::conduct_bytes(*bricks);
    return fea::system_bytes(model.mesh, is_mechanics() ? 3 : 1);
  }
};

std::string element_text(const fea::MeshView& mesh) {
  if (const fea::Bricks* bricks = mesh.bricks())
    return counted(mesh.count(), "brick") + " of " + format_rounded(bricks->size_mm.x) + " x " +
           format_rounded(bricks->size_mm.y) + " x " + format_rounded(bricks->size_mm.z) + " mm";
  return format_count(mesh.count()) + " tetrahedra " + mesh.shape().name;
}

void tell_quality(const Console& console, const compile::TetraModel& made) {
  const fea::MeshQuality& quality = made.quality;
  console.say("edges of " + format_rounded(quality.mean_edge_mm, 3) + " mm on average; dihedral angles from " +
              format_rounded(quality.least_dihedral, 3) + " to " + format_rounded(quality.most_dihedral, 4) +
              " degrees, aspect at most " + format_rounded(quality.worst_aspect, 3) + ", " +
              format_count(quality.inverted) + " inverted; the surface has " + format_rounded(made.surface_mm3, 6) +
              " mm3");
  console.event("quality", {{"mean_edge_mm", quality.mean_edge_mm},
                            {"least_dihedral_degrees", quality.least_dihedral},
                            {"most_dihedral_degrees", quality.most_dihedral},
                            {"worst_aspect", quality.worst_aspect},
                            {"inverted", static_cast<double>(quality.inverted)},
                            {"surface_mm3", made.surface_mm3}});
}

void tell_model(const Console& console, const Case& here) {
  const fea::ModelView model = here.view();
  const double bytes = here.solve_bytes(), volume = model.mesh.total_volume_mm3();
  console.say(element_text(model.mesh) + ", " + format_count(model.mesh.node_count()) + " nodes, " +
              counted(model.sections.size(), "section") + ", " + format_rounded(volume, 6) +
              " mm3; solving takes about " + format_bytes(bytes));
  DataList sections;
  for (const fea::Section& section : model.sections) {
    if (here.is_mechanics())
      sections.push_back(DataMembers{{"name", section.name},
                                     {"modulus_mpa", section.elastic.modulus_mpa},
                                     {"poissons_ratio", section.elastic.poissons_ratio}});
    else
      sections.push_back(DataMembers{{"name", section.name}, {"conductivity", section.conductivity}});
  }
  console.event("model", {{here.tetrahedra() ? "tetrahedra" : "bricks", static_cast<double>(model.mesh.count())},
                          {"nodes", static_cast<double>(model.mesh.node_count())},
                          {"sections", sections},
                          {"volume_mm3", volume},
                          {"memory_bytes", bytes}});
  if (here.tetrahedra()) tell_quality(console, *here.tetrahedra());
}

std::string solved_text(const FeaArguments& a, size_t iterations, double seconds) {
  const std::string way = a.solver == "calculix" ? "by CalculiX"
                          : iterations == 0      ? "directly"
                                                 : "in " + counted(iterations, "iteration");
  return "solved " + way + " and " + format_rounded(seconds, 3) + " s";
}

void tell_solution(const FeaArguments& a, const Console& console, const fea::MeshView& mesh,
                   const fea::Solution& solution, double seconds) {
  size_t far = 0, strong = 0;
  for (size_t n = 0; n < solution.displacement_mm.size(); ++n)
    if (length(solution.displacement_mm[n]) > length(solution.displacement_mm[far])) far = n;
  std::vector<double> mises;
  for (const auto& stress : solution.stress_mpa) mises.push_back(fea::von_mises(stress));
  strong = static_cast<size_t>(std::ranges::max_element(mises) - mises.begin());
  Vec3 reaction;
  for (const fea::Prescribed& here : solution.reactions_n) reaction[here.axis] += here.value;
  const Vec3 u = solution.displacement_mm[far];
  console.say(solved_text(a, solution.iterations, seconds));
  console.say("moves by at most " + format_rounded(length(u)) + " mm, " + text_of(u) + " at " +
              text_of(mesh.node(far)));
  console.say("von Mises stress at most " + format_rounded(mises[strong]) + " MPa, at " +
              text_of(mesh.centroid(strong)));
  console.say("the supports hold with " + text_of(reaction, 5) + " N; strain energy " +
              format_rounded(solution.energy_mj, 5) + " mJ");
  console.event("solution", {{"iterations", static_cast<double>(solution.iterations)},
                             {"residual", solution.residual},
                             {"seconds", seconds},
                             {"greatest_displacement_mm", triple(u)},
                             {"greatest_displacement_at_mm", triple(mesh.node(far))},
                             {"greatest_von_mises_mpa", mises[strong]},
                             {"greatest_von_mises_at_mm", triple(mesh.centroid(strong))},
                             {"reaction_n", triple(reaction)},
                             {"strain_energy_mj", solution.energy_mj}});
}

void tell_conduction(const FeaArguments& a, const Console& console, const Case& here, const fea::Conduction& found,
                     double seconds) {
  const bool is_heat = here.conditions.physics == fea::Physics::heat;
  const fea::ModelView model = here.view();
  const auto [least, most] = std::ranges::minmax_element(found.value);
  std::vector<double> flux;
  for (const Vec3& v : found.flux) flux.push_back(length(v));
  const auto strong = static_cast<size_t>(std::ranges::max_element(flux) - flux.begin());
  double enters = 0, leaves = found.lost_w;
  const auto add = [&](double flow) { flow > 0 ? enters += flow : leaves -= flow; };
  for (const fea::Prescribed& flow : found.flows) add(flow.value);
  for (const fea::Prescribed& flow : here.conditions.forces) add(flow.value);
  const std::string unit = is_heat ? " C" : " V", flow_unit = is_heat ? " W" : " A";
  console.say(solved_text(a, found.iterations, seconds));
  console.say(std::string(is_heat ? "temperatures" : "potentials") + " from " + format_rounded(*least) + " to " +
              format_rounded(*most) + unit + ", the latter at " +
              text_of(model.mesh.node(static_cast<size_t>(most - found.value.begin()))));
  console.say(std::string(is_heat ? "heat flux" : "current density") + " at most " + format_rounded(flux[strong]) +
              flow_unit + "/mm2, at " + text_of(model.mesh.centroid(strong)));
  console.say(format_rounded(enters, 5) + flow_unit + " enter, " + format_rounded(leaves, 5) + flow_unit + " leave");
  console.event("solution", {{"iterations", static_cast<double>(found.iterations)},
                             {"residual", found.residual},
                             {"seconds", seconds},
                             {is_heat ? "least_temperature_c" : "least_potential_v", *least},
                             {is_heat ? "greatest_temperature_c" : "greatest_potential_v", *most},
                             {is_heat ? "greatest_flux_w_mm2" : "greatest_density_a_mm2", flux[strong]},
                             {is_heat ? "enters_w" : "enters_a", enters},
                             {is_heat ? "leaves_w" : "leaves_a", leaves}});
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

std::optional<decltype(Case::made)> make_model(const FeaArguments& a, const compile::LoadedPtr& loaded,
                                               const fea::Study& study, Session& session, Diagnostics& diagnostics) {
  ProgressLine progress(session.console, a.elements == "brick" ? Counted::voxels : Counted::steps);
  if (a.elements == "brick") {
    const auto plan = plan_bricks(a, loaded, session, diagnostics);
    if (!plan) return std::nullopt;
    auto model = compile::fea_model(loaded, *plan, study, request_of(a), diagnostics, &progress, &session.stop);
    if (!model) return std::nullopt;
    return std::move(*model);
  }
  const auto options = plan_options_of(a, diagnostics);
  if (!options) return std::nullopt;
  compile::TetraRequest request;
  request.size = size_of(a);
  request.quadratic = a.elements == "tet10";
  request.by_material = !a.subdomains.empty();
  request.sections = request_of(a);
  request.seed = options->seed;
  request.memory_bytes = parse_memory(a.memory);
  request.announce = [&](const compile::TetraPlan& plan) {
    session.console.say("about " + format_rounded(plan.elements, 2) + " tetrahedra; meshing takes about " +
                        format_bytes(plan.memory_bytes));
  };
  auto made = compile::tetra_model(loaded, study, request, diagnostics, &progress, &session.stop);
  if (!made) return std::nullopt;
  return std::move(*made);
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
  if (!here.tetrahedra()) return;
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
  const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.threads);
  if (!loaded) return std::nullopt;
  auto model = make_model(a, loaded, *study, session, diagnostics);
  if (!model) return std::nullopt;
  Case here{std::move(*model), {}};
  warn_of_mesh(here, *study, diagnostics);
  const fea::ModelView view = here.view();
  const auto choose = compile::node_chooser(*loaded, view.mesh, a.threads, &session.stop);
  auto conditions = fea::conditions_of(*study, view, diagnostics, choose);
  if (!conditions) return std::nullopt;
  here.conditions = std::move(*conditions);
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

compile::FeaResults solve_case(const FeaArguments& a, const Case& here, Session& session) {
  const Stopwatch watch;
  fea::SolveOptions options;
  options.tolerance = a.tolerance;
  options.threads = a.threads;
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
  if (results.solution) tell_solution(a, session.console, model.mesh, *results.solution, watch.seconds());
  if (results.conduction) tell_conduction(a, session.console, here, *results.conduction, watch.seconds());
  return results;
}

void check_elements(const FeaArguments& a) {
  if (a.elements == "brick") {
    if (a.size > 0 || !a.size_by.empty() || !a.subdomains.empty())
      throw WrongArgument("--size, --size-by and --subdomains are of tetrahedra: add --elements tet10");
    if (a.cell.empty()) throw WrongArgument("bricks need a size: write --cell 1, or --elements tet10 --size 1.5");
    parse_voxel(a.cell, "--cell");
    return;
  }
  if (!a.cell.empty()) throw WrongArgument("--cell is of bricks; write --size 1.5");
  if (a.element != "C3D8") throw WrongArgument("--element is of bricks; tetrahedra are C3D4 or C3D10");
  if ((a.size > 0) == !a.size_by.empty())
    throw WrongArgument("tetrahedra need a size: write --size 1.5, or --size-by with --min-cell and --max-cell");
  if (!a.size_by.empty() && !(a.min_cell > 0 && a.min_cell <= a.max_cell))
    throw WrongArgument("--size-by needs --min-cell, and a --max-cell that is no less");
}

void check_memory(const FeaArguments& a, const Case& here) {
  const auto allowed = static_cast<double>(parse_memory(a.memory));
  if (const double bytes = here.solve_bytes(); a.solve && a.solver == "built-in" && bytes > allowed)
    throw Error("solving takes about " + format_bytes(bytes) + " of memory, more than the " + format_bytes(allowed) +
                " allowed; choose larger elements with " + (here.tetrahedra() ? "--size" : "--cell") +
                ", or more --memory");
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
  parse_memory(a.memory);
  a.solve = a.solve || a.rounds > 0;
  check_rounds(a);
  check_outputs(a);
  check_elements(a);
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
  app->footer(fea_footer);
  return {app, [arguments](Session& session) { return run_fea(*arguments, session); }};
}

}  // namespace ombre::cli
