// The options of finite-element models.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text/record.h"
#include "fea/files/inp_writer.h"
#include "jobs/common/job_options.h"
#include "jobs/fea/fea_job.h"
#include "jobs/fea/tetra_job.h"

namespace ombre::compile {

// Who solves the equations, by the word of --solver.
struct SolverChoice {
  std::string name;
  std::optional<fea::Solver> own;  // CalculiX, a program, is none
};
const std::vector<SolverChoice>& solver_choices();  // the first is the default

struct FeaChoices {
  enum class Elements : uint8_t { brick, tet4, tet10 };

  DesignOptions design;
  std::string study;
  Elements elements = Elements::brick;
  std::optional<options::Pitches> cell;
  FeaRequest::Fill fill = FeaRequest::Fill::exact;
  double size_mm = 0, least_mm = 0, most_mm = 0;  // 0: not chosen
  std::string size_by, subdomains;
  std::vector<std::string> outputs;
  bool solve = false;
  std::string solver = solver_choices().front().name;
  int rounds = 0;  // 0: not chosen
  std::string follow;
  double change = 1e-3;
  FeaRequest::Assign assign = FeaRequest::Assign::draw;
  std::string modulus, conductivity;
  int sections = 64;
  fea::BrickType brick = fea::BrickType::c3d8;
  double tolerance = 1e-8;
  uint64_t seed = 0;
  WorkOptions work{0, 4 * usual_memory};
  bool force = false;

  static const options::Spec<FeaChoices>& options() {
    using namespace options;
    using F = FeaChoices;
    static const options::Spec<F> spec{
        group(&F::design),
        option("--study", &F::study, kind::file, "The study: properties, supports and loads; a .json file", "FILE")
            .required(),
        choice("--elements", &F::elements, {"brick", "tet4", "tet10"},
               "brick (default), or up to the surface tet4 or tet10: tetrahedra with\n"
               "linear or quadratic displacements",
               "KIND"),
        option("--cell", &F::cell, kind::voxel, "Size of bricks: one length, or x,y,z; mm", "X,Y,Z"),
        choice("--fill", &F::fill, {"exact", "centre"},
               "exact (default): a brick is stiff and heavy by what of it is inside; centre: whole if its centre is "
               "inside",
               "RULE"),
        option("--size", &F::size_mm, kind::number, "About the length of edges of tetrahedra; mm", "MM")
            .between(1e-6, 1e6),
        option("--size-by", &F::size_by, kind::text,
               "The same by a formula over x, y, z, attributes, min_cell, max_cell and h, which is 1 where there is "
               "one\nmaterial and 0 in an even mixture of all",
               "FORMULA"),
        option("--min-cell", &F::least_mm, kind::number, "The least that --size-by may give; mm", "MM")
            .between(1e-6, 1e6),
        option("--max-cell", &F::most_mm, kind::number, "The most that --size-by may give; mm", "MM")
            .between(1e-6, 1e6),
        choice("--subdomains", &F::subdomains, {"materials"},
               "materials: borders between materials become faces of tetrahedra, each of one material", "RULE"),
        options::list("-o,--output", &F::outputs, kind::file,
                      "A file to write, .inp, .vtu, .xdmf or, of rounds, .csv; may be repeated", "FILE"),
        flag("--solve", &F::solve, "Solve it: displacements, stresses, reactions"),
        choice("--solver", &F::solver, names_in(solver_choices()),
               "auto (default), multigrid, direct, or calculix: the program ccx, where it is installed; with "
               "--solve.\nOn bricks auto begins with multigrid, and factorises the equations (direct) where that is "
               "slow",
               "NAME"),
        option("--rounds", &F::rounds, kind::whole,
               "Solve, hand the results to the design, and again: at most so many times", "N")
            .between(1, 1000),
        option("--follow", &F::follow, kind::text,
               "Of rounds: the variable of the design that names the file with the results", "NAME"),
        option("--change", &F::change, kind::number,
               "Of rounds: the greatest change of a fraction or an attribute that counts as none (default 0.001)", "X")
            .between(0, 1),
        choice("--assign", &F::assign, {"draw", "mix"},
               "What an element of a mixture is made of: draw (default: one material, by the odds of its fractions)\n"
               "or mix (mean properties)",
               "RULE"),
        option("--modulus", &F::modulus, kind::text, "An attribute of the design that is Young's modulus in MPa",
               "NAME"),
        option("--conductivity", &F::conductivity, kind::text,
               "In conduction: an attribute that is the conductivity in W/(m K) or S/m", "NAME"),
        option("--sections", &F::sections, kind::whole,
               "With mix, --modulus or --conductivity: into how many sections elements are gathered (default 64)", "N")
            .between(1, 60000),
        choice("--element", &F::brick, {"C3D8", "C3D8I", "C3D8R"}, "Bricks of a deck: C3D8 (default), C3D8I or C3D8R",
               "TYPE"),
        option("--tolerance", &F::tolerance, kind::number,
               "How near the forces must come to the loads, as a share (default 1e-8)", "X")
            .between(1e-14, 0.1),
        option("--seed", &F::seed, kind::seed, "Seed of draw (default 0)", "N"),
        group(&F::work, WorkOptions::options("Most memory for meshing or solving (default 8G)")),
        flag("--force", &F::force, "Replace files that are there")};
    return spec;
  }

  bool solves() const { return solve || rounds > 0; }
  // CalculiX is none.
  std::optional<fea::Solver> own_solver() const;
  SizeRequest size() const;
  FeaRequest request() const;
  // On which voxels bricks are, and the seed.
  SamplingOptions sampling() const;
  // Throws options::WrongValue for what does not go together.
  void check() const;
};

}  // namespace ombre::compile
