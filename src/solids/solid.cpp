#include "solids/solid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/text/error.h"
#include "solids/kernel.h"

namespace ombre::solids {

Box bounds_of(const TriangleMesh& mesh) {
  Box box;
  for (const Vec3& p : mesh.points) box = hull(box, Box{p, p});
  return box;
}

double volume_of(const TriangleMesh& mesh) {
  if (mesh.points.empty()) return 0;
  const Vec3 origin = mesh.points[0];
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six += dot(mesh.points[a] - origin, cross(mesh.points[b] - origin, mesh.points[c] - origin));
  return six / 6;
}

bool is_finite(const TriangleMesh& mesh) {
  return std::ranges::all_of(
      mesh.points, [](const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

TriangleMesh moved(const TriangleMesh& mesh, const Affine& map) {
  TriangleMesh result = mesh;
  for (Vec3& p : result.points) p = map(p);
  if (determinant(map) < 0)
    for (auto& [a, b, c] : result.triangles) std::swap(b, c);
  return result;
}

TriangleMesh tidied(const TriangleMesh& mesh) {
  constexpr uint32_t unknown = UINT32_MAX;
  TriangleMesh result;
  std::map<std::array<double, 3>, uint32_t> known;
  std::vector<uint32_t> numbers(mesh.points.size(), unknown);
  const auto number = [&](uint32_t n) {
    if (numbers[n] != unknown) return numbers[n];
    const Vec3 p = mesh.points[n] + Vec3{};  // maps -0 to 0
    const auto [place, is_new] = known.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(result.points.size()));
    if (is_new) result.points.push_back(p);
    return numbers[n] = place->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
    if (p == q || q == r || r == p) continue;
    result.triangles.push_back({number(a), number(b), number(c)});
  }
  return result;
}

TriangleMesh sorted(const TriangleMesh& mesh) {
  const auto key = [&](uint32_t n) { return std::tuple(mesh.points[n].x, mesh.points[n].y, mesh.points[n].z); };
  std::vector<uint32_t> order(mesh.points.size()), place(mesh.points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  TriangleMesh result;
  for (uint32_t n = 0; n < order.size(); ++n) {
    place[order[n]] = n;
    result.points.push_back(mesh.points[order[n]]);
  }
  for (const Triangle& t : mesh.triangles) {
    Triangle renamed{place[t[0]], place[t[1]], place[t[2]]};
    std::rotate(renamed.begin(), std::min_element(renamed.begin(), renamed.end()), renamed.end());
    result.triangles.push_back(renamed);
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

double area_of(const Region& region) {
  double doubled = 0;
  for (const Ring& ring : region.rings) doubled += doubled_area(ring);
  return doubled / 2;
}

Box bounds_of(const Region& region) {
  Box box;
  for (const Ring& ring : region.rings)
    for (const Vec2& p : ring) box = hull(box, Box{{p.x, p.y, 0}, {p.x, p.y, 0}});
  return box;
}

struct Solid::State {
  std::mutex mutex;
  std::optional<TriangleMesh> mesh;
  BodyPtr body;
  Box bounds;
  Flaw flaw = Flaw::none;
};

Solid::Solid(TriangleMesh mesh, Flaw flaw) : state_(std::make_shared<State>()) {
  state_->flaw = flaw;
  state_->bounds = bounds_of(mesh);
  state_->mesh = std::move(mesh);
}

Solid::Solid(BodyPtr body) : state_(std::make_shared<State>()) {
  state_->bounds = body->bounds();
  state_->body = std::move(body);
}

const Box& Solid::bounds() const { return state_->bounds; }

const TriangleMesh& Solid::mesh() const {
  const std::lock_guard lock(state_->mutex);
  if (!state_->mesh) state_->mesh = sorted(tidied(state_->body->mesh()));
  return *state_->mesh;
}

namespace {

// A surface without a flaw may still touch itself, such as that of a frame that narrows to a point.
BodyPtr body_of(const TriangleMesh& mesh, Flaw flaw) {
  if (flaw == Flaw::crosses) return kernel().wound(mesh);
  try {
    std::string remark;
    return kernel().body(mesh, true, remark);
  } catch (const Error& error) {
    if (error.code() != Code::surface_crosses) throw;
    return kernel().wound(mesh);
  }
}

}  // namespace

const BodyPtr& Solid::body() const {
  const std::lock_guard lock(state_->mutex);
  if (!state_->body) state_->body = body_of(*state_->mesh, state_->flaw);
  return state_->body;
}

Flaw Solid::flaw() const { return state_->flaw; }

bool Solid::is_exact() const {
  const std::lock_guard lock(state_->mutex);
  return state_->body != nullptr;
}

}  // namespace ombre::solids
