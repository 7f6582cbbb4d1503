#include "solids/strokes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math/math.h"
#include "solids/fragments.h"
#include "solids/regions.h"

namespace ombre::solids {
namespace {

using formats::StrokeCap;
using formats::StrokeJoin;

// Collects the pieces of a stroke, whose union it is: a rectangle for each segment, the joins and the caps.
class StrokePieces {
 public:
  StrokePieces(const formats::PlaneStroke& stroke, int edges)
      : stroke_(stroke), half_(stroke.width / 2), edges_(edges) {}

  void add(const Ring& points, bool is_closed) {
    Ring line;
    for (const Vec2& p : points)
      if (line.empty() || !(p == line.back())) line.push_back(p);
    if (is_closed && line.size() > 1 && line.front() == line.back()) line.pop_back();
    if (line.size() < 2) {
      if (!line.empty()) add_dot(line[0]);
      return;
    }
    const size_t segments = line.size() - (is_closed ? 0 : 1);
    for (size_t n = 0; n < segments; ++n) add_segment(line[n], line[(n + 1) % line.size()]);
    for (size_t n = is_closed ? 0 : 1; n < segments; ++n)
      add_join(line[(n + line.size() - 1) % line.size()], line[n], line[(n + 1) % line.size()]);
    if (is_closed) return;
    add_cap(line[1], line[0]);
    add_cap(line[line.size() - 2], line.back());
  }

  const std::vector<Ring>& pieces() const { return pieces_; }

 private:
  static Vec2 direction(Vec2 from, Vec2 to) { return (1 / length(to - from)) * (to - from); }
  Vec2 left(Vec2 way) const { return half_ * Vec2{-way.y, way.x}; }

  void add_piece(Ring ring) {
    const double turn = doubled_area(ring);
    if (turn < 0) std::reverse(ring.begin(), ring.end());
    if (turn != 0) pieces_.push_back(std::move(ring));
  }
  void add_segment(Vec2 a, Vec2 b) {
    const Vec2 side = left(direction(a, b));
    add_piece({a + side, a - side, b - side, b + side});
  }
  void add_circle(Vec2 center) {
    Ring ring;
    for (int n = 0; n < edges_; ++n) {
      const double angle = 2 * std::numbers::pi * n / edges_;
      ring.push_back(center + half_ * Vec2{math::cos(angle), math::sin(angle)});
    }
    add_piece(std::move(ring));
  }
  // A line without a length shows its caps alone.
  void add_dot(Vec2 p) {
    if (stroke_.cap == StrokeCap::round) add_circle(p);
    if (stroke_.cap == StrokeCap::square) add_segment(p - Vec2{half_, 0}, p + Vec2{half_, 0});
  }
  void add_cap(Vec2 from, Vec2 end) {
    if (stroke_.cap == StrokeCap::round) add_circle(end);
    if (stroke_.cap == StrokeCap::square) add_segment(end, end + half_ * direction(from, end));
  }
  void add_join(Vec2 before, Vec2 p, Vec2 after) {
    const Vec2 in = direction(before, p), out = direction(p, after);
    const double turn = cross(in, out), cosine = in.x * out.x + in.y * out.y;
    // Chords of a curve have no corners, so a tip closes the gap between them.
    constexpr double of_chords = 0.99;
    const bool is_smooth = cosine > of_chords;
    if (stroke_.join == StrokeJoin::round && !is_smooth) return add_circle(p);
    const double side = turn > 0 ? -1 : 1;  // the outer side
    const Vec2 a = side * left(in), b = side * left(out);
    // The length of a tip in widths is 1 / cos(half of the turn).
    const double tip = std::sqrt(2 / std::max(1 + cosine, 1e-300));
    if (is_smooth || (stroke_.join == StrokeJoin::miter && tip <= stroke_.miter_limit))
      add_piece({p, p + a, p + (1 / (1 + cosine)) * (a + b), p + b});
    else
      add_piece({p, p + a, p + b});
  }

  const formats::PlaneStroke& stroke_;
  double half_;
  int edges_;
  std::vector<Ring> pieces_;
};

}  // namespace

Region stroked(const formats::PlaneStroke& stroke, const Fragments& fragments) {
  const formats::PlaneMap& map = stroke.map;
  const double scale = std::sqrt(std::abs(map.a * map.d - map.b * map.c));
  if (!(stroke.width > 0) || !(scale > 0)) return {};
  StrokePieces pieces(stroke, edges_of_circle(stroke.width / 2 * scale, fragments));
  for (const Ring& line : stroke.open) pieces.add(line, false);
  for (const Ring& line : stroke.closed) pieces.add(line, true);
  return moved(wound_region_of(pieces.pieces()),
               Affine{{Vec3{map.a, map.c, 0}, {map.b, map.d, 0}, {0, 0, 1}}, {map.e, map.f, 0}});
}

}  // namespace ombre::solids
