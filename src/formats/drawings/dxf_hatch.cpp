#include "formats/drawings/dxf_hatch.h"

#include "formats/drawings/arcs.h"
#include "formats/drawings/line_joiner.h"

namespace ombre::formats {
namespace {

// Reads the values of a hatch in their order (DXF reference, HATCH and "Boundary Path Data").
class BorderReader {
 public:
  BorderReader(const TextScanner& scanner, const DxfEntity& entity, const ChordsOfRadius& chords)
      : values_(scanner, entity), pairs_(entity.pairs), chords_(chords) {}

  std::vector<Ring> read() {
    if (!skip_to(91)) return {};
    const int64_t paths = take_count();
    for (int64_t n = 0; n < paths && skip_to(92); ++n) {
      constexpr int64_t polyline = 2;
      if (take_count() & polyline)
        read_polyline();
      else
        read_edges();
    }
    return std::move(rings_);
  }

 private:
  bool skip_to(int code) {
    while (at_ < pairs_.size() && pairs_[at_].code != code) ++at_;
    return at_ < pairs_.size();
  }
  bool is_at(int code) const { return at_ < pairs_.size() && pairs_[at_].code == code; }
  double take() { return values_.parsed(pairs_[at_++]); }
  int64_t take_count() { return static_cast<int64_t>(take()); }
  // Takes the next value if it has the code.
  double take(int code, double otherwise) { return is_at(code) ? take() : otherwise; }
  Vec2 take_point(int code) {
    const double x = take(code, 0);
    return {x, take(code + 10, 0)};
  }

  void read_polyline() {
    take(72, 0);
    take(73, 1);
    const auto count = static_cast<int64_t>(take(93, 0));
    std::vector<Vec2> corners;
    std::vector<double> bulges;
    for (int64_t n = 0; n < count && is_at(10); ++n) {
      corners.push_back(take_point(10));
      bulges.push_back(take(42, 0));
    }
    if (corners.size() < 2) return;
    Ring ring{corners[0]};
    for (size_t n = 0; n < corners.size(); ++n)
      append_bulge(corners[(n + 1) % corners.size()], bulges[n], chords_, ring);
    ring.pop_back();
    if (ring.size() > 2) rings_.push_back(std::move(ring));
  }

  void read_edges() {
    const auto count = static_cast<int64_t>(take(93, 0));
    LineJoiner joiner;
    for (int64_t n = 0; n < count && is_at(72); ++n) {
      const int64_t kind = take_count();
      joiner.add(kind == 1   ? read_line()
                 : kind == 2 ? read_arc()
                 : kind == 3 ? read_ellipse()
                 : kind == 4 ? read_spline()
                             : Ring{});
    }
    for (Ring& ring : joiner.join().rings) rings_.push_back(std::move(ring));
  }

  Ring read_line() {
    const Vec2 from = take_point(10);
    return {from, take_point(11)};
  }
  // Angles of a clockwise arc are measured clockwise, too.
  Ring arc_of(const Vec2& center, const Vec2& first, const Vec2& second, double radius) {
    const double begin = take(50, 0), end = take(51, 360), sense = take(73, 1) != 0 ? 1 : -1;
    double turn = std::fmod(end - begin, 360);
    if (turn <= 0) turn += 360;
    Ring ring;
    append_arc({center, first, second, sense * begin * math::degree, sense * turn * math::degree}, chords_(radius),
               ring);
    if (turn == 360) ring.back() = ring.front();
    return ring;
  }
  Ring read_arc() {
    const Vec2 center = take_point(10);
    const double radius = take(40, 0);
    return arc_of(center, {radius, 0}, {0, radius}, radius);
  }
  Ring read_ellipse() {
    const Vec2 center = take_point(10), first = take_point(11);
    const double ratio = take(40, 1);
    return arc_of(center, first, {-ratio * first.y, ratio * first.x}, length(first));
  }
  Ring read_spline() {
    DxfSpline spline;
    spline.degree = static_cast<int>(take(94, 3));
    take(73, 0);
    spline.is_closed = take(74, 0) != 0;
    const double parameters = take(95, 0), controls = take(96, 0);
    while (is_at(40) && static_cast<double>(spline.parameters.size()) < parameters) spline.parameters.push_back(take());
    while (is_at(10) && static_cast<double>(spline.controls.size()) < controls) {
      spline.controls.push_back(take_point(10));
      if (is_at(42)) spline.weights.push_back(take());
    }
    if (is_at(97)) take();
    while (is_at(11)) spline.fits.push_back(take_point(11));
    if (is_at(12)) spline.first_way = take_point(12);
    if (is_at(13)) spline.last_way = take_point(13);
    return curve_of(spline);
  }

  DxfValues values_;
  const std::vector<DxfPair>& pairs_;
  const ChordsOfRadius& chords_;
  size_t at_ = 0;
  std::vector<Ring> rings_;
};

}  // namespace

std::vector<Ring> borders_of_hatch(const TextScanner& scanner, const DxfEntity& entity, const ChordsOfRadius& chords) {
  return BorderReader(scanner, entity, chords).read();
}

}  // namespace ombre::formats
