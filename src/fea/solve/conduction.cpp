#include "fea/solve/conduction.h"

#include "fea/solve/conjugate_gradients.h"
#include "fea/solve/node_matrix.h"

namespace ombre::fea {
namespace {

constexpr double per_mm_of_per_m = 1e-3, per_mm2_of_per_m2 = 1e-6;

// Returns the W/K that each node of a film's side loses.
std::vector<NodeShare> film_shares(const MeshView& mesh, const Film& film) {
  std::vector<NodeShare> shares = side_shares(mesh, film.side);
  for (NodeShare& here : shares) here.share *= film.coefficient_w_m2k * per_mm2_of_per_m2;
  return shares;
}

// Flows into nodes, prescribed values, and films.
struct Setup {
  std::vector<uint8_t> free;
  Vector flows, from_films, film_diagonal;  // the last is empty without films

  Setup(const MeshView& mesh, const Conditions& conditions)
      : free(mesh.node_count(), 1), flows(mesh.node_count()), from_films(mesh.node_count()) {
    for (const Prescribed& held : conditions.displacements) free[held.node] = 0;
    for (const Prescribed& flow : conditions.forces) flows[flow.node] = flow.value;
    if (!conditions.films.empty()) film_diagonal.resize(mesh.node_count());
    for (const Film& film : conditions.films)
      for (const NodeShare& here : film_shares(mesh, film)) {
        film_diagonal[here.node] += here.share;
        from_films[here.node] += here.share * film.ambient_c;
      }
  }
};

// Finds the values at all nodes by a solver that offers two functions: the flows of given values, and the values of
// free nodes for given flows.
template <class Solver>
Conduction solve_with(Solver& solver, const Setup& setup, const ModelView& model, const Conditions& conditions) {
  const MeshView& mesh = model.mesh;
  const size_t size = mesh.node_count();
  Conduction found;
  found.value.resize(size);
  for (const Prescribed& held : conditions.displacements) found.value[held.node] = held.value;
  Vector carried = solver.flows_of(found.value), right(size);
  for (size_t n = 0; n < size; ++n) right[n] = setup.flows[n] + setup.from_films[n] - carried[n];
  const Vector more = solver.solve(std::move(right), found);
  for (size_t n = 0; n < size; ++n)
    if (setup.free[n] != 0) found.value[n] = more[n];

  carried = solver.flows_of(found.value);
  for (const Prescribed& held : conditions.displacements)
    found.flows.push_back({held.node, 0, carried[held.node] - setup.flows[held.node] - setup.from_films[held.node]});
  for (size_t n = 0; n < setup.film_diagonal.size(); ++n)
    found.lost_w += setup.film_diagonal[n] * found.value[n] - setup.from_films[n];
  for (size_t element = 0; element < mesh.count(); ++element) {
    const ElementPoint middle = middle_point(mesh, element);
    const auto nodes = mesh.nodes(element);
    Vec3 gradient;
    for (size_t n = 0; n < nodes.size(); ++n) gradient = gradient + found.value[nodes[n]] * middle.gradients[n];
    found.flux.push_back(-(model.section(element).conductivity * per_mm_of_per_m) * gradient);
  }
  return found;
}

struct AssembledSolver {
  LinearSystem system;
  const SolveOptions& options;
  Progress* progress;
  const StopFlag* stop;

  Vector flows_of(const Vector& values) const { return product(system, values); }
  Vector solve(Vector right, Conduction& found) const {
    LinearReport report;
    Vector values = solve_system(system, right, {options.tolerance, options.most_iterations}, report, progress, stop);
    found.iterations = report.iterations;
    found.residual = report.residual;
    return values;
  }
};

struct BrickSolver {
  BrickOperator conductance;
  const SolveOptions& options;
  Progress* progress;
  const StopFlag* stop;

  Vector flows_of(const Vector& values) const {
    Vector flows;
    conductance.all_forces(values, flows);
    return flows;
  }
  Vector solve(Vector right, Conduction& found) const {
    for (size_t n = 0; n < right.size(); ++n)
      if (conductance.free()[n] == 0) right[n] = 0;
    Vector values(right.size());
    const Convergence reached = Gradients(conductance, options, progress, stop).run(std::move(right), values);
    found.iterations = reached.iterations;
    found.residual = reached.residual;
    found.direct = reached.direct;
    return values;
  }
};

BrickOperator conductance_of(const ModelView& model, const Setup& setup, int threads) {
  const Bricks& bricks = *model.mesh.bricks();
  std::vector<Moduli> conductivities;
  conductivities.reserve(model.mesh.count());
  for (size_t brick = 0; brick < model.mesh.count(); ++brick)
    conductivities.push_back({bricks.share(brick) * model.section(brick).conductivity * per_mm_of_per_m, 0});
  return {
      bricks,  std::move(conductivities), setup.free,
      threads, setup.film_diagonal,       own_conductance(bricks, model.sections, model.section_of, per_mm_of_per_m)};
}

}  // namespace

Conduction conduct(const ModelView& model, const Conditions& conditions, const SolveOptions& options,
                   Progress* progress, const StopFlag* stop) {
  const MeshView& mesh = model.mesh;
  const Setup setup(mesh, conditions);
  if (mesh.bricks()) {
    BrickSolver solver{conductance_of(model, setup, options.threads), options, progress, stop};
    return solve_with(solver, setup, model, conditions);
  }
  refuse_inverted(mesh);
  const ElementRow row = [&](size_t element, const ElementPoints& points, size_t a, std::array<NodeBlock, 10>& blocks) {
    const double conductivity = model.section(element).conductivity * per_mm_of_per_m;
    for (size_t p = 0; p < points.count; ++p) {
      const ElementPoint& point = points.points[p];
      for (size_t b = 0; b < mesh.shape().nodes; ++b)
        blocks[b][0] += conductivity * point.volume_mm3 * dot(point.gradients[a], point.gradients[b]);
    }
  };
  AssembledSolver solver{{mesh, 1, row, setup.free, setup.film_diagonal, options.threads}, options, progress, stop};
  return solve_with(solver, setup, model, conditions);
}

double conduct_bytes(const Bricks& bricks) {
  // Bytes of a node: about twenty vectors and its place in a coarse brick. Bytes of a brick: its place, nodes and
  // moduli twice, and its flux.
  return multigrid_bytes(bricks, 1, 20.0 * sizeof(double) + 24, 2.0 * (sizeof(Cell) + 32 + 8) + 24);
}

}  // namespace ombre::fea
