// Reads DXF files, as text.
#include <cmath>
#include <map>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/drawings/arcs.h"
#include "formats/drawings/dxf_entities.h"
#include "formats/drawings/plane_files.h"

namespace ombre::formats {
namespace {

constexpr int deepest = 16;  // greatest depth of nested blocks
constexpr size_t most_points = 10'000'000;

// Appends an arc between two points; `bulge` is the tangent of a quarter of its angle.
template <class Chords>
void append_bulge(Vec2 from, Vec2 to, double bulge, const Chords& chords, Ring& ring) {
  if (bulge == 0) {
    ring.push_back(to);
    return;
  }
  const double turn = 4 * math::atan(bulge);
  const Vec2 chord = to - from, middle = 0.5 * (from + to);
  // distance of the center from the chord, in lengths of the chord
  const double rise = (1 - bulge * bulge) / (4 * bulge);
  const Vec2 center = middle + rise * Vec2{-chord.y, chord.x};
  const Vec2 first = from - center;
  Ring arc;
  append_arc({center, first, {-first.y, first.x}, 0, turn}, chords(length(first)), arc);
  ring.insert(ring.end(), arc.begin() + 1, arc.end() - 1);
  ring.push_back(to);
}

// Joins lines whose ends meet.
class LineJoiner {
 public:
  void add(Ring line) {
    if (line.size() > 1) lines_.push_back(std::move(line));
  }

  // Returns closed rings. `open` counts chains whose ends do not meet; they are closed by a straight line, as in
  // OpenSCAD.
  std::vector<Ring> rings(size_t& open) {
    for (size_t n = 0; n < lines_.size(); ++n) {
      ends_.emplace(key(lines_[n].front()), n);
      ends_.emplace(key(lines_[n].back()), n);
    }
    std::vector<bool> used(lines_.size());
    std::vector<Ring> rings;
    for (size_t n = 0; n < lines_.size(); ++n) {
      if (used[n]) continue;
      used[n] = true;
      Ring ring = lines_[n];
      extend(ring, used);
      std::reverse(ring.begin(), ring.end());
      extend(ring, used);
      std::reverse(ring.begin(), ring.end());
      if (key(ring.front()) == key(ring.back()))
        ring.pop_back();
      else
        ++open;
      if (ring.size() > 2) rings.push_back(std::move(ring));
    }
    return rings;
  }

 private:
  using Key = std::pair<int64_t, int64_t>;
  static Key key(Vec2 p) {
    constexpr double places_per_mm = 1000;  // ends that agree to this precision meet
    return {std::llround(p.x * places_per_mm), std::llround(p.y * places_per_mm)};
  }
  // Appends lines to the ring's end until it is closed.
  void extend(Ring& ring, std::vector<bool>& used) const {
    while (key(ring.front()) != key(ring.back())) {
      const auto next = unused_at(key(ring.back()), used);
      if (!next) return;
      used[*next] = true;
      Ring line = lines_[*next];
      if (key(line.front()) != key(ring.back())) std::reverse(line.begin(), line.end());
      ring.insert(ring.end(), line.begin() + 1, line.end());
    }
  }
  std::optional<size_t> unused_at(const Key& key, const std::vector<bool>& used) const {
    const auto [begin, end] = ends_.equal_range(key);
    for (auto at = begin; at != end; ++at)
      if (!used[at->second]) return at->second;
    return std::nullopt;
  }

  std::vector<Ring> lines_;
  std::multimap<Key, size_t> ends_;
};

class DxfReader {
 public:
  DxfReader(const std::string& name, std::string_view bytes, const PlaneOptions& options, Diagnostics& diagnostics)
      : name_(name), scanner_(name, bytes, diagnostics), bytes_(bytes), options_(options), diagnostics_(diagnostics) {}

  PlaneShapes read() {
    document_ = read_dxf_document(name_, bytes_, scanner_, diagnostics_);
    for (const DxfEntity& entity : document_.entities) add(entity, {1, 0, 0, 1, 0, 0}, 0, options_.layer.empty());
    size_t open = 0;
    std::vector<Ring> rings = joiner_.rings(open);
    if (open > 0)  // OpenSCAD closes it silently
      diagnostics_.note({make_source(name_, ""), 0, 0}, std::to_string(open) +
                                                            " lines or chains of lines do not close; a straight line "
                                                            "joins the ends of each");
    PlaneShapes shapes;
    if (!rings.empty()) shapes.shapes.push_back(std::move(rings));
    return shapes;
  }

 private:
  struct Map {
    double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
    Vec2 operator()(Vec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
    Map operator*(const Map& n) const {
      return {a * n.a + c * n.b, b * n.a + d * n.b,     a * n.c + c * n.d,
              b * n.c + d * n.d, a * n.e + c * n.f + e, b * n.e + d * n.f + f};
    }
  };

  void add(const DxfEntity& entity, const Map& map, int depth, bool is_wanted);
  void add_line(Ring line, const Map& map) {
    for (Vec2& p : line) p = map(p);
    points_ += line.size();
    if (points_ > most_points) fail(diagnostics_, name_, "the drawing has more than ten million points");
    joiner_.add(std::move(line));
  }
  int chords(double radius) const {
    return options_.chords_of_radius ? options_.chords_of_radius(radius) : options_.chords_per_turn;
  }
  void add_polyline(const DxfEntity& entity, const DxfValues& values, const Map& map);
  void add_ellipse(const DxfValues& values, const Map& map);
  void add_block(const DxfValues& values, const Map& map, int depth);

  std::string name_;
  TextScanner scanner_;
  std::string_view bytes_;
  const PlaneOptions& options_;
  Diagnostics& diagnostics_;
  size_t points_ = 0;
  DxfDocument document_;
  LineJoiner joiner_;
};

void DxfReader::add(const DxfEntity& entity, const Map& map, int depth, bool is_wanted) {
  const DxfValues values(scanner_, entity);
  if (!is_wanted && values.text(8) != options_.layer) return;
  const auto arc = [&](double begin, double turn) {
    const double radius = values.number(40);
    Ring ring;
    append_arc({values.point(10), {radius, 0}, {0, radius}, begin * math::degree, turn * math::degree}, chords(radius),
               ring);
    if (turn == 360) ring.back() = ring.front();
    add_line(std::move(ring), map);
  };
  if (entity.kind == "LINE")
    add_line({values.point(10), values.point(11)}, map);
  else if (entity.kind == "CIRCLE")
    arc(0, 360);
  else if (entity.kind == "ARC") {
    const double begin = values.number(50);
    double turn = std::fmod(values.number(51) - begin, 360);
    if (turn <= 0) turn += 360;
    arc(begin, turn);
  } else if (entity.kind == "LWPOLYLINE" || entity.kind == "POLYLINE")
    add_polyline(entity, values, map);
  else if (entity.kind == "ELLIPSE")
    add_ellipse(values, map);
  else if (entity.kind == "INSERT")
    add_block(values, map, depth);
}

void DxfReader::add_polyline(const DxfEntity& entity, const DxfValues& values, const Map& map) {
  std::vector<Vec2> corners = entity.vertices;
  std::vector<double> bulges = entity.bulges;
  if (entity.kind == "LWPOLYLINE")
    for (const DxfPair& pair : entity.pairs) {
      if (pair.code == 10) {
        corners.push_back({values.parsed(pair), 0});
        bulges.push_back(0);
      }
      if (corners.empty()) continue;
      if (pair.code == 20) corners.back().y = values.parsed(pair);
      if (pair.code == 42) bulges.back() = values.parsed(pair);
    }
  if (corners.size() < 2) return;
  const bool is_closed = static_cast<int64_t>(values.number(70)) & 1;
  Ring line{corners[0]};
  const size_t edges = corners.size() - (is_closed ? 0 : 1);
  for (size_t n = 0; n < edges; ++n)
    append_bulge(
        corners[n], corners[(n + 1) % corners.size()], bulges[n], [&](double radius) { return chords(radius); }, line);
  add_line(std::move(line), map);
}

void DxfReader::add_ellipse(const DxfValues& values, const Map& map) {
  constexpr double whole = 2 * std::numbers::pi;
  const Vec2 first = values.point(11);
  const double ratio = values.number(40, 1), begin = values.number(41), end = values.number(42, whole);
  double turn = std::fmod(end - begin, whole);
  if (turn <= 0) turn += whole;
  if (std::abs(end - begin - whole) < 1e-6) turn = whole;
  Ring ring;
  append_arc({values.point(10), first, {-ratio * first.y, ratio * first.x}, begin, turn}, chords(length(first)), ring);
  if (turn == whole) ring.back() = ring.front();
  add_line(std::move(ring), map);
}

void DxfReader::add_block(const DxfValues& values, const Map& map, int depth) {
  const auto block = document_.blocks.find(values.text(2));
  if (block == document_.blocks.end() || depth >= deepest) return;
  const double sx = values.number(41, 1), sy = values.number(42, 1), angle = values.number(50) * math::degree;
  const double c = math::cos(angle), s = math::sin(angle);
  const Vec2 at = values.point(10), base = block->second.base;
  const Map own{c * sx, s * sx, -s * sy, c * sy, at.x, at.y};
  const Map all = map * own * Map{1, 0, 0, 1, -base.x, -base.y};
  for (const DxfEntity& entity : block->second.entities) {
    add(entity, all, depth + 1, true);
    if (++points_ > most_points) fail(diagnostics_, name_, "the drawing's blocks have more than ten million lines");
  }
}

}  // namespace

std::optional<PlaneShapes> read_dxf(const std::string& name, std::string_view bytes, const PlaneOptions& options,
                                    Diagnostics& diagnostics) {
  try {
    return DxfReader(name, bytes, options, diagnostics).read();
  } catch (const DesignError&) {
    return std::nullopt;
  }
}

}  // namespace ombre::formats
