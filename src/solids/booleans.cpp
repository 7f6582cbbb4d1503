#include "solids/booleans.h"

#include <algorithm>
#include <numeric>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "solids/kernel.h"

namespace ombre::solids {
namespace {

Solid nothing() { return Solid(TriangleMesh{}); }

bool meet(const Box& a, const Box& b) { return !intersect(a, b).is_empty(); }

// Groups solids that are connected by boxes that meet; a group is known by the number of its first solid.
class Clusters {
 public:
  explicit Clusters(const std::vector<Solid>& solids) : first_(solids.size()) {
    std::iota(first_.begin(), first_.end(), size_t{0});
    std::vector<size_t> order = first_;
    const auto left = [&](size_t n) { return solids[n].bounds().lo.x; };
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return left(a) < left(b); });
    std::vector<size_t> open;
    for (const size_t n : order) {
      std::erase_if(open, [&](size_t other) { return solids[other].bounds().hi.x < left(n); });
      for (const size_t other : open)
        if (meet(solids[other].bounds(), solids[n].bounds())) join(other, n);
      open.push_back(n);
    }
  }

  size_t first(size_t n) {
    while (first_[n] != n) n = first_[n] = first_[first_[n]];
    return n;
  }

 private:
  void join(size_t a, size_t b) {
    a = first(a);
    b = first(b);
    first_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<size_t> first_;
};

BodyPtr united_pair(const BodyPtr& a, const BodyPtr& b) {
  if (meet(a->bounds(), b->bounds())) return kernel().combine(Boolean::unite, *a, *b);
  const std::array<BodyPtr, 2> both{a, b};
  return kernel().gathered(both);
}

// Unites the bodies of one group.
BodyPtr united(std::vector<BodyPtr> bodies, const Work& work) {
  while (bodies.size() > 1) {
    std::vector<BodyPtr> pairs((bodies.size() + 1) / 2);
    run_parallel(pairs.size(), work.threads, [&](size_t n) {
      work.check();
      const bool is_pair = 2 * n + 1 < bodies.size();
      pairs[n] = is_pair ? united_pair(bodies[2 * n], bodies[2 * n + 1]) : bodies[2 * n];
    });
    bodies = std::move(pairs);
  }
  return bodies[0];
}

// Returns the meshes as one, side by side.
Solid gathered(const std::vector<Solid>& solids) {
  TriangleMesh all;
  Flaw flaw = Flaw::none;
  for (const Solid& solid : solids) {
    flaw = std::max(flaw, solid.flaw());
    const TriangleMesh& mesh = solid.mesh();
    const auto first = static_cast<uint32_t>(all.points.size());
    all.points.insert(all.points.end(), mesh.points.begin(), mesh.points.end());
    for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }
  return Solid(std::move(all), flaw);
}

Solid side_by_side(std::vector<Solid> solids) {
  if (solids.size() == 1) return solids[0];
  if (std::none_of(solids.begin(), solids.end(), [](const Solid& solid) { return solid.is_exact(); }))
    return gathered(solids);
  std::vector<BodyPtr> bodies;
  for (const Solid& solid : solids) bodies.push_back(solid.body());
  return Solid(kernel().gathered(bodies));
}

std::vector<Vec3> sums(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Vec3> result;
  result.reserve(a.points.size() * b.points.size());
  for (const Vec3& p : a.points)
    for (const Vec3& q : b.points) result.push_back(p + q);
  return result;
}

std::vector<TriangleMesh> convex_parts(const Solid& solid) {
  if (kernel().is_convex(*solid.body())) return {solid.mesh()};
  return kernel().convex_parts(*solid.body());
}

}  // namespace

void Work::check() const {
  if (stop && stop->requested()) throw Cancelled();
}

Solid unite(std::vector<Solid> solids, const Work& work) {
  std::erase_if(solids, [](const Solid& solid) { return solid.is_empty(); });
  if (solids.empty()) return nothing();
  if (solids.size() == 1) return solids[0];
  Clusters clusters(solids);
  std::vector<Solid> results;
  for (size_t first = 0; first < solids.size(); ++first) {
    if (clusters.first(first) != first) continue;
    std::vector<Solid> members;
    for (size_t n = first; n < solids.size(); ++n)
      if (clusters.first(n) == first) members.push_back(solids[n]);
    if (members.size() == 1) {
      results.push_back(members[0]);
      continue;
    }
    std::vector<BodyPtr> bodies(members.size());
    run_parallel(members.size(), work.threads, [&](size_t n) { bodies[n] = members[n].body(); });
    results.emplace_back(united(std::move(bodies), work));
  }
  return side_by_side(std::move(results));
}

Solid intersect(const std::vector<Solid>& solids, const Work& work) {
  Solid result = solids.at(0);
  for (size_t n = 1; n < solids.size(); ++n) {
    work.check();
    if (result.is_empty() || !meet(result.bounds(), solids[n].bounds())) return nothing();
    result = Solid(kernel().combine(Boolean::intersect, *result.body(), *solids[n].body()));
  }
  return result;
}

Solid subtract(const Solid& from, std::vector<Solid> others, const Work& work) {
  std::erase_if(others, [&](const Solid& other) { return !meet(other.bounds(), from.bounds()); });
  if (from.is_empty() || others.empty()) return from;
  const Solid other = unite(std::move(others), work);
  work.check();
  return Solid(kernel().combine(Boolean::subtract, *from.body(), *other.body()));
}

Solid moved(const Solid& solid, const Affine& map) {
  if (solid.is_empty() || map.is_identity()) return solid;
  if (solid.is_exact()) return Solid(kernel().moved(*solid.body(), map));
  return Solid(moved(solid.mesh(), map), solid.flaw());
}

Solid hull(const std::vector<Solid>& solids) {
  std::vector<Vec3> points;
  for (const Solid& solid : solids) points.insert(points.end(), solid.mesh().points.begin(), solid.mesh().points.end());
  return Solid(kernel().hull(points));
}

Solid minkowski(const Solid& a, const Solid& b, const Work& work) {
  if (a.is_empty() || b.is_empty()) return nothing();
  const std::vector<TriangleMesh> of_a = convex_parts(a), of_b = convex_parts(b);
  std::vector<Solid> hulls(of_a.size() * of_b.size(), nothing());
  run_parallel(hulls.size(), work.threads, [&](size_t n) {
    work.check();
    hulls[n] = Solid(kernel().hull(sums(of_a[n / of_b.size()], of_b[n % of_b.size()])));
  });
  return unite(std::move(hulls), work);
}

}  // namespace ombre::solids
