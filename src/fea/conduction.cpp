#include "fea/conduction.h"

#include "fea/node_matrix.h"

namespace ombre::fea {
namespace {

constexpr double per_mm_of_per_m = 1e-3, per_mm2_of_per_m2 = 1e-6;

// W/K that each node of a film's side loses.
std::vector<double> film_shares(const MeshView& mesh, const Film& film) {
  const double all = film.coefficient_w_m2k * per_mm2_of_per_m2 * length(side_area(mesh, film.side));
  std::vector<double> shares = side_shares(mesh.shape());
  for (double& share : shares) share *= all;
  return shares;
}

}  // namespace

Conduction conduct(const ModelView& model, const Conditions& conditions, const SolveOptions& options,
                   Progress* progress, const StopFlag* stop) {
  refuse_inverted(model.mesh);
  const MeshView& mesh = model.mesh;
  const ElementRow row = [&](size_t element, const ElementPoints& points, size_t a, std::array<NodeBlock, 10>& blocks) {
    const double conductivity = model.section(element).conductivity * per_mm_of_per_m;
    for (size_t p = 0; p < points.count; ++p) {
      const ElementPoint& point = points.points[p];
      for (size_t b = 0; b < mesh.shape().nodes; ++b)
        blocks[b][0] += conductivity * point.volume_mm3 * dot(point.gradients[a], point.gradients[b]);
    }
  };
  const size_t size = mesh.node_count();
  LinearSystem system{mesh, 1, row, std::vector<uint8_t>(size, 1), {}, options.threads};
  std::vector<double> flows(size), from_films(size);
  for (const Prescribed& flow : conditions.forces) flows[flow.node] = flow.value;
  if (!conditions.films.empty()) system.more_diagonal.resize(size);
  for (const Film& film : conditions.films) {
    const std::vector<double> shares = film_shares(mesh, film);
    const std::vector<uint32_t> nodes = side_nodes(mesh, film.side);
    for (size_t n = 0; n < nodes.size(); ++n) {
      system.more_diagonal[nodes[n]] += shares[n];
      from_films[nodes[n]] += shares[n] * film.ambient_c;
    }
  }
  Conduction found;
  found.value.resize(size);
  for (const Prescribed& held : conditions.displacements) {
    system.free[held.node] = 0;
    found.value[held.node] = held.value;
  }
  std::vector<double> carried = product(system, found.value), right(size);
  for (size_t n = 0; n < size; ++n) right[n] = flows[n] + from_films[n] - carried[n];
  LinearReport report;
  const std::vector<double> more =
      solve_system(system, right, {options.tolerance, options.most_iterations}, report, progress, stop);
  for (size_t n = 0; n < size; ++n)
    if (system.free[n] != 0) found.value[n] = more[n];
  found.iterations = report.iterations;
  found.residual = report.residual;

  carried = product(system, found.value);
  for (const Prescribed& held : conditions.displacements)
    found.flows.push_back({held.node, 0, carried[held.node] - flows[held.node] - from_films[held.node]});
  for (size_t n = 0; n < system.more_diagonal.size(); ++n)
    found.lost_w += system.more_diagonal[n] * found.value[n] - from_films[n];
  for (size_t element = 0; element < mesh.count(); ++element) {
    const ElementPoint middle = middle_point(mesh, element);
    const auto nodes = mesh.nodes(element);
    Vec3 gradient;
    for (size_t n = 0; n < nodes.size(); ++n) gradient = gradient + found.value[nodes[n]] * middle.gradients[n];
    found.flux.push_back(-(model.section(element).conductivity * per_mm_of_per_m) * gradient);
  }
  return found;
}

}  // namespace ombre::fea
