#include "import/charts/paired_places.h"

#include <algorithm>
#include <string>

namespace ombre::importing {
namespace {

constexpr double most_off = 0.05;  // share of the extents

std::string name_of(const Pairing& pairing) {
  const std::string along = pairing.is_exchanged ? "vu" : "uv";
  if (pairing.is_u_back) return along + (pairing.is_v_back ? "_flip_both" : "_flip_u");
  return pairing.is_v_back ? along + "_flip_v" : along;
}

}  // namespace

Vec2 Pairing::share(Vec2 of) const {
  const double along_u = is_u_back ? 1 - of.x : of.x, along_v = is_v_back ? 1 - of.y : of.y;
  return is_exchanged ? Vec2{along_v, along_u} : Vec2{along_u, along_v};
}

std::vector<Pairing> all_pairings() {
  std::vector<Pairing> all;
  for (const bool exchanged : {false, true})
    for (const bool u_back : {false, true})
      for (const bool v_back : {false, true}) all.push_back({exchanged, u_back, v_back});
  return all;
}

Pairing pairing_called(std::string_view name) {
  for (const Pairing& pairing : all_pairings())
    if (name_of(pairing) == name) return pairing;
  return {};
}

PairedPlaces::PairedPlaces(const SurfacePatch& other, Vec2 lengths, Vec2 other_lengths, std::string_view name,
                           const SurfacePatch& patch)
    : other_(other), lengths_(lengths), other_lengths_(other_lengths) {
  Shell plane;
  plane.patch.triangles = other.triangles;
  for (const Vec2 place : other.places) plane.patch.points.push_back({place.x, place.y, 0});
  plane.ways.assign(other.places.size(), {0, 0, 1});
  std::vector<Box> boxes;
  for (const Corners& corners : plane.patch.triangles) {
    flat_.emplace_back(plane, corners);
    boxes.push_back(flat_.back().box({0, 0}));
  }
  tree_ = BoxTree(boxes);
  pairing_ = pairing_called(name);
  if (name == "nearest") {
    const std::vector<Pairing> all = all_pairings();
    std::vector<double> ways;
    for (const Pairing& pairing : all) ways.push_back(squared_ways(pairing, patch));
    pairing_ = all[static_cast<size_t>(std::ranges::min_element(ways) - ways.begin())];
  }
  for (size_t n = 0; n < patch.points.size(); ++n) {
    const double off = found(pairing_, patch.places[n]).off;
    farthest_off_ = std::max(farthest_off_, off);
    if (off > most_off * std::max(other_lengths.x, other_lengths.y) && !without_partner_)
      without_partner_ = patch.points[n];
  }
}

PairedPlaces::Found PairedPlaces::found(const Pairing& pairing, Vec2 place) const {
  const Vec2 share = pairing.share({place.x / lengths_.x, place.y / lengths_.y});
  const Vec3 p{share.x * other_lengths_.x, share.y * other_lengths_.y, 0};
  uint32_t triangle = 0;
  PrismPlace at;
  Found best{{}, Box::inf};
  tree_.nearest(p, Box::inf, 0, [&](uint32_t n) {
    PrismPlace here = flat_[n].nearest(p);
    here.height = 0;
    const double off = length(flat_[n].point(here) - p);
    if (off < best.off) {
      best.off = off;
      triangle = n;
      at = here;
    }
    return off;
  });
  // Beyond the outline the nearest triangle goes on, since places that end at the outline would fold cells.
  if (best.off > 0) flat_[triangle].find(p, {-1, 1}, at);
  const auto& [a, b, c] = other_.triangles[triangle];
  best.point = at.first() * other_.points[a] + at.second * other_.points[b] + at.third * other_.points[c];
  return best;
}

double PairedPlaces::squared_ways(const Pairing& pairing, const SurfacePatch& patch) const {
  double sum = 0;
  for (size_t n = 0; n < patch.points.size(); ++n) {
    const Vec3 way = found(pairing, patch.places[n]).point - patch.points[n];
    sum += dot(way, way);
  }
  return sum;
}

}  // namespace ombre::importing
