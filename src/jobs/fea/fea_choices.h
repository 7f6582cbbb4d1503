// The options of finite-element models.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text/record.h"
#include "fea/files/inp_writer.h"
#include "jobs/common/job_options.h"
#include "jobs/fea/fea_job.h"
#include "jobs/fea/section_options.h"
#include "jobs/fea/tetra_job.h"

namespace ombre::compile {

// Who solves the equations, by the word of --solver.
struct SolverChoice {
  std::string name, help;
  bool is_own = true;  // CalculiX, a program, is not
};
const std::vector<SolverChoice>& solver_choices();  // the first is the default
std::string solver_help();

struct FeaChoices {
  enum class Elements : uint8_t { brick, tet4, tet10 };

  DesignOptions design;
  std::string study;
  Elements elements = Elements::brick;
  std::optional<options::Pitches> cell;
  double size_mm = 0, least_mm = 0, most_mm = 0;  // 0: not chosen
  std::string size_by, subdomains;
  std::vector<std::string> outputs;
  bool solve = false;
  std::string solver = solver_choices().front().name;
  int rounds = 0;  // 0: not chosen
  std::string follow;
  double change = 1e-3;
  SectionOptions sections;
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
               "brick (default), or tetrahedra up to the surface with linear (tet4) or\n"
               "quadratic (tet10) displacements",
               "KIND"),
        option("--cell", &F::cell, kind::voxel, "Size of bricks: one length, or x,y,z; mm", "X,Y,Z"),
        option("--size", &F::size_mm, kind::number, "Approximate length of the edges of tetrahedra; mm", "MM")
            .between(1e-6, 1e6),
        option("--size-by", &F::size_by, kind::text,
               "Size of tetrahedra by a formula in x, y, z, attributes, min_cell, max_cell and h, which is 1 for one\n"
               "material and 0 for equal shares of all",
               "FORMULA"),
        option("--min-cell", &F::least_mm, kind::number, "Least size by --size-by; mm", "MM").between(1e-6, 1e6),
        option("--max-cell", &F::most_mm, kind::number, "Greatest size by --size-by; mm", "MM").between(1e-6, 1e6),
        choice("--subdomains", &F::subdomains, {"materials"},
               "materials: borders between materials become faces of tetrahedra, each of one material", "RULE"),
        options::list("-o,--output", &F::outputs, kind::file,
                      "A file to write: .inp, .vtu, .xdmf, or .csv with --rounds; may be repeated", "FILE"),
        flag("--solve", &F::solve, "Solve for displacements, stresses and reactions"),
        choice("--solver", &F::solver, names_in(solver_choices()), solver_help(), "NAME"),
        option("--rounds", &F::rounds, kind::whole,
               "Solve again with the results of the round before in the design, at most this many times", "N")
            .between(1, 1000),
        option("--follow", &F::follow, kind::text,
               "Variable of the design that gets the file with the results of the round before; with --rounds", "NAME"),
        option("--change", &F::change, kind::number,
               "Greatest change of a fraction or an attribute at which rounds end (default 0.001)", "X")
            .between(0, 1),
        group(&F::sections),
        choice("--element", &F::brick, {"C3D8", "C3D8I", "C3D8R"}, "Bricks of a deck: C3D8 (default), C3D8I or C3D8R",
               "TYPE"),
        option("--tolerance", &F::tolerance, kind::number,
               "Greatest difference of forces and loads, as a share of the loads (default 1e-8)", "X")
            .between(1e-14, 0.1),
        option("--seed", &F::seed, kind::seed, "Seed of draw (default 0)", "N"),
        group(&F::work, WorkOptions::options("Most memory for meshing or solving (default 8G)")),
        flag("--force", &F::force, "Replace existing files")};
    return spec;
  }

  bool solves() const { return solve || rounds > 0; }
  // CalculiX is none.
  bool has_own_solver() const;
  bool chose_solver() const;  // not the default
  SizeRequest size() const;
  // Returns the options that decide the voxels of bricks, and the seed.
  SamplingOptions sampling() const;
  // Throws options::WrongValue for options that exclude each other.
  void check() const;
};

}  // namespace ombre::compile
