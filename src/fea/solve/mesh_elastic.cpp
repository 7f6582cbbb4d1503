#include "fea/solve/mesh_elastic.h"

#include "base/text/error.h"
#include "base/text/text.h"
#include "fea/solve/node_matrix.h"
#include "fea/solve/strains.h"

namespace ombre::fea {
namespace {

struct LameModuli {
  double shear = 0, bulk = 0;  // MPa
};

LameModuli lame_moduli(const Elastic& elastic) {
  const double e = elastic.modulus_mpa, nu = elastic.poissons_ratio;
  return {e / (2 * (1 + nu)), e / (3 * (1 - 2 * nu))};
}

// Adds a times the outer product of two vectors to block.
void add_outer(double a, Vec3 row, Vec3 column, NodeBlock& block) {
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) block[3 * i + j] += a * row[static_cast<int>(i)] * column[static_cast<int>(j)];
}

// Adds the stiffness between node a and all nodes. The shear part at each point has no change of volume; hexahedra have
// the mean change of volume.
void add_stiffness(const LameModuli& moduli, bool has_mean_volume, const ElementPoints& points, size_t node_count,
                   size_t a, std::array<NodeBlock, 10>& blocks) {
  std::array<Vec3, 10> means{};
  double volume = 0;
  for (size_t p = 0; p < points.count; ++p) {
    const ElementPoint& point = points.points[p];
    const double shear = moduli.shear * point.volume_mm3;
    const double lambda = has_mean_volume ? -2 * shear / 3 : moduli.bulk * point.volume_mm3 - 2 * shear / 3;
    volume += point.volume_mm3;
    for (size_t b = 0; b < node_count; ++b) {
      const Vec3 of_a = point.gradients[a], of_b = point.gradients[b];
      add_outer(lambda, of_a, of_b, blocks[b]);
      add_outer(shear, of_b, of_a, blocks[b]);
      const double even = shear * dot(of_a, of_b);
      for (size_t i = 0; i < 3; ++i) blocks[b][4 * i] += even;
      means[b] = means[b] + point.volume_mm3 * of_b;
    }
  }
  if (!has_mean_volume) return;
  for (size_t b = 0; b < node_count; ++b) add_outer(moduli.bulk / volume, means[a], means[b], blocks[b]);
}

}  // namespace

Solution solve_mesh(const ModelView& model, const Conditions& conditions, const SolveOptions& options,
                    Progress* progress, const StopFlag* stop) {
  refuse_inverted(model.mesh);
  std::vector<LameModuli> moduli;
  for (const Section& section : model.sections) moduli.push_back(lame_moduli(section.elastic));
  const MeshView& mesh = model.mesh;
  const bool has_mean_volume = mesh.kind() == ElementKind::c3d8;
  const ElementRow row = [&](size_t element, const ElementPoints& points, size_t a, std::array<NodeBlock, 10>& blocks) {
    add_stiffness(moduli[model.section_of[element]], has_mean_volume, points, mesh.shape().nodes, a, blocks);
  };
  const size_t size = 3 * mesh.node_count();
  LinearSystem system{mesh, 3, row, std::vector<uint8_t>(size, 1), {}, options.threads};
  std::vector<double> x(size), loads(size);
  for (const Prescribed& held : conditions.displacements) {
    system.free[3 * size_t{held.node} + held.axis] = 0;
    x[3 * size_t{held.node} + held.axis] = held.value;
  }
  for (const Prescribed& force : conditions.forces) loads[3 * size_t{force.node} + force.axis] = force.value;
  std::vector<double> forces = product(system, x), right(size);
  for (size_t n = 0; n < size; ++n) right[n] = loads[n] - forces[n];
  LinearReport report;
  const std::vector<double> more =
      solve_system(system, right, {options.tolerance, options.most_iterations}, report, progress, stop);
  for (size_t n = 0; n < size; ++n)
    if (system.free[n] != 0) x[n] = more[n];

  Solution solution;
  solution.iterations = report.iterations;
  solution.residual = report.residual;
  forces = product(system, x);
  for (size_t n = 0; n < size; ++n) solution.energy_mj += 0.5 * x[n] * forces[n];
  for (const Prescribed& held : conditions.displacements) {
    const size_t n = 3 * size_t{held.node} + held.axis;
    solution.reactions_n.push_back({held.node, held.axis, forces[n] - loads[n]});
  }
  for (size_t n = 0; n < size; n += 3) solution.displacement_mm.push_back({x[n], x[n + 1], x[n + 2]});
  for (size_t element = 0; element < mesh.count(); ++element) {
    const LameModuli& own = moduli[model.section_of[element]];
    solution.strain.push_back(strain_of(mesh.nodes(element), middle_point(mesh, element).gradients, x));
    solution.stress_mpa.push_back(stress_of(solution.strain.back(), own.shear, own.bulk));
  }
  return solution;
}

}  // namespace ombre::fea
