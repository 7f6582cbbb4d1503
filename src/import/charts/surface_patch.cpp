#include "import/charts/surface_patch.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/math/box_tree.h"
#include "base/math/disjoint_sets.h"
#include "base/math/math.h"
#include "base/text/text.h"
#include "import/fields/triangle_distance.h"

namespace ombre::importing {
namespace {

using Edge = std::array<uint32_t, 2>;

Edge sorted(uint32_t a, uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

std::array<Vec3, 3> corners_of(const std::vector<Vec3>& points, const Corners& t) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}
Vec3 area_of(const std::array<Vec3, 3>& t) { return 0.5 * cross(t[1] - t[0], t[2] - t[0]); }
Vec3 center_of(const std::array<Vec3, 3>& t) { return (1.0 / 3) * (t[0] + t[1] + t[2]); }

// Returns the triangles at each edge.
std::map<Edge, std::vector<uint32_t>> edges_of(const std::vector<Corners>& triangles) {
  std::map<Edge, std::vector<uint32_t>> edges;
  for (uint32_t t = 0; t < triangles.size(); ++t)
    for (size_t n = 0; n < 3; ++n) edges[sorted(triangles[t][n], triangles[t][(n + 1) % 3])].push_back(t);
  return edges;
}

class Chooser {
 public:
  Chooser(const std::vector<Vec3>& points, const std::vector<Corners>& triangles, const PatchChoice& choice)
      : points_(points), all_(triangles), choice_(choice) {}

  ChosenPatch run() {
    for (const Corners& t : all_)
      if (length(area_of(corners_of(points_, t))) > 0 && fits(t)) chosen_.push_back(t);
    if (chosen_.empty())
      return refuse("no triangle of the surface is chosen", "choose a larger box, or another direction");
    if (choice_.at) keep_linked();
    if (!has_sound_edges()) return std::move(result_);
    if (!is_one_piece()) return std::move(result_);
    if (border_of(chosen_).empty())
      return refuse("the chosen surface is closed, so it cannot be laid out in a plane",
                    "choose a part of it, with at and angle, min and max, or normal");
    take();
    if (!touches_nowhere()) return std::move(result_);
    make_normals(result_.patch);
    return std::move(result_);
  }

 private:
  ChosenPatch refuse(std::string problem, std::string hint) {
    result_ = {{}, std::move(problem), std::move(hint)};
    return result_;
  }

  bool fits(const Corners& t) const {
    const auto corners = corners_of(points_, t);
    if (choice_.box && !choice_.box->contains(center_of(corners))) return false;
    if (!choice_.normal) return true;
    const Vec3 area = area_of(corners);
    return dot(area, *choice_.normal) >=
           math::cos(choice_.within_deg * math::degree) * length(area) * length(*choice_.normal);
  }

  void keep_linked() {
    DisjointSets sets(chosen_.size());
    const double least = math::cos(choice_.angle_deg * math::degree);
    for (const auto& [edge, at] : edges_of(chosen_))
      for (size_t n = 1; n < at.size(); ++n) {
        const Vec3 a = area_of(corners_of(points_, chosen_[at[0]])), b = area_of(corners_of(points_, chosen_[at[n]]));
        if (dot(a, b) >= least * length(a) * length(b)) sets.join(at[0], at[n]);
      }
    uint32_t nearest = 0;
    double best = Box::inf;
    for (uint32_t t = 0; t < chosen_.size(); ++t) {
      const double here = squared_distance(*choice_.at, corners_of(points_, chosen_[t]));
      if (here >= best) continue;
      best = here;
      nearest = t;
    }
    std::vector<Corners> linked;
    for (uint32_t t = 0; t < chosen_.size(); ++t)
      if (sets.root(t) == sets.root(nearest)) linked.push_back(chosen_[t]);
    chosen_ = std::move(linked);
  }

  bool has_sound_edges() {
    for (const auto& [edge, at] : edges_of(chosen_)) {
      const Vec3 middle = 0.5 * (points_[edge[0]] + points_[edge[1]]);
      if (at.size() > 2) {
        refuse("three triangles of the chosen surface share an edge at " + place_text(middle),
               "repair the mesh, or choose a part without that edge");
        return false;
      }
      if (at.size() == 2 && same_direction(chosen_[at[0]], chosen_[at[1]], edge)) {
        refuse("two triangles of the chosen surface face opposite sides at " + place_text(middle),
               "repair the mesh, so that all triangles face outward");
        return false;
      }
    }
    return true;
  }
  static bool runs(const Corners& t, uint32_t a, uint32_t b) {
    for (size_t n = 0; n < 3; ++n)
      if (t[n] == a && t[(n + 1) % 3] == b) return true;
    return false;
  }
  static bool same_direction(const Corners& s, const Corners& t, const Edge& edge) {
    return runs(s, edge[0], edge[1]) == runs(t, edge[0], edge[1]);
  }

  bool is_one_piece() {
    DisjointSets sets(chosen_.size());
    for (const auto& [edge, at] : edges_of(chosen_))
      for (size_t n = 1; n < at.size(); ++n) sets.join(at[0], at[n]);
    size_t pieces = 0;
    for (uint32_t t = 0; t < chosen_.size(); ++t) pieces += sets.root(t) == t ? 1 : 0;
    if (pieces == 1) return true;
    refuse("the chosen surface has " + std::to_string(pieces) + " separate pieces",
           "choose one of them: at=(x, y, z) takes what is linked to the triangle nearest to a point");
    return false;
  }

  void take() {
    std::vector<uint32_t> numbers(points_.size(), ~uint32_t{0});
    SurfacePatch& patch = result_.patch;
    for (const Corners& t : chosen_) {
      Corners own{};
      for (size_t n = 0; n < 3; ++n) {
        uint32_t& number = numbers[t[n]];
        if (number == ~uint32_t{0}) {
          number = static_cast<uint32_t>(patch.points.size());
          patch.points.push_back(points_[t[n]]);
        }
        own[n] = number;
      }
      patch.triangles.push_back(own);
    }
  }

  // Each point of the border has one edge that leaves it, unless two fans of triangles meet there.
  bool touches_nowhere() {
    std::vector<int> leaving(result_.patch.points.size());
    for (const Edge& edge : border_of(result_.patch.triangles))
      if (++leaving[edge[0]] > 1) {
        refuse("two parts of the chosen surface touch in a single point, " + place_text(result_.patch.points[edge[0]]),
               "choose somewhat more or less of the surface");
        return false;
      }
    return true;
  }

  const std::vector<Vec3>& points_;
  const std::vector<Corners>& all_;
  const PatchChoice& choice_;
  std::vector<Corners> chosen_;
  ChosenPatch result_;
};

}  // namespace

std::vector<std::array<uint32_t, 3>> neighbours_of(const std::vector<Corners>& triangles) {
  std::vector<std::array<uint32_t, 3>> all(triangles.size(), {no_triangle, no_triangle, no_triangle});
  for (const auto& [edge, at] : edges_of(triangles))
    for (size_t side = 0; side < at.size() && at.size() == 2; ++side)
      for (size_t n = 0; n < 3; ++n)
        if (const Corners& t = triangles[at[side]]; sorted(t[(n + 1) % 3], t[(n + 2) % 3]) == edge)
          all[at[side]][n] = at[1 - side];
  return all;
}

std::vector<Edge> border_of(const std::vector<Corners>& triangles) {
  std::vector<Edge> border;
  for (const auto& [edge, at] : edges_of(triangles)) {
    if (at.size() != 1) continue;
    const Corners& t = triangles[at[0]];
    for (size_t n = 0; n < 3; ++n)
      if (sorted(t[n], t[(n + 1) % 3]) == edge) border.push_back({t[n], t[(n + 1) % 3]});
  }
  return border;
}

std::string place_text(Vec3 p) {
  constexpr double noise = 1e-6;  // mm
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    text += (axis == 0 ? "(" : ", ") + format_rounded(std::abs(p[axis]) < noise ? 0 : p[axis]);
  return text + ")";
}

void remove_seams(const std::vector<Vec3>& points, std::vector<Edge>& border) {
  // Points of a seam differ by rounding.
  constexpr double grid = 1e6;  // per mm
  const auto key = [&](uint32_t n) {
    const Vec3 p = points[n];
    return std::array{std::round(p.x * grid), std::round(p.y * grid), std::round(p.z * grid)};
  };
  std::map<std::array<std::array<double, 3>, 2>, int> count;
  const auto both = [&](const Edge& edge) {
    const auto a = key(edge[0]), b = key(edge[1]);
    return a < b ? std::array{a, b} : std::array{b, a};
  };
  for (const Edge& edge : border) ++count[both(edge)];
  std::erase_if(border, [&](const Edge& edge) { return count[both(edge)] > 1; });
}

void make_normals(SurfacePatch& patch) {
  patch.normals.assign(patch.points.size(), {});
  for (const Corners& t : patch.triangles) {
    const auto corners = corners_of(patch.points, t);
    const Vec3 area = area_of(corners), normal = (1 / length(area)) * area;
    for (size_t n = 0; n < 3; ++n) {
      const Vec3 a = corners[(n + 1) % 3] - corners[n], b = corners[(n + 2) % 3] - corners[n];
      const double angle = math::atan2(length(cross(a, b)), dot(a, b));
      patch.normals[t[n]] = patch.normals[t[n]] + angle * normal;
    }
  }
  for (Vec3& normal : patch.normals) {
    const double size = length(normal);
    normal = size > 0 ? (1 / size) * normal : Vec3{0, 0, 1};
  }
}

namespace {

double plane_area(const SurfacePatch& patch, const Corners& t) {
  return 0.5 * cross(patch.places[t[1]] - patch.places[t[0]], patch.places[t[2]] - patch.places[t[0]]);
}

// Returns the sum of the direction in the triangles' planes, times their areas, in u and v.
Vec2 mean_direction(const SurfacePatch& patch, Vec3 direction) {
  Vec2 sum{0, 0};
  for (const Corners& t : patch.triangles) {
    const auto [a, b, c] = corners_of(patch.points, t);
    const Vec3 first = b - a, second = c - a, normal = cross(first, second);
    const double squared = dot(normal, normal);
    // Shares of the two edges in the direction's part in the plane.
    const double along_first = dot(cross(direction, second), normal) / squared;
    const double along_second = dot(cross(first, direction), normal) / squared;
    const Vec2 way = along_first * (patch.places[t[1]] - patch.places[t[0]]) +
                     along_second * (patch.places[t[2]] - patch.places[t[0]]);
    sum = sum + 0.5 * std::sqrt(squared) * way;
  }
  return sum;
}

}  // namespace

std::optional<uint32_t> turned_over(const SurfacePatch& patch) {
  for (uint32_t t = 0; t < patch.triangles.size(); ++t)
    if (!(plane_area(patch, patch.triangles[t]) > 0)) return t;
  return std::nullopt;
}

Vec2 align_places(SurfacePatch& patch, Vec3 toward) {
  double surface = 0, plane = 0;
  for (const Corners& t : patch.triangles) {
    surface += length(area_of(corners_of(patch.points, t)));
    plane += std::abs(plane_area(patch, t));
  }
  const double scale = std::sqrt(surface / plane);
  Vec2 along = mean_direction(patch, toward);
  // A direction perpendicular to the patch says nothing about u.
  const double least = 1e-6 * surface / scale;
  for (const Vec3 other : {Vec3{1, 0, 0}, Vec3{0, 1, 0}})
    if (!(length(along) > least)) along = mean_direction(patch, other);
  if (!(length(along) > least)) along = {1, 0};
  along = (1 / length(along)) * along;
  for (Vec2& place : patch.places) place = scale * Vec2{dot(place, along), cross(along, place)};
  return moved_to_zero(patch);
}

Vec2 moved_to_zero(SurfacePatch& patch) {
  Vec2 low{Box::inf, Box::inf}, high{-Box::inf, -Box::inf};
  for (const Vec2 place : patch.places) {
    low = {std::min(low.x, place.x), std::min(low.y, place.y)};
    high = {std::max(high.x, place.x), std::max(high.y, place.y)};
  }
  for (Vec2& place : patch.places) place = place - low;
  return high - low;
}

SurfacePatch divided(const SurfacePatch& patch) {
  SurfacePatch result = patch;
  result.triangles.clear();
  std::map<Edge, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto [at, is_new] = middles.try_emplace(sorted(a, b), static_cast<uint32_t>(result.points.size()));
    if (is_new) {
      result.points.push_back(0.5 * (patch.points[a] + patch.points[b]));
      const Vec3 normal = patch.normals[a] + patch.normals[b];
      result.normals.push_back((1 / length(normal)) * normal);
      if (!patch.places.empty()) result.places.push_back(0.5 * (patch.places[a] + patch.places[b]));
    }
    return at->second;
  };
  for (const auto& [a, b, c] : patch.triangles) {
    const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Corners& t : {Corners{a, ab, ca}, Corners{ab, b, bc}, Corners{ca, bc, c}, Corners{ab, bc, ca}})
      result.triangles.push_back(t);
  }
  return result;
}

ChosenPatch choose_patch(const std::vector<Vec3>& points, const std::vector<Corners>& triangles,
                         const PatchChoice& choice) {
  return Chooser(points, triangles, choice).run();
}

}  // namespace ombre::importing
