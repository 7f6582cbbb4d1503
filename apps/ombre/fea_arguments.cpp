#include "ombre/fea_arguments.h"

#include <algorithm>
#include <filesystem>

#include "base/text.h"
#include "ombre/checks.h"
#include "ombre/fea_rounds.h"
#include "ombre/overwrite.h"

namespace ombre::cli {
namespace {

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

void check_rounds(const FeaArguments& a) {
  if (a.rounds == 0) {
    if (!a.follow.empty())
      throw WrongArgument(spelled::option("--follow") + " is of rounds: add " + spelled::option("--rounds", "5"));
    return;
  }
  if (a.follow.empty())
    throw WrongArgument(spelled::option("--rounds") +
                        " needs the variable of the design that names the results: write " +
                        spelled::option("--follow", "moved"));
  if (std::ranges::none_of(a.outputs, [](const std::string& path) { return ending_of(path) == ".vtu"; }))
    throw WrongArgument(spelled::option("--rounds") + " needs a file for the results that the design reads: write " +
                        spelled::option("-o", "part.vtu"));
}

// The names that an output has: with rounds one for each, but for their history.
std::vector<std::string> names_of(const FeaArguments& a, const std::string& path) {
  if (a.rounds == 0 || ending_of(path) == ".csv") return {path};
  std::vector<std::string> names;
  for (int round = 1; round <= a.rounds; ++round) names.push_back(path_of_round(path, round));
  return names;
}

void check_outputs(const FeaArguments& a) {
  if (a.solver != "auto" && !a.solve)
    throw WrongArgument(spelled::option("--solver", a.solver) + " does nothing without " + spelled::option("--solve"));
  if (a.outputs.empty() && !a.solve)
    throw WrongArgument("there is nothing to do: write " + spelled::option("-o", "part.inp") + " or " +
                        spelled::option("-o", "part.vtu") + ", or " + spelled::option("--solve"));
  for (const std::string& path : a.outputs) {
    const std::string ending = ending_of(path);
    if (ending == ".csv" && a.rounds == 0)
      throw WrongArgument(spelled::option("-o", path) + " is of rounds: add " + spelled::option("--rounds", "5"));
    if (ending != ".inp" && ending != ".vtu" && ending != ".xdmf" && ending != ".csv")
      throw WrongArgument(spelled::option("-o", path) + " does not say a format; let it end in .inp, .vtu or .xdmf");
    for (const std::string& name : names_of(a, path)) {
      refuse_to_overwrite(name, a.force);
      if (ending == ".xdmf") refuse_to_overwrite(numbers_path(name), a.force);
    }
  }
}

void check_elements(const FeaArguments& a) {
  if (a.elements == "brick") {
    if (a.size > 0 || !a.size_by.empty() || !a.subdomains.empty())
      throw WrongArgument(spelled::option("--size") + ", " + spelled::option("--size-by") + " and " +
                          spelled::option("--subdomains") + " are of tetrahedra: add " +
                          spelled::option("--elements", "tet10"));
    if (a.cell.empty())
      throw WrongArgument("bricks need a size: write " + spelled::option("--cell", "1") + ", or " +
                          spelled::option("--elements", "tet10") + " " + spelled::option("--size", "1.5"));
    parse_voxel(a.cell, "--cell");
    return;
  }
  if (!a.cell.empty())
    throw WrongArgument(spelled::option("--cell") + " is of bricks; write " + spelled::option("--size", "1.5"));
  if (a.solver == "multigrid" || a.solver == "direct")
    throw WrongArgument(spelled::option("--solver", a.solver) + " is of bricks; leave it out");
  if (a.element != "C3D8")
    throw WrongArgument(spelled::option("--element") + " is of bricks; tetrahedra are C3D4 or C3D10");
  if ((a.size > 0) == !a.size_by.empty())
    throw WrongArgument("tetrahedra need a size: write " + spelled::option("--size", "1.5") + ", or " +
                        spelled::option("--size-by") + " with " + spelled::option("--min-cell") + " and " +
                        spelled::option("--max-cell"));
  if (!a.size_by.empty() && !(a.min_cell > 0 && a.min_cell <= a.max_cell))
    throw WrongArgument(spelled::option("--size-by") + " needs " + spelled::option("--min-cell") + ", and a " +
                        spelled::option("--max-cell") + " that is no less");
}

}  // namespace

std::string ending_of(const std::string& path) { return to_lower(std::filesystem::path(path).extension().string()); }

std::string numbers_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".h5").string();
}

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
  app.add_option(
         "--solver", a.solver,
         "auto (default), multigrid, direct, or calculix: the program ccx, where it is installed; with --solve.\n"
         "On bricks auto begins with multigrid, and factorises the equations (direct) where that is slow")
      ->check(one_of({"auto", "multigrid", "direct", "calculix"}))
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
  app.footer(fea_footer);
}

void check(const FeaArguments& a) {
  parse_memory(a.memory);
  check_rounds(a);
  check_outputs(a);
  check_elements(a);
}

}  // namespace ombre::cli
