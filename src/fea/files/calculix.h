// CalculiX as a solver: its program runs on a deck in a folder of its own, and its results are read back.
#pragma once

#include <string>

#include "fea/files/inp_writer.h"
#include "fea/solve/conduction.h"

namespace ombre::fea {

struct CalculixOptions {
  BrickType type = BrickType::c3d8;  // of hexahedra in mechanics
  int threads = 0;                   // 0: all cores
};

// The program "ccx" of the PATH. What it gives has the same meaning as of the solvers of our own: stresses are means of
// an element's points, reactions are without loads. Throws Error, which says what the program said, when it is not
// there, does not finish or leaves results out, and Cancelled, when it is ended.
Solution solve_by_calculix(const ModelView& model, const Conditions& conditions, const CalculixOptions& options,
                           const StopFlag* stop = nullptr);
// The same of conduction.
Conduction conduct_by_calculix(const ModelView& model, const Conditions& conditions, const CalculixOptions& options,
                               const StopFlag* stop = nullptr);

// Results as CalculiX prints them.
struct PrintedResults {
  std::vector<std::array<double, 3>> displacements, forces;  // of nodes
  std::vector<double> temperatures, heat;
  std::vector<std::array<double, 6>> stresses, strains;  // means of elements: xx, yy, zz, xy, xz, yz
  std::vector<std::array<double, 3>> fluxes;
};
// Reads job.dat of so many nodes and elements; what is missing is empty. Throws Error for results of nodes or elements
// that there are not, or that are no numbers.
PrintedResults read_printed(const std::string& text, size_t nodes, size_t elements);

}  // namespace ombre::fea
