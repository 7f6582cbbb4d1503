#include "mesh_grid.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "solids.h"

namespace baseline {
namespace {

constexpr double max_nodes = 2.5e8;  // 1 GB of distances
constexpr int band = 3;              // cells on either side of the surface that hold true distances

struct Triangle {
  Point a, b, c;
};
using Triangles = std::vector<Triangle>;

Triangles read_binary_stl(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  constexpr size_t header = 84, record = 50;
  if (bytes.size() <= header || (bytes.size() - header) % record != 0)
    throw std::runtime_error(path + " is not a binary STL");
  Triangles triangles;
  for (size_t at = header; at < bytes.size(); at += record) {
    float v[12];
    std::memcpy(v, &bytes[at], sizeof v);
    triangles.push_back({{v[3], v[4], v[5]}, {v[6], v[7], v[8]}, {v[9], v[10], v[11]}});
  }
  return triangles;
}

Box bounds(const Triangle& t) {
  return {{std::min({t.a.x, t.b.x, t.c.x}), std::min({t.a.y, t.b.y, t.c.y}), std::min({t.a.z, t.b.z, t.c.z})},
          {std::max({t.a.x, t.b.x, t.c.x}), std::max({t.a.y, t.b.y, t.c.y}), std::max({t.a.z, t.b.z, t.c.z})}};
}

Box bounds(const Triangles& triangles) {
  Box box = bounds(triangles.front());
  for (const Triangle& t : triangles) {
    const Box b = bounds(t);
    box.lo = {std::min(box.lo.x, b.lo.x), std::min(box.lo.y, b.lo.y), std::min(box.lo.z, b.lo.z)};
    box.hi = {std::max(box.hi.x, b.hi.x), std::max(box.hi.y, b.hi.y), std::max(box.hi.z, b.hi.z)};
  }
  return box;
}

double square_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point ab = b - a;
  const double length = dot(ab, ab);
  const double at = length > 0 ? std::clamp(dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
  const Point off = p - (a + ab * at);
  return dot(off, off);
}

// The squared distance to a triangle: to its plane where the foot lies within it, else to its nearest edge.
double square_to_triangle(const Point& p, const Triangle& t) {
  const Point u = t.b - t.a, v = t.c - t.a, w = p - t.a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double determinant = uu * vv - uv * uv;
  if (determinant > 0) {
    const double s = (vv * wu - uv * wv) / determinant, r = (uu * wv - uv * wu) / determinant;
    if (s >= 0 && r >= 0 && s + r <= 1) {
      const Point off = w - u * s - v * r;
      return dot(off, off);
    }
  }
  return std::min({square_to_segment(p, t.a, t.b), square_to_segment(p, t.b, t.c), square_to_segment(p, t.c, t.a)});
}

class Grid {
 public:
  Grid(const Triangles& triangles, double spacing) : spacing_(spacing) {
    const Box box = bounds(triangles);
    const Point size = box.hi - box.lo;
    while (size.x * size.y * size.z / (spacing_ * spacing_ * spacing_) > max_nodes) spacing_ *= 1.05;
    // Off the coordinates that designers choose, so that no row of nodes runs through a vertex.
    const double margin = (band + 0.3819660113) * spacing_;
    origin_ = box.lo - Point{margin, margin, margin};
    nx_ = nodes_along(size.x);
    ny_ = nodes_along(size.y);
    nz_ = nodes_along(size.z);
    distances_.assign(nx_ * ny_ * nz_, static_cast<float>(band * spacing_));
    for (const Triangle& t : triangles) spread(t);
    set_signs(triangles);
  }

  double at(const Point& p) const {
    const Point q = (p - origin_) * (1 / spacing_);
    const double fx = std::floor(q.x), fy = std::floor(q.y), fz = std::floor(q.z);
    if (!(fx >= 0 && fy >= 0 && fz >= 0)) return band * spacing_;
    const size_t i = static_cast<size_t>(fx), j = static_cast<size_t>(fy), k = static_cast<size_t>(fz);
    if (i + 1 >= nx_ || j + 1 >= ny_ || k + 1 >= nz_) return band * spacing_;
    const float* low = &distances_[index(i, j, k)];
    const float* high = low + nx_ * ny_;
    const double tx = q.x - fx, ty = q.y - fy, tz = q.z - fz;
    return mix(mix_plane(low, tx, ty), mix_plane(high, tx, ty), tz);
  }

 private:
  size_t nodes_along(double size) const { return static_cast<size_t>(std::ceil(size / spacing_)) + 2 * band + 2; }
  size_t index(size_t i, size_t j, size_t k) const { return (k * ny_ + j) * nx_ + i; }
  static double mix(double a, double b, double t) { return a + (b - a) * t; }
  double mix_plane(const float* v, double tx, double ty) const {
    return mix(mix(v[0], v[1], tx), mix(v[nx_], v[nx_ + 1], tx), ty);
  }
  double coordinate(double origin, size_t i) const { return origin + static_cast<double>(i) * spacing_; }

  // The nodes from `lo` to `hi`, within the grid.
  std::pair<size_t, size_t> nodes_between(double lo, double hi, double origin, size_t count) const {
    const double first = std::max(0.0, std::ceil((lo - origin) / spacing_));
    const double last = std::min(static_cast<double>(count) - 1, std::floor((hi - origin) / spacing_));
    return {static_cast<size_t>(first), static_cast<size_t>(std::max(last + 1, first))};
  }

  // Lowers the distances of the nodes around a triangle to the distance to it.
  void spread(const Triangle& t) {
    const double reach = band * spacing_;
    const Box b = bounds(t);
    const auto [i0, i1] = nodes_between(b.lo.x - reach, b.hi.x + reach, origin_.x, nx_);
    const auto [j0, j1] = nodes_between(b.lo.y - reach, b.hi.y + reach, origin_.y, ny_);
    const auto [k0, k1] = nodes_between(b.lo.z - reach, b.hi.z + reach, origin_.z, nz_);
    for (size_t k = k0; k < k1; ++k)
      for (size_t j = j0; j < j1; ++j)
        for (size_t i = i0; i < i1; ++i) {
          const Point p{coordinate(origin_.x, i), coordinate(origin_.y, j), coordinate(origin_.z, k)};
          float& distance = distances_[index(i, j, k)];
          const double square = square_to_triangle(p, t);
          if (square < static_cast<double>(distance) * distance) distance = static_cast<float>(std::sqrt(square));
        }
  }

  // Rows of nodes are inside between their odd crossings with the surface and their even ones.
  void set_signs(const Triangles& triangles) {
    std::vector<std::vector<double>> crossings(ny_ * nz_);
    for (const Triangle& t : triangles) cross_rows(t, crossings);
    for (size_t row = 0; row < crossings.size(); ++row) {
      std::vector<double>& xs = crossings[row];
      std::sort(xs.begin(), xs.end());
      for (size_t c = 0; c + 1 < xs.size(); c += 2) {
        const auto [i0, i1] = nodes_between(xs[c], xs[c + 1], origin_.x, nx_);
        for (size_t i = i0; i < i1; ++i) distances_[row * nx_ + i] *= -1;
      }
    }
  }

  void cross_rows(const Triangle& t, std::vector<std::vector<double>>& crossings) const {
    const Point u = t.b - t.a, v = t.c - t.a;
    const double area = u.y * v.z - u.z * v.y;
    if (area == 0) return;
    const Box b = bounds(t);
    const auto [j0, j1] = nodes_between(b.lo.y, b.hi.y, origin_.y, ny_);
    const auto [k0, k1] = nodes_between(b.lo.z, b.hi.z, origin_.z, nz_);
    for (size_t k = k0; k < k1; ++k)
      for (size_t j = j0; j < j1; ++j) {
        const double wy = coordinate(origin_.y, j) - t.a.y, wz = coordinate(origin_.z, k) - t.a.z;
        const double s = (wy * v.z - wz * v.y) / area, r = (u.y * wz - u.z * wy) / area;
        if (s >= 0 && r >= 0 && s + r <= 1) crossings[k * ny_ + j].push_back(t.a.x + u.x * s + v.x * r);
      }
  }

  double spacing_;
  Point origin_;
  size_t nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<float> distances_;
};

class Mesh final : public Leaf {
 public:
  Mesh(const Triangles& triangles, double spacing, size_t material)
      : Leaf(bounds(triangles), material), grid_(triangles, spacing) {}
  double distance(const Point& p) const override { return grid_.at(p); }

 private:
  Grid grid_;
};

}  // namespace

NodePtr mesh(const std::string& path, double spacing, size_t material) {
  return std::make_unique<Mesh>(read_binary_stl(path), spacing, material);
}

}  // namespace baseline
