#include "jobs/fea/fea_choices.h"

#include <algorithm>

#include "base/text/file_ending.h"
#include "fea/solve/solvers.h"

namespace ombre::compile {
namespace {

using options::WrongValue;
using spelled::option;

void check_rounds(const FeaChoices& a) {
  if (a.rounds == 0) {
    if (!a.follow.empty()) throw WrongValue(option("--follow") + " is of rounds: add " + option("--rounds", "5"));
    return;
  }
  if (a.follow.empty())
    throw WrongValue(option("--rounds") + " needs the variable of the design that names the results: write " +
                     option("--follow", "moved"));
  if (std::ranges::none_of(a.outputs, [](const std::string& path) { return ending_of(path) == ".vtu"; }))
    throw WrongValue(option("--rounds") + " needs a file for the results that the design reads: write " +
                     option("-o", "part.vtu"));
}

void check_outputs(const FeaChoices& a) {
  if (a.chose_solver() && !a.solves())
    throw WrongValue(option("--solver", a.solver) + " does nothing without " + option("--solve"));
  if (a.outputs.empty() && !a.solves())
    throw WrongValue("there is nothing to do: write " + option("-o", "part.inp") + " or " + option("-o", "part.vtu") +
                     ", or " + option("--solve"));
  for (const std::string& path : a.outputs) {
    const std::string ending = ending_of(path);
    if (ending == ".csv" && a.rounds == 0)
      throw WrongValue(option("-o", path) + " is of rounds: add " + option("--rounds", "5"));
    if (ending != ".inp" && ending != ".vtu" && ending != ".xdmf" && ending != ".csv")
      throw WrongValue(option("-o", path) + " does not say a format; let it end in .inp, .vtu or .xdmf");
  }
}

void check_bricks(const FeaChoices& a) {
  if (a.size_mm > 0 || !a.size_by.empty() || !a.subdomains.empty())
    throw WrongValue(option("--size") + ", " + option("--size-by") + " and " + option("--subdomains") +
                     " are of tetrahedra: add " + option("--elements", "tet10"));
  if (!a.cell)
    throw WrongValue("bricks need a size: write " + option("--cell", "1") + ", or " + option("--elements", "tet10") +
                     " " + option("--size", "1.5"));
}

void check_tetrahedra(const FeaChoices& a) {
  if (a.sections.fill != FeaRequest::Fill::exact)
    throw WrongValue(option("--fill") + " is of bricks; tetrahedra reach up to the surface");
  if (a.cell) throw WrongValue(option("--cell") + " is of bricks; write " + option("--size", "1.5"));
  if (a.has_own_solver() && a.chose_solver())
    throw WrongValue(option("--solver", a.solver) + " is of bricks; leave it out");
  if (a.brick != fea::BrickType::c3d8)
    throw WrongValue(option("--element") + " is of bricks; tetrahedra are C3D4 or C3D10");
  if ((a.size_mm > 0) == !a.size_by.empty())
    throw WrongValue("tetrahedra need a size: write " + option("--size", "1.5") + ", or " + option("--size-by") +
                     " with " + option("--min-cell") + " and " + option("--max-cell"));
  if (!a.size_by.empty() && !(a.least_mm > 0 && a.least_mm <= a.most_mm))
    throw WrongValue(option("--size-by") + " needs " + option("--min-cell") + ", and a " + option("--max-cell") +
                     " that is no less");
}

}  // namespace

const std::vector<SolverChoice>& solver_choices() {
  static const std::vector<SolverChoice> table = [] {
    std::vector<SolverChoice> rows;
    for (const fea::Solver& own : fea::all_solvers()) rows.push_back({own.name, own.help});
    rows.push_back({"calculix", "runs the program ccx, if it is installed", false});
    return rows;
  }();
  return table;
}

std::string solver_help() {
  std::string help = "Solver, with --solve (default " + solver_choices().front().name + ")";
  for (const SolverChoice& choice : solver_choices()) help += "\n" + choice.name + ": " + choice.help;
  return help;
}

bool FeaChoices::has_own_solver() const {
  return std::ranges::find(solver_choices(), solver, &SolverChoice::name)->is_own;
}

bool FeaChoices::chose_solver() const { return solver != solver_choices().front().name; }

SizeRequest FeaChoices::size() const {
  if (size_by.empty()) return {size_mm, size_mm, ""};
  return {least_mm, most_mm, size_by};
}

SamplingOptions FeaChoices::sampling() const {
  SamplingOptions sampling;
  sampling.voxel = cell;
  sampling.rules.seed = seed;
  return sampling;
}

void FeaChoices::check() const {
  check_rounds(*this);
  check_outputs(*this);
  if (elements == Elements::brick)
    check_bricks(*this);
  else
    check_tetrahedra(*this);
}

}  // namespace ombre::compile
