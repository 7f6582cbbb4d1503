// Uses CalculiX as a solver: its program runs on a deck in a folder of its own, and its results are read back.
#pragma once

#include <string>

#include "fea/files/inp_writer.h"
#include "fea/solve/conduction.h"

namespace ombre::fea {

struct CalculixOptions {
  BrickType type = BrickType::c3d8;  // kind of hexahedra in mechanics
  int threads = 0;                   // 0: all cores
};

// Solves by the program "ccx" of the PATH. Results have the same meaning as those of the built-in solvers: stresses are
// means over an element's points, reactions are without loads. Throws Error with the program's own words if it is
// missing, does not finish or leaves results out, and Cancelled if it is stopped.
Solution solve_by_calculix(const ModelView& model, const Conditions& conditions, const CalculixOptions& options,
                           const StopFlag* stop = nullptr);
// Solves conduction by the program "ccx", with the same errors.
Conduction conduct_by_calculix(const ModelView& model, const Conditions& conditions, const CalculixOptions& options,
                               const StopFlag* stop = nullptr);

// Results as CalculiX prints them.
struct PrintedResults {
  std::vector<std::array<double, 3>> displacements, forces;  // values of nodes
  std::vector<double> temperatures, heat;
  std::vector<std::array<double, 6>> stresses, strains;  // means over each element: xx, yy, zz, xy, xz, yz
  std::vector<std::array<double, 3>> fluxes;
};
// Reads job.dat for a mesh with these numbers of nodes and elements; missing results are empty. Throws Error for
// results of nodes or elements that do not exist, or that are not numbers.
PrintedResults read_printed(const std::string& text, size_t nodes, size_t elements);

}  // namespace ombre::fea
