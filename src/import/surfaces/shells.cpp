// The closed shells of a mesh and their orientation.
#include "import/surfaces/shells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "base/math/box.h"
#include "base/math/disjoint_sets.h"
#include "import/surfaces/point_winding.h"

namespace ombre::importing {
namespace {

// Joins the sets whose triangles are not closed at this edge by themselves.
void join_open(std::span<const FacetEdge> edge, DisjointSets& sets) {
  std::map<uint32_t, int64_t> balances;
  for (const FacetEdge& side : edge) balances[sets.root(side.triangle)] += side.direction();
  const uint32_t* first = nullptr;
  for (const auto& [root, balance] : balances) {
    if (balance == 0) continue;
    if (first) sets.join(*first, root);
    if (!first) first = &root;
  }
}

struct Shell {
  std::vector<uint32_t> triangles;
  Box box;
  Vec3 middle;  // mean of its corners
  double volume = 0;
};

class ShellTurner {
 public:
  explicit ShellTurner(formats::Mesh& mesh) : mesh_(mesh), placed_(placed_triangles(mesh)) { find_shells(); }

  TurnedShells turn() {
    TurnedShells result{0, shells_.size()};
    std::vector<bool> turns(shells_.size());
    for (uint32_t n = 0; n < shells_.size(); ++n)
      if (shells_[n].volume < 0 && is_outermost(n) && overlaps_outward(n)) turns[n] = true;
    const std::vector<bool> roots = turns;
    for (uint32_t n = 0; n < shells_.size(); ++n)
      if (!roots[n] && lies_only_in(roots, n)) turns[n] = true;
    for (uint32_t n = 0; n < shells_.size(); ++n)
      if (turns[n]) turn_round(shells_[n]);
    result.turned = static_cast<size_t>(std::count(roots.begin(), roots.end(), true));
    return result;
  }

 private:
  void find_shells() {
    const std::vector<FacetEdge> edges = sorted_edges(placed_.triangles);
    const std::vector<uint32_t> shell_of = shells_of(placed_.triangles.size(), edges);
    for (uint32_t t = 0; t < shell_of.size(); ++t) {
      if (shell_of[t] >= shells_.size()) shells_.resize(shell_of[t] + 1);
      shells_[shell_of[t]].triangles.push_back(t);
    }
    for (Shell& shell : shells_) measure(shell);
    windings_.resize(shells_.size());
  }

  // Measures relative to the first corner, which keeps precision for meshes far from the origin.
  void measure(Shell& shell) const {
    const Vec3 origin = placed_.places[placed_.triangles[shell.triangles[0]][0]];
    Vec3 sum;
    for (const uint32_t t : shell.triangles) {
      std::array<Vec3, 3> corners;
      for (size_t i = 0; i < 3; ++i) {
        const Vec3 p = placed_.places[placed_.triangles[t][i]];
        shell.box = hull(shell.box, Box{p, p});
        corners[i] = p - origin;
        sum = sum + corners[i];
      }
      shell.volume += dot(corners[0], cross(corners[1], corners[2])) / 6;
    }
    // The volume of a flat shell is set to 0, because only rounding differs from that.
    constexpr double rounding = 1e-12;
    const Vec3 size = shell.box.size();
    if (std::abs(shell.volume) <= rounding * size.x * size.y * size.z) shell.volume = 0;
    shell.middle = origin + (1.0 / static_cast<double>(3 * shell.triangles.size())) * sum;
  }

  static bool overlap(const Box& a, const Box& b) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(a.lo[axis] < b.hi[axis] && b.lo[axis] < a.hi[axis])) return false;
    return true;
  }

  static bool contains(const Box& outer, const Box& inner) {
    return outer.contains(inner.lo) && outer.contains(inner.hi);
  }

  const PointWinding& winding(uint32_t n) {
    if (windings_[n]) return *windings_[n];
    auto surface = std::make_shared<Surface>();
    for (const uint32_t t : shells_[n].triangles) {
      const auto first = static_cast<uint32_t>(surface->vertices.size());
      for (const uint32_t corner : placed_.triangles[t]) surface->vertices.push_back(placed_.places[corner]);
      surface->triangles.push_back({first, first + 1, first + 2});
    }
    windings_[n] = std::make_unique<PointWinding>(surface);
    return *windings_[n];
  }

  // Returns true if the inner shell lies in the outer one. Corners are moved slightly towards the middle of their
  // shell, so that those on the outer shell count as inside.
  bool lies_in(uint32_t inner, uint32_t outer) {
    constexpr double nearer = 1e-6;
    const Shell& shell = shells_[inner];
    if (inner == outer || !contains(shells_[outer].box, shell.box)) return false;
    const PointWinding& around = winding(outer);
    for (const uint32_t t : shell.triangles)
      for (const uint32_t corner : placed_.triangles[t]) {
        const Vec3 p = placed_.places[corner];
        if (around.at(p + nearer * (shell.middle - p)) == 0) return false;
      }
    return true;
  }

  bool is_outermost(uint32_t n) {
    for (uint32_t other = 0; other < shells_.size(); ++other)
      if (lies_in(n, other)) return false;
    return true;
  }

  bool overlaps_outward(uint32_t n) {
    for (uint32_t other = 0; other < shells_.size(); ++other)
      if (shells_[other].volume > 0 && overlap(shells_[n].box, shells_[other].box) && !lies_in(other, n)) return true;
    return false;
  }

  // Returns true if the shell lies in at least one of the marked shells, and in no other.
  bool lies_only_in(const std::vector<bool>& flags, uint32_t n) {
    bool lies_in_flagged = false;
    for (uint32_t other = 0; other < shells_.size(); ++other)
      if (flags[other] && lies_in(n, other)) lies_in_flagged = true;
    if (!lies_in_flagged) return false;
    for (uint32_t other = 0; other < shells_.size(); ++other)
      if (!flags[other] && shells_[other].volume > 0 && lies_in(n, other)) return false;
    return true;
  }

  void turn_round(const Shell& shell) {
    for (const uint32_t t : shell.triangles) {
      std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
      if (!mesh_.texture_triangles.empty()) std::swap(mesh_.texture_triangles[t][1], mesh_.texture_triangles[t][2]);
    }
  }

  formats::Mesh& mesh_;
  PlacedTriangles placed_;
  std::vector<Shell> shells_;
  std::vector<std::unique_ptr<PointWinding>> windings_;  // built on demand
};

}  // namespace

std::vector<uint32_t> shells_of(size_t triangles, std::span<const FacetEdge> edges) {
  DisjointSets sets(triangles);
  for_each_edge(edges, [&](std::span<const FacetEdge> edge) {
    if (edge.size() == 2) sets.join(edge[0].triangle, edge[1].triangle);
  });
  for_each_edge(edges, [&](std::span<const FacetEdge> edge) {
    if (edge.size() > 2) join_open(edge, sets);
  });
  std::vector<uint32_t> shell_of(triangles);
  uint32_t count = 0;
  // The root of a shell is its triangle with the lowest number.
  for (uint32_t t = 0; t < triangles; ++t) shell_of[t] = sets.root(t) == t ? count++ : shell_of[sets.root(t)];
  return shell_of;
}

TurnedShells turn_inverted_shells(formats::Mesh& mesh) { return ShellTurner(mesh).turn(); }

}  // namespace ombre::importing
