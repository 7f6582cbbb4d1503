// Reads DXF files, as text.
#include <array>
#include <cmath>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/drawings/arcs.h"
#include "formats/drawings/dxf_curves.h"
#include "formats/drawings/dxf_entities.h"
#include "formats/drawings/dxf_hatch.h"
#include "formats/drawings/line_joiner.h"
#include "formats/drawings/plane_files.h"

namespace ombre::formats {
namespace {

constexpr int deepest = 64;  // greatest depth of nested blocks
constexpr size_t most_dxf_points = 10'000'000;

// Returns the direction in which an entity is extruded.
Vec3 normal_of(const DxfValues& values) {
  const Vec3 normal{values.number(210, 0), values.number(220, 0), values.number(230, 1)};
  const double size = length(normal);
  return size > 0 ? (1 / size) * normal : Vec3{0, 0, 1};
}

// Returns the map from an entity's own coordinates to the plane of the drawing, seen from above (DXF reference,
// "Arbitrary Axis Algorithm").
PlaneMap own_plane(const Vec3& normal, double elevation) {
  if (normal == Vec3{0, 0, 1}) return {};
  constexpr double near_z = 1.0 / 64;
  const bool is_near_z = std::abs(normal.x) < near_z && std::abs(normal.y) < near_z;
  const Vec3 across = cross(is_near_z ? Vec3{0, 1, 0} : Vec3{0, 0, 1}, normal);
  const Vec3 x = (1 / length(across)) * across, y = cross(normal, x);
  return {x.x, x.y, y.x, y.y, elevation * normal.x, elevation * normal.y};
}

// Returns a point inside of a ring: in the middle of its first crossing with a level between two of its points.
std::optional<Vec2> point_inside(const Ring& ring) {
  std::vector<double> levels;
  for (const Vec2& p : ring) levels.push_back(p.y);
  std::ranges::sort(levels);
  for (size_t n = 0; n + 1 < levels.size(); ++n) {
    const double y = 0.5 * (levels[n] + levels[n + 1]);
    if (!(y > levels[n] && y < levels[n + 1])) continue;
    std::vector<double> crossings;
    for (size_t k = 0; k < ring.size(); ++k) {
      const Vec2 a = ring[k], b = ring[(k + 1) % ring.size()];
      if ((a.y < y) != (b.y < y)) crossings.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
    std::ranges::sort(crossings);
    if (crossings.size() > 1 && crossings[1] > crossings[0]) return Vec2{0.5 * (crossings[0] + crossings[1]), y};
  }
  return std::nullopt;
}

bool encloses(const Ring& ring, Vec2 p) {
  bool is_inside = false;
  for (size_t n = 0; n < ring.size(); ++n) {
    const Vec2 a = ring[n], b = ring[(n + 1) % ring.size()];
    if ((a.y < p.y) != (b.y < p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) is_inside = !is_inside;
  }
  return is_inside;
}

class DxfReader {
 public:
  DxfReader(const std::string& name, std::string_view bytes, const PlaneOptions& options, Diagnostics& diagnostics)
      : name_(name), scanner_(name, bytes, diagnostics), bytes_(bytes), options_(options), diagnostics_(diagnostics) {
    chords_ = options.chords_of_radius ? options.chords_of_radius : [&](double) { return options_.chords_per_turn; };
  }

  PlaneShapes read() {
    document_ = read_dxf_document(name_, bytes_, scanner_, diagnostics_);
    for (const DxfEntity& entity : document_.entities) add(entity, {}, 0, options_.layer.empty());
    JoinedLines joined = joiner_.join();
    add_fills(joined.rings);
    tell(joined);
    if (!joined.rings.empty()) shapes_.shapes.push_back({std::move(joined.rings), false, {}, {}});
    return std::move(shapes_);
  }

 private:
  void add(const DxfEntity& entity, const PlaneMap& map, int depth, bool is_wanted);
  bool add_curve(const DxfEntity& entity, const DxfValues& values, const PlaneMap& map);
  void add_line(Ring line, const PlaneMap& map) {
    place(line, map);
    joiner_.add(std::move(line));
  }
  void place(Ring& line, const PlaneMap& map) {
    constexpr double farthest = 1e15;
    count(line.size());
    for (Vec2& p : line) {
      p = map(p);
      if (!(std::abs(p.x) <= farthest && std::abs(p.y) <= farthest))
        fail(diagnostics_, name_, "the drawing reaches farther than 10^15");
    }
  }
  void count(size_t points) {
    if ((points_ += points) > most_dxf_points)
      fail(diagnostics_, name_, "the drawing has more than ten million points");
  }
  void add_arc(const DxfValues& values, double begin, double turn, const PlaneMap& map);
  void add_polyline(const DxfEntity& entity, const DxfValues& values, const PlaneMap& map);
  void add_ellipse(const DxfValues& values, const PlaneMap& map);
  void add_spline(const DxfEntity& entity, const DxfValues& values, const PlaneMap& map);
  void add_block(const DxfEntity& entity, const DxfValues& values, const PlaneMap& map, int depth);
  void add_fill(std::vector<Ring> rings, const std::string& kind, const PlaneMap& map);
  void add_fills(const std::vector<Ring>& rings);
  void tell(const JoinedLines& joined);
  [[noreturn]] void fail_at(const DxfEntity& entity, const std::string& message, const std::string& hint = "") const;

  struct Fill {
    std::vector<Ring> rings;
    std::string kind;
  };

  std::string name_;
  TextScanner scanner_;
  std::string_view bytes_;
  const PlaneOptions& options_;
  Diagnostics& diagnostics_;
  ChordsOfRadius chords_;
  size_t points_ = 0;
  DxfDocument document_;
  LineJoiner joiner_;
  std::vector<Fill> fills_;
  PlaneShapes shapes_;
};

void DxfReader::fail_at(const DxfEntity& entity, const std::string& message, const std::string& hint) const {
  if (entity.pairs.empty()) fail(diagnostics_, name_, message, hint);
  scanner_.fail_at(entity.pairs[0].begin, entity.pairs[0].end, message, hint);
}

void DxfReader::add(const DxfEntity& entity, const PlaneMap& map, int depth, bool is_wanted) {
  const DxfValues values(scanner_, entity);
  if (!is_wanted && values.text(8) != options_.layer) return;
  const bool is_on_paper = values.flags(67) == 1, is_invisible = values.flags(60) == 1;
  if (is_on_paper || is_invisible) return;
  if (add_curve(entity, values, map)) return;
  const PlaneMap own = map * own_plane(normal_of(values), values.number(38, values.number(30)));
  if (entity.kind == "INSERT") return add_block(entity, values, own, depth);
  if (entity.kind == "HATCH") return add_fill(borders_of_hatch(scanner_, entity, chords_), "HATCH", own);
  if (entity.kind == "SOLID" || entity.kind == "TRACE") {
    const Ring corners{values.point(10), values.point(11), values.point(13), values.point(12)};
    return add_fill({corners}, std::string(entity.kind), own);
  }
  // Marks, windows to paper and the texts that blocks only suggest.
  constexpr std::array<std::string_view, 4> no_matter{"POINT", "VIEWPORT", "ATTDEF", "BLOCK"};
  if (std::ranges::find(no_matter, entity.kind) == no_matter.end()) ++shapes_.left_out[std::string(entity.kind)];
}

// Adds an entity that consists of lines; returns false for others. Lines, ellipses and splines have the coordinates of
// the drawing, the others those of their own plane.
bool DxfReader::add_curve(const DxfEntity& entity, const DxfValues& values, const PlaneMap& map) {
  const auto own = [&](double elevation) { return map * own_plane(normal_of(values), elevation); };
  if (entity.kind == "LINE")
    add_line({values.point(10), values.point(11)}, map);
  else if (entity.kind == "CIRCLE")
    add_arc(values, 0, 360, own(values.number(30)));
  else if (entity.kind == "ARC") {
    const double begin = values.number(50);
    double turn = std::fmod(values.number(51) - begin, 360);
    if (turn <= 0) turn += 360;
    add_arc(values, begin, turn, own(values.number(30)));
  } else if (entity.kind == "LWPOLYLINE")
    add_polyline(entity, values, own(values.number(38)));
  else if (entity.kind == "POLYLINE") {
    constexpr int64_t in_space = 8, meshes = 16 | 64;
    if (values.flags(70) & meshes) return false;
    add_polyline(entity, values, values.flags(70) & in_space ? map : own(values.number(30)));
  } else if (entity.kind == "ELLIPSE")
    add_ellipse(values, map);
  else if (entity.kind == "SPLINE")
    add_spline(entity, values, map);
  else
    return false;
  return true;
}

void DxfReader::add_arc(const DxfValues& values, double begin, double turn, const PlaneMap& map) {
  const double radius = values.number(40);
  Ring ring;
  append_arc({values.point(10), {radius, 0}, {0, radius}, begin * math::degree, turn * math::degree}, chords_(radius),
             ring);
  if (turn == 360) ring.back() = ring.front();
  add_line(std::move(ring), map);
}

void DxfReader::add_polyline(const DxfEntity& entity, const DxfValues& values, const PlaneMap& map) {
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
  const bool is_closed = values.flags(70) & 1;
  Ring line{corners[0]};
  const size_t edges = corners.size() - (is_closed ? 0 : 1);
  for (size_t n = 0; n < edges; ++n) append_bulge(corners[(n + 1) % corners.size()], bulges[n], chords_, line);
  add_line(std::move(line), map);
}

void DxfReader::add_ellipse(const DxfValues& values, const PlaneMap& map) {
  constexpr double whole = 2 * std::numbers::pi;
  const Vec3 first{values.number(11), values.number(21), values.number(31)};
  const Vec3 second = values.number(40, 1) * cross(normal_of(values), first);
  const double begin = values.number(41), end = values.number(42, whole);
  double turn = std::fmod(end - begin, whole);
  if (turn <= 0) turn += whole;
  if (std::abs(end - begin - whole) < 1e-6) turn = whole;
  Ring ring;
  append_arc({values.point(10), {first.x, first.y}, {second.x, second.y}, begin, turn}, chords_(length(first)), ring);
  if (turn == whole) ring.back() = ring.front();
  add_line(std::move(ring), map);
}

void DxfReader::add_spline(const DxfEntity& entity, const DxfValues& values, const PlaneMap& map) {
  DxfSpline spline;
  spline.degree = static_cast<int>(values.number(71, 3));
  spline.is_closed = values.flags(70) & 1;
  spline.parameters = values.numbers(40);
  spline.weights = values.numbers(41);
  spline.controls = values.points(10);
  spline.fits = values.points(11);
  if (!values.text(12).empty()) spline.first_way = values.point(12);
  if (!values.text(13).empty()) spline.last_way = values.point(13);
  Ring curve = curve_of(spline);
  if (curve.empty())
    fail_at(entity,
            "a SPLINE of degree " + std::to_string(spline.degree) + " has " + std::to_string(spline.controls.size()) +
                " control points and " + std::to_string(spline.parameters.size()) + " knots, which do not fit together",
            "give it one knot more than control points and degree together, in ascending order");
  add_line(std::move(curve), map);
}

void DxfReader::add_block(const DxfEntity& entity, const DxfValues& values, const PlaneMap& map, int depth) {
  const auto block = document_.blocks.find(values.text(2));
  if (block == document_.blocks.end()) {
    ++shapes_.left_out["INSERT of missing blocks"];
    return;
  }
  if (depth >= deepest) fail_at(entity, "blocks lie more than 64 deep within each other, or a block holds itself");
  const double sx = values.number(41, 1), sy = values.number(42, 1), angle = values.number(50) * math::degree;
  const double c = math::cos(angle), s = math::sin(angle);
  const Vec2 at = values.point(10), base = block->second.base;
  const double columns = std::max(1.0, values.number(70, 1)), rows = std::max(1.0, values.number(71, 1));
  const Vec2 step{values.number(44), values.number(45)};
  if (columns * rows > static_cast<double>(most_dxf_points)) count(most_dxf_points + 1);
  const PlaneMap turned = map * PlaneMap{c, s, -s, c, at.x, at.y};
  for (double row = 0; row < rows; ++row)
    for (double column = 0; column < columns; ++column) {
      const PlaneMap all = turned * PlaneMap{sx, 0, 0, sy, column * step.x - sx * base.x, row * step.y - sy * base.y};
      count(1);
      for (const DxfEntity& inner : block->second.entities) {
        add(inner, all, depth + 1, true);
        count(1);
      }
    }
}

void DxfReader::add_fill(std::vector<Ring> rings, const std::string& kind, const PlaneMap& map) {
  for (Ring& ring : rings) place(ring, map);
  fills_.push_back({std::move(rings), kind});
}

// Fills mark areas that lines bound, as a rule; where no line does, they are areas.
void DxfReader::add_fills(const std::vector<Ring>& rings) {
  constexpr size_t most_tests = 200'000'000;
  size_t points = 0, tests = 0;
  for (const Ring& ring : rings) points += ring.size();
  for (Fill& fill : fills_) {
    const auto inside = fill.rings.empty() ? std::nullopt : point_inside(fill.rings[0]);
    if (!inside) {
      ++shapes_.left_out[fill.kind];
      continue;
    }
    if ((tests += points) > most_tests) fail(diagnostics_, name_, "the drawing has too many fills and lines");
    const auto around = [&](const Ring& ring) { return encloses(ring, *inside); };
    if (std::ranges::none_of(rings, around)) shapes_.shapes.push_back({std::move(fill.rings), false, {}, {}});
  }
}

void DxfReader::tell(const JoinedLines& joined) {
  const SourceRange where{make_source(name_, ""), 0, 0};
  constexpr double of_rounding = 1e-6;
  if (joined.joined_gap > of_rounding)
    diagnostics_.note(where, "ends of lines up to " + format_rounded(joined.joined_gap, 3) +
                                 " apart are joined; the tolerance is " + format_rounded(joined.tolerance, 3));
  if (joined.doubles > 0)
    diagnostics_.note(where, std::to_string(joined.doubles) + " lines lie on others; each counts once");
  if (joined.open > 0)  // OpenSCAD closes it silently
    diagnostics_.note(where, std::to_string(joined.open) + " chains of lines do not close within " +
                                 format_rounded(joined.tolerance, 3) +
                                 "; a straight line joins the ends of each, at most " +
                                 format_rounded(joined.widest_gap, 3) + " long");
  if (joined.single > 0) shapes_.left_out["lines that enclose nothing"] += joined.single;
  if (!shapes_.left_out.empty())
    diagnostics_.warning(where, "left out of the drawing: " + text_of_left_out(shapes_.left_out),
                         "turn them into closed lines in the program that made the file");
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
