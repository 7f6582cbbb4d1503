// Winding numbers of the caps of a surface, and their bounds in boxes.
#include "import/surfaces/cap_winding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/math/math.h"

namespace ombre::importing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Sums over more edges are approximated by dipoles.
constexpr size_t most_edges = 2048;
// Upper bound on the winding number of all caps left out of a box's sum together.
constexpr double most_left_out = 0.01;

// Sums angles as a product of complex numbers, for several points at once, to avoid an arctangent for each angle.
class AngleSums {
 public:
  static constexpr size_t width = 8;

  explicit AngleSums(std::span<const Vec3> points) {
    for (size_t n = 0; n < width; ++n) {
      const Vec3 p = points[std::min(n, points.size() - 1)];
      px_[n] = p.x, py_[n] = p.y, pz_[n] = p.z;
      re_[n] = 1, im_[n] = 0, turns_[n] = 0;
    }
  }

  void add(const Cap& cap) {
    Corner apex, before, next;
    place(apex, cap.apex);
    place(before, cap.rim[0]);
    for (size_t i = 0; i < cap.rim.size(); ++i) {
      place(next, cap.rim[i + 1 == cap.rim.size() ? 0 : i + 1]);
      add(apex, before, next);
      before = next;
    }
  }

  // Returns the sum for point n as a share of the full solid angle.
  double winding(size_t n) const { return math::atan2(im_[n], re_[n]) / (2 * std::numbers::pi) + turns_[n]; }

 private:
  struct Corner {
    std::array<double, width> x, y, z, length;
  };

  void place(Corner& corner, Vec3 at) const {
    for (size_t n = 0; n < width; ++n) {
      const double x = at.x - px_[n], y = at.y - py_[n], z = at.z - pz_[n];
      corner.x[n] = x, corner.y[n] = y, corner.z[n] = z;
      corner.length[n] = std::sqrt(x * x + y * y + z * z);
    }
  }

  // The tangent of half a triangle's solid angle is im / re (van Oosterom and Strackee 1983).
  void add(const Corner& a, const Corner& b, const Corner& c) {
    for (size_t n = 0; n < width; ++n) {
      const double im = a.x[n] * (b.y[n] * c.z[n] - b.z[n] * c.y[n]) + a.y[n] * (b.z[n] * c.x[n] - b.x[n] * c.z[n]) +
                        a.z[n] * (b.x[n] * c.y[n] - b.y[n] * c.x[n]);
      const double ab = a.x[n] * b.x[n] + a.y[n] * b.y[n] + a.z[n] * b.z[n];
      const double bc = b.x[n] * c.x[n] + b.y[n] * c.y[n] + b.z[n] * c.z[n];
      const double ca = c.x[n] * a.x[n] + c.y[n] * a.y[n] + c.z[n] * a.z[n];
      const double re =
          a.length[n] * b.length[n] * c.length[n] + ab * c.length[n] + bc * a.length[n] + ca * b.length[n];
      const double product_re = re_[n] * re - im_[n] * im, product_im = re_[n] * im + im_[n] * re;
      const double size = std::abs(product_re) + std::abs(product_im);
      const bool counts = size > 0;  // false on an edge or a triangle without area
      const bool wraps_up = im_[n] >= 0 && im >= 0 && product_im < 0;
      const bool wraps_down = im_[n] < 0 && im < 0 && product_im >= 0;
      turns_[n] += counts ? (wraps_up ? 1.0 : 0.0) - (wraps_down ? 1.0 : 0.0) : 0.0;
      re_[n] = counts ? product_re / size : re_[n];
      im_[n] = counts ? product_im / size : im_[n];
    }
  }

  std::array<double, width> px_, py_, pz_, re_, im_, turns_;
};

Surface surface_of(const std::vector<Cap>& caps) {
  Surface surface;
  for (const Cap& cap : caps) {
    for (size_t i = 0; i < cap.rim.size(); ++i) {
      const auto first = static_cast<uint32_t>(surface.vertices.size());
      for (const Vec3& corner : cap.corners(i)) surface.vertices.push_back(corner);
      surface.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return surface;
}

// Returns false only if the box surely misses the triangle, judged by boxes and the triangle's plane.
bool may_meet(const Box& box, const std::array<Vec3, 3>& t) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::max({t[0][axis], t[1][axis], t[2][axis]}) < box.lo[axis]) return false;
    if (std::min({t[0][axis], t[1][axis], t[2][axis]}) > box.hi[axis]) return false;
  }
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]), half = 0.5 * box.size();
  const double reach = std::abs(normal.x) * half.x + std::abs(normal.y) * half.y + std::abs(normal.z) * half.z;
  return std::abs(dot(normal, box.center() - t[0])) <= reach * (1 + 1e-9);
}

}  // namespace

CapWinding::CapWinding(std::vector<Cap> caps) : caps_(std::move(caps)) {
  all_.caps.resize(caps_.size());
  std::iota(all_.caps.begin(), all_.caps.end(), 0u);
  size_t edges = 0;
  for (const Cap& cap : caps_) {
    Reach& reach = reaches_.emplace_back();
    reach.center = cap.apex;
    for (size_t i = 0; i < cap.rim.size(); ++i) {
      const auto [apex, from, to] = cap.corners(i);
      reach.radius = std::max(reach.radius, length(from - apex));
      reach.area += 0.5 * length(cross(from - apex, to - apex));
      reach.edges.push_back({0.5 * (from + to), 0.5 * length(to - from)});
    }
    edges += cap.rim.size();
  }
  if (edges > most_edges) many_ = std::make_unique<SolidAngle>(std::make_shared<Surface>(surface_of(caps_)));
}

// The solid angle of a triangle is at most its area over the squared distance.
double CapWinding::most_in(const Box& box, uint32_t cap) const {
  const Reach& reach = reaches_[cap];
  const Vec3 nearest{std::clamp(reach.center.x, box.lo.x, box.hi.x), std::clamp(reach.center.y, box.lo.y, box.hi.y),
                     std::clamp(reach.center.z, box.lo.z, box.hi.z)};
  const double distance = length(nearest - reach.center) - reach.radius;
  return distance > 0 ? reach.area / (4 * std::numbers::pi * distance * distance) : infinity;
}

CapWinding::Relevant CapWinding::relevant(const Box& box, const Relevant& around) const {
  Relevant result{{}, around.others};
  // A box uses up only part of what may be left out, so that its smaller boxes can leave out some too.
  const double share = (most_left_out - around.others) / (4 * static_cast<double>(around.caps.size()));
  for (const uint32_t cap : around.caps) {
    if (const double most = most_in(box, cap); most < share)
      result.others += most;
    else
      result.caps.push_back(cap);
  }
  return result;
}

// Returns an upper bound on the change of the sum within `reach` of a point. The gradient is a line integral along the
// edges (Biot and Savart), at most their length over the squared distance, over 4 pi.
double CapWinding::variation(Vec3 center, double reach, uint32_t cap) const {
  double sum = 0;
  for (const Edge& edge : reaches_[cap].edges) {
    const double distance = length(edge.middle - center) - edge.half - reach;
    if (!(distance > 0)) return infinity;
    sum += 2 * edge.half / (distance * distance);
  }
  return reach * sum / (4 * std::numbers::pi);
}

CapWinding::Estimate CapWinding::estimate(const Box& box, double middle, const Relevant& relevant) const {
  Estimate result;
  const Vec3 center = box.center();
  const double reach = 0.5 * length(box.size());
  result.middle = middle;
  result.variation = 2 * relevant.others;
  result.most = relevant.others;
  bool may_jump = false;
  for (const uint32_t cap : relevant.caps) {
    result.most += most_in(box, cap);
    result.variation += variation(center, reach, cap);
    may_jump = may_jump || meets(box, cap);
  }
  if (!may_jump) result.most = std::min(result.most, std::abs(middle) + result.variation);
  return result;
}

bool CapWinding::meets(const Box& box, uint32_t number) const {
  const Cap& cap = caps_[number];
  for (size_t i = 0; i < cap.rim.size(); ++i)
    if (may_meet(box, cap.corners(i))) return true;
  return false;
}

void CapWinding::sum(std::span<const Vec3> points, std::span<const uint32_t> caps, std::span<double> sums) const {
  size_t edges = 0;
  if (many_)
    for (const uint32_t cap : caps) edges += caps_[cap].rim.size();
  for (size_t n = 0; n < points.size(); n += AngleSums::width) {
    const size_t count = std::min(AngleSums::width, points.size() - n);
    if (edges > most_edges) {
      for (size_t i = n; i < n + count; ++i) sums[i] = many_->winding(points[i]);
      continue;
    }
    AngleSums some(points.subspan(n, count));
    for (const uint32_t cap : caps) some.add(caps_[cap]);
    for (size_t i = 0; i < count; ++i) sums[n + i] = some.winding(i);
  }
}

}  // namespace ombre::importing
