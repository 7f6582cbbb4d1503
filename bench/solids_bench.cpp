// Times operations on polyhedra: bench_solids [threads]. Beside it bench_corefinement times the library alone.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "base/system/stopwatch.h"
#include "solids/evaluate_tree.h"
#include "solids/kernel.h"

namespace {

using namespace ombre;
using namespace ombre::solids;
using Children = std::vector<TreePtr>;

TreePtr node(Operation operation, Children children = {}) {
  auto tree = std::make_shared<Tree>();
  tree->operation = std::move(operation);
  tree->children = std::move(children);
  return tree;
}

TreePtr moved(Vec3 by, TreePtr child) { return node(Transform{Affine::translation(by)}, {std::move(child)}); }
TreePtr sphere(double radius, double edges) { return node(Sphere{radius, {edges}}); }

// A ball of radius 10 less ten of radius 3 around it on a spiral.
TreePtr ball_minus_ten(double edges) {
  Children children{sphere(10, edges)};
  for (int n = 0; n < 10; ++n)
    children.push_back(moved({9 * std::cos(0.7 * n), 9 * std::sin(0.7 * n), n - 4.5}, sphere(3, edges)));
  return node(Difference{}, std::move(children));
}

TreePtr plate() {
  Children holes;
  for (int n = 0; n < 300; ++n)
    holes.push_back(moved({2.0 + 4 * (n % 20), 2.0 + 4 * (n / 20), -1}, node(Cylinder{5, 1.5, 1.5, false, {30}})));
  return node(Difference{}, {node(Cube{{80, 60, 3}}), node(Union{}, std::move(holes))});
}

TreePtr rounded() { return node(Minkowski{}, {node(Cube{{30, 20, 10}}), sphere(2, 100)}); }

TreePtr concave_sum() {
  const TreePtr corner = node(Difference{}, {node(Cube{{9, 9, 9}}), moved({1, 1, 1}, node(Cube{{9, 9, 9}}))});
  return node(Minkowski{}, {corner, sphere(0.5, 16)});
}

void time(const char* name, const TreePtr& tree, int threads) {
  EvaluateOptions options;
  options.threads = threads;
  Diagnostics messages;
  const Stopwatch watch;
  const Pieces pieces = evaluate(tree, options, messages);
  double volume = 0;
  size_t triangles = 0;
  for (const Piece& piece : pieces)
    if (piece.solid()) {
      volume += volume_of(piece.solid()->mesh());
      triangles += piece.solid()->mesh().triangles.size();
    }
  std::printf("%-28s %7.3f s  %8zu triangles  %.6f mm3\n", name, watch.seconds(), triangles, volume);
  if (messages.has_errors()) std::printf("%s", to_text(messages).c_str());
}

}  // namespace

int main(int count, char** arguments) {
  const int threads = count > 1 ? std::atoi(arguments[1]) : 0;
  kernel();  // loading it is not timed
  time("ball less ten, $fn=40", ball_minus_ten(40), threads);
  time("ball less ten, $fn=100", ball_minus_ten(100), threads);
  time("plate with 300 holes", plate(), threads);
  time("minkowski of 10,000 facets", rounded(), threads);
  time("minkowski, concave", concave_sum(), threads);
}
