// Reads DXF files, as text.
#include <charconv>
#include <cmath>
#include <map>

#include "base/text.h"
#include "formats/arcs.h"
#include "formats/plane_files.h"
#include "formats/text_scanner.h"

namespace ombre::formats {
namespace {

constexpr int deepest = 16;  // blocks within each other
constexpr size_t most_points = 10'000'000;

// A code that says what the value is.
struct Pair {
  int code = 0;
  std::string_view value;
  size_t begin = 0, end = 0;  // of the value
};

struct Entity {
  std::string_view kind;
  std::vector<Pair> pairs;
  std::vector<Vec2> vertices = {};  // of polylines
  std::vector<double> bulges = {};  // one for each
};

// Numbers of one entity, each by its code.
class Values {
 public:
  Values(const TextScanner& scanner, const Entity& entity) : scanner_(scanner), entity_(entity) {}

  double number(int code, double otherwise = 0) const {
    for (const Pair& pair : entity_.pairs)
      if (pair.code == code) return parsed(pair);
    return otherwise;
  }
  Vec2 point(int code) const { return {number(code), number(code + 10)}; }
  std::string_view text(int code) const {
    for (const Pair& pair : entity_.pairs)
      if (pair.code == code) return pair.value;
    return {};
  }

  double parsed(const Pair& pair) const {
    const auto number = parse_number(pair.value);
    if (!number || std::abs(*number) > 1e15)
      scanner_.fail_at(pair.begin, pair.end,
                       "a number is expected for code " + std::to_string(pair.code) + ", not " + quoted(pair.value));
    return *number;
  }

 private:
  const TextScanner& scanner_;
  const Entity& entity_;
};

// A quarter of the angle that an arc between two points spans has this tangent.
void append_bulge(Vec2 from, Vec2 to, double bulge, int chords, Ring& ring) {
  if (bulge == 0) {
    ring.push_back(to);
    return;
  }
  const double turn = 4 * math::atan(bulge);
  const Vec2 chord = to - from, middle = 0.5 * (from + to);
  const double rise = (1 - bulge * bulge) / (4 * bulge);  // of the center from the chord, in chords
  const Vec2 center = middle + rise * Vec2{-chord.y, chord.x};
  const Vec2 first = from - center;
  Ring arc;
  append_arc({center, first, {-first.y, first.x}, 0, turn}, chords, arc);
  ring.insert(ring.end(), arc.begin() + 1, arc.end() - 1);
  ring.push_back(to);
}

// Joins lines whose ends meet.
class LineJoiner {
 public:
  void add(Ring line) {
    if (line.size() > 1) lines_.push_back(std::move(line));
  }

  // Closed rings; `open` counts lines that do not close.
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
      while (key(ring.front()) != key(ring.back())) {
        const auto next = unused_at(key(ring.back()), used);
        if (!next) break;
        used[*next] = true;
        Ring line = lines_[*next];
        if (key(line.front()) != key(ring.back())) std::reverse(line.begin(), line.end());
        ring.insert(ring.end(), line.begin() + 1, line.end());
      }
      if (key(ring.front()) != key(ring.back())) {
        ++open;
        continue;
      }
      ring.pop_back();
      if (ring.size() > 2) rings.push_back(std::move(ring));
    }
    return rings;
  }

 private:
  using Key = std::pair<int64_t, int64_t>;
  static Key key(Vec2 p) {
    constexpr double places_per_mm = 1000;  // beyond that, ends meet
    return {std::llround(p.x * places_per_mm), std::llround(p.y * places_per_mm)};
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
    read_sections();
    for (const Entity& entity : entities_) add(entity, {1, 0, 0, 1, 0, 0}, 0, options_.layer.empty());
    size_t open = 0;
    std::vector<Ring> rings = joiner_.rings(open);
    if (open > 0)
      diagnostics_.warning({make_source(name_, ""), 0, 0},
                           std::to_string(open) + " lines or chains of lines do not close and are left out",
                           "join their ends in the program that made the file");
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

  std::string_view line() {
    const size_t end = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size());
    std::string_view text = bytes_.substr(at_, end - at_);
    at_ = end;
    if (bytes_.substr(at_).starts_with("\r\n")) ++at_;
    if (at_ < bytes_.size()) ++at_;
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
  }

  bool next(Pair& pair) {
    if (at_ >= bytes_.size()) return false;
    const size_t begin = at_;
    const std::string_view code = line();
    if (code.empty() && at_ >= bytes_.size()) return false;
    const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), pair.code);
    if (error != std::errc() || end != code.data() + code.size())
      scanner_.fail_at(begin, begin + std::max<size_t>(1, code.size()),
                       "a group code is expected, a whole number, not " + quoted(code),
                       "save the drawing as DXF in text form");
    pair.begin = at_;
    pair.value = line();
    pair.end = pair.begin + pair.value.size();
    return true;
  }

  void read_sections();
  // The entities up to the end of a section or block.
  void read_entities(std::vector<Entity>& entities, Pair& pair);
  void read_blocks(Pair& pair);
  void add_vertex(std::vector<Entity>& entities, const Entity& vertex) const;

  void add(const Entity& entity, const Map& map, int depth, bool is_wanted);
  void add_line(Ring line, const Map& map) {
    for (Vec2& p : line) p = map(p);
    points_ += line.size();
    if (points_ > most_points) fail(diagnostics_, name_, "the drawing has more than ten million points");
    joiner_.add(std::move(line));
  }
  void add_polyline(const Entity& entity, const Values& values, const Map& map);
  void add_ellipse(const Values& values, const Map& map);
  void add_block(const Values& values, const Map& map, int depth);

  std::string name_;
  TextScanner scanner_;
  std::string_view bytes_;
  const PlaneOptions& options_;
  Diagnostics& diagnostics_;
  size_t at_ = 0, points_ = 0;
  std::vector<Entity> entities_;
  struct Block {
    Vec2 base;
    std::vector<Entity> entities;
  };
  std::map<std::string, Block, std::less<>> blocks_;
  LineJoiner joiner_;
};

void DxfReader::read_sections() {
  Pair pair;
  bool has_entities = false;
  while (next(pair)) {
    if (pair.code != 0 || pair.value != "SECTION" || !next(pair)) continue;
    if (pair.value == "BLOCKS") read_blocks(pair);
    if (pair.value != "ENTITIES") continue;
    has_entities = true;
    read_entities(entities_, pair);
  }
  if (!has_entities) fail(diagnostics_, name_, "there is no section ENTITIES", "save the drawing as DXF in text form");
}

void DxfReader::read_entities(std::vector<Entity>& entities, Pair& pair) {
  Entity entity;
  const auto finish = [&] {
    if (entity.kind == "VERTEX")
      add_vertex(entities, entity);
    else if (!entity.kind.empty() && entity.kind != "SEQEND")
      entities.push_back(entity);
    entity = {};
  };
  while (next(pair)) {
    if (pair.code != 0) {
      if (!entity.kind.empty()) entity.pairs.push_back(pair);
      continue;
    }
    finish();
    if (pair.value == "ENDSEC" || pair.value == "ENDBLK") return;
    entity.kind = pair.value;
  }
  finish();
}

void DxfReader::read_blocks(Pair& pair) {
  while (next(pair)) {
    if (pair.code == 0 && pair.value == "ENDSEC") return;
    if (pair.code != 0 || pair.value != "BLOCK") continue;
    std::vector<Entity> entities{{"BLOCK", {}}};
    // The block's own values stand before its first entity.
    const size_t begin = at_;
    while (next(pair) && pair.code != 0) entities[0].pairs.push_back(pair);
    const Values values(scanner_, entities[0]);
    Block block{values.point(10), {}};
    const std::string name(values.text(2));
    at_ = begin;
    read_entities(block.entities, pair);
    blocks_[name] = std::move(block);
  }
}

void DxfReader::add_vertex(std::vector<Entity>& entities, const Entity& vertex) const {
  if (entities.empty() || entities.back().kind != "POLYLINE") return;
  const Values values(scanner_, vertex);
  entities.back().vertices.push_back(values.point(10));
  entities.back().bulges.push_back(values.number(42));
}

void DxfReader::add(const Entity& entity, const Map& map, int depth, bool is_wanted) {
  const Values values(scanner_, entity);
  if (!is_wanted && values.text(8) != options_.layer) return;
  const auto arc = [&](double begin, double turn) {
    const double radius = values.number(40);
    Ring ring;
    append_arc({values.point(10), {radius, 0}, {0, radius}, begin * math::degree, turn * math::degree},
               options_.chords_per_turn, ring);
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

void DxfReader::add_polyline(const Entity& entity, const Values& values, const Map& map) {
  std::vector<Vec2> corners = entity.vertices;
  std::vector<double> bulges = entity.bulges;
  if (entity.kind == "LWPOLYLINE")
    for (const Pair& pair : entity.pairs) {
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
    append_bulge(corners[n], corners[(n + 1) % corners.size()], bulges[n], options_.chords_per_turn, line);
  add_line(std::move(line), map);
}

void DxfReader::add_ellipse(const Values& values, const Map& map) {
  constexpr double whole = 2 * std::numbers::pi;
  const Vec2 first = values.point(11);
  const double ratio = values.number(40, 1), begin = values.number(41), end = values.number(42, whole);
  double turn = std::fmod(end - begin, whole);
  if (turn <= 0) turn += whole;
  if (std::abs(end - begin - whole) < 1e-6) turn = whole;
  Ring ring;
  append_arc({values.point(10), first, {-ratio * first.y, ratio * first.x}, begin, turn}, options_.chords_per_turn,
             ring);
  if (turn == whole) ring.back() = ring.front();
  add_line(std::move(ring), map);
}

void DxfReader::add_block(const Values& values, const Map& map, int depth) {
  const auto block = blocks_.find(values.text(2));
  if (block == blocks_.end() || depth >= deepest) return;
  const double sx = values.number(41, 1), sy = values.number(42, 1), angle = values.number(50) * math::degree;
  const double c = math::cos(angle), s = math::sin(angle);
  const Vec2 at = values.point(10), base = block->second.base;
  const Map own{c * sx, s * sx, -s * sy, c * sy, at.x, at.y};
  const Map all = map * own * Map{1, 0, 0, 1, -base.x, -base.y};
  for (const Entity& entity : block->second.entities) {
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
