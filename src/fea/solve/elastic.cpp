#include "fea/solve/elastic.h"

#include <algorithm>
#include <cmath>

#include "base/text/error.h"
#include "base/text/text.h"
#include "fea/solve/brick_operator.h"
#include "fea/solve/conjugate_gradients.h"
#include "fea/solve/strains.h"

namespace ombre::fea {
namespace {

BrickOperator operator_of(const Model& model, const Conditions& conditions, int threads) {
  std::vector<Moduli> of_sections, moduli;
  for (const Section& section : model.sections)
    of_sections.push_back(moduli_of(section.elastic.modulus_mpa, section.elastic.poissons_ratio));
  moduli.reserve(model.bricks.count());
  for (size_t n = 0; n < model.bricks.count(); ++n) {
    const Moduli& full = of_sections[model.section_of[n]];
    moduli.push_back({model.bricks.share(n) * full.shear, model.bricks.share(n) * full.bulk});
  }
  std::vector<uint8_t> free(3 * model.bricks.node_count(), 1);
  for (const Prescribed& held : conditions.displacements) free[3 * size_t{held.node} + held.axis] = 0;
  return {model.bricks, std::move(moduli), std::move(free), threads, {}, own_stiffness(model)};
}

}  // namespace

double von_mises(const std::array<double, 6>& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

Solution solve(const Model& model, const Conditions& conditions, const SolveOptions& options, Progress* progress,
               const StopFlag* stop) {
  const BrickOperator stiffness = operator_of(model, conditions, options.threads);
  Vector x(stiffness.size()), forces;
  for (const Prescribed& held : conditions.displacements) x[3 * size_t{held.node} + held.axis] = held.value;
  stiffness.all_forces(x, forces);
  Vector residual(x.size()), loads(x.size());
  for (const Prescribed& force : conditions.forces) loads[3 * size_t{force.node} + force.axis] = force.value;
  for (size_t n = 0; n < x.size(); ++n) residual[n] = stiffness.free()[n] != 0 ? loads[n] - forces[n] : 0;
  Solution solution;
  const Convergence found = Gradients(stiffness, options, progress, stop).run(std::move(residual), x);
  solution.iterations = found.iterations;
  solution.residual = found.residual;
  solution.direct = found.direct;

  stiffness.all_forces(x, forces);
  solution.energy_mj = 0.5 * dot(x, forces, options.threads);
  for (const Prescribed& held : conditions.displacements) {
    const size_t n = 3 * size_t{held.node} + held.axis;
    solution.reactions_n.push_back({held.node, held.axis, forces[n] - loads[n]});
  }
  for (size_t n = 0; n < x.size(); n += 3) solution.displacement_mm.push_back({x[n], x[n + 1], x[n + 2]});
  const auto in_middle = shape_gradients(model.bricks.size_mm, {0.5, 0.5, 0.5});
  for (size_t n = 0; n < model.bricks.count(); ++n) {
    const Fill fill = model.bricks.fill(n);
    const Moduli moduli = moduli_of(model.elastic(n).modulus_mpa, model.elastic(n).poissons_ratio);
    const auto gradients = fill == full_fill ? in_middle : shape_gradients(model.bricks.size_mm, fill_centre(fill));
    solution.strain.push_back(strain_of(model.bricks.nodes[n], gradients, x));
    solution.stress_mpa.push_back(stress_of(solution.strain.back(), moduli.shear, moduli.bulk));
  }
  return solution;
}

double solve_bytes(const Bricks& bricks) {
  // Bytes of a node: about sixteen vectors of three doubles and its place in a coarse brick. Bytes of a brick: its
  // place, nodes and moduli twice.
  return multigrid_bytes(bricks, 3, 48.0 * sizeof(double) + 24, 2.0 * (sizeof(Cell) + 32 + 8) + 100);
}

}  // namespace ombre::fea
