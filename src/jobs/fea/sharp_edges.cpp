#include "jobs/fea/sharp_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/math/disjoint_sets.h"
#include "base/math/line_simplification.h"

namespace ombre::compile {
namespace {

constexpr double sharp_cosine = 0.766;   // cosine of 40 degrees between normals
constexpr double corner_cosine = 0.766;  // cosine between a line's directions before and after a corner
// Lengths, as multiples of the element size. The shortest line with an open end; the shortest sum of connected lines
// with an open end; the distance at which ends become one corner; distances of fixed points from each other, and from
// the lowest one.
constexpr double least_length = 0.5, least_open_length = 4, join_length = 0.05;
constexpr double spacing = 0.7, reach = 2;

using Key = std::array<double, 3>;
using Edge = std::pair<uint32_t, uint32_t>;  // the point with the lesser number first

// Points of all bodies, without duplicates.
class Points {
 public:
  uint32_t add(Vec3 p) {
    // Maps -0 to +0, so that equal keys compare equal.
    const Key key{p.x + 0.0, p.y + 0.0, p.z + 0.0};
    const auto [place, is_new] = numbers_.emplace(key, static_cast<uint32_t>(all.size()));
    if (is_new) all.push_back(p);
    return place->second;
  }
  std::vector<Vec3> all;

 private:
  std::map<Key, uint32_t> numbers_;
};

class EdgeFinder {
 public:
  EdgeFinder(double tolerance_mm, double size_mm) : tolerance_mm_(tolerance_mm), size_mm_(size_mm) {}

  void add(const surface::Body& body) {
    std::vector<uint32_t> numbers;
    for (const Vec3& p : body.vertices) numbers.push_back(points_.add(p));
    std::map<Edge, std::vector<Vec3>> normals;
    DisjointSets sets(body.vertices.size());
    for (const auto& triangle : body.triangles) {
      const Vec3 a = body.vertices[triangle[0]], b = body.vertices[triangle[1]], c = body.vertices[triangle[2]];
      const Vec3 normal = cross(b - a, c - a);
      for (size_t n = 0; n < 3; ++n) {
        const uint32_t from = triangle[n], to = triangle[(n + 1) % 3];
        sets.join(from, to);
        if (length(normal) > 0) normals[std::minmax(from, to)].push_back((1 / length(normal)) * normal);
      }
    }
    std::vector<bool> has_edge(body.vertices.size());
    for (const auto& [edge, both] : normals) {
      if (!is_sharp_edge(both)) continue;
      edges_.push_back(std::minmax(numbers[edge.first], numbers[edge.second]));
      has_edge[sets.root(edge.first)] = true;
    }
    add_smooth_points(body, sets, has_edge);
    add_face_points(body, normals);
  }

  SharpEdges lines() {
    std::ranges::sort(edges_);
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    neighbours_.resize(points_.all.size());
    degrees_.resize(points_.all.size());
    for (const auto& [a, b] : edges_) {
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
      ++degrees_[a], ++degrees_[b];
    }
    // Open lines begin where the number of edges is not two; the remaining edges are rings.
    std::vector<Vertices> lines;
    for (uint32_t n = 0; n < neighbours_.size(); ++n)
      if (degrees_[n] != 2)
        while (!neighbours_[n].empty()) lines.push_back(line_from(n));
    for (uint32_t n = 0; n < neighbours_.size(); ++n)
      while (!neighbours_[n].empty()) lines.push_back(line_from(n));
    drop_scraps(lines);
    join_near_corners(lines);
    for (const Vertices& line : lines) keep(line);
    drop_doubled();
    return std::move(found_);
  }

 private:
  using Vertices = std::vector<uint32_t>;

  // Adds a vertex and those near it, but none too close to another one that was added.
  void add_patch(const surface::Body& body, const Vertices& vertices, uint32_t middle, std::vector<Vec3>& found) const {
    const auto add = [&](Vec3 p) {
      if (std::ranges::all_of(found, [&](Vec3 q) { return length(p - q) >= spacing * size_mm_; })) found.push_back(p);
    };
    const Vec3 p = body.vertices[middle];
    add(p);
    for (const uint32_t n : vertices)
      if (length(body.vertices[n] - p) < reach * size_mm_) add(body.vertices[n]);
  }

  // Adds points of each surface without sharp edges: the lowest point, points around it, and the outermost along each
  // axis. A mesher sees a surface where its points lie close together, and goes on from there.
  void add_smooth_points(const surface::Body& body, DisjointSets& sets, const std::vector<bool>& has_edge) {
    std::map<uint32_t, Vertices> surfaces;
    for (uint32_t n = 0; n < body.vertices.size(); ++n)
      if (const uint32_t root = sets.root(n); !has_edge[root]) surfaces[root].push_back(n);
    const auto place = [&](uint32_t n) { return body.vertices[n]; };
    for (const auto& [root, vertices] : surfaces) {
      std::vector<Vec3> found;
      add_patch(body, vertices, *std::ranges::min_element(vertices, {}, [&](uint32_t n) { return place(n).z; }), found);
      for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::ranges::minmax_element(vertices, {}, [&](uint32_t n) { return place(n)[axis]; });
        add_patch(body, {}, *low, found);
        add_patch(body, {}, *high, found);
      }
      keep_new(found, found_.smooth_points);
    }
  }

  // Adds the vertex of each face that is farthest from sharp edges, and a few vertices around that one.
  void add_face_points(const surface::Body& body, const std::map<Edge, std::vector<Vec3>>& normals) {
    std::vector<bool> is_sharp(body.vertices.size());
    DisjointSets sets(body.vertices.size());
    for (const auto& [edge, both] : normals)
      if (is_sharp_edge(both)) is_sharp[edge.first] = is_sharp[edge.second] = true;
    Vertices edge_points;
    for (uint32_t n = 0; n < is_sharp.size(); ++n)
      if (is_sharp[n]) edge_points.push_back(n);
    if (edge_points.empty()) return;
    for (const auto& [edge, both] : normals) {
      if (is_sharp[edge.first] || is_sharp[edge.second]) continue;
      sets.join(edge.first, edge.second);
    }
    std::map<uint32_t, Vertices> faces;
    for (uint32_t n = 0; n < is_sharp.size(); ++n)
      if (!is_sharp[n]) faces[sets.root(n)].push_back(n);
    for (const auto& [root, vertices] : faces) {
      const uint32_t middle = farthest(body, vertices, edge_points);
      std::vector<Vec3> found;
      add_patch(body, vertices, middle, found);
      if (distance(body, middle, edge_points) > reach * size_mm_) keep_new(found, found_.face_points);
    }
  }

  static double distance(const surface::Body& body, uint32_t from, const Vertices& to) {
    double least = std::numeric_limits<double>::infinity();
    for (const uint32_t n : to) least = std::min(least, length(body.vertices[n] - body.vertices[from]));
    return least;
  }

  // Returns the farthest of some of the vertices; searching all would take long.
  static uint32_t farthest(const surface::Body& body, const Vertices& vertices, const Vertices& from) {
    constexpr size_t most = 200;
    const size_t step = 1 + vertices.size() / most;
    uint32_t best = vertices.front();
    double most_mm = -1;
    for (size_t n = 0; n < vertices.size(); n += step)
      if (const double here = distance(body, vertices[n], from); here > most_mm) most_mm = here, best = vertices[n];
    return best;
  }

  static void keep_new(const std::vector<Vec3>& points, std::vector<Vec3>& all) {
    for (const Vec3 p : points)
      if (std::ranges::find(all, p) == all.end()) all.push_back(p);
  }

  static bool is_sharp_edge(const std::vector<Vec3>& normals) {
    return normals.size() == 2 && dot(normals[0], normals[1]) <= sharp_cosine;
  }

  void forget(uint32_t a, uint32_t b) {
    std::erase(neighbours_[a], b);
    std::erase(neighbours_[b], a);
  }

  // Takes the edges from a point up to the next point where the number of edges is not two.
  std::vector<uint32_t> line_from(uint32_t first) {
    std::vector<uint32_t> line{first};
    uint32_t next = neighbours_[first].front();
    forget(first, next);
    line.push_back(next);
    // One edge is left at a point where two met.
    while (degrees_[next] == 2 && neighbours_[next].size() == 1) {
      const uint32_t after = neighbours_[next].front();
      forget(next, after);
      line.push_back(after);
      next = after;
    }
    return line;
  }

  double length_of(const Vertices& line) const {
    double sum = 0;
    for (size_t n = 0; n + 1 < line.size(); ++n) sum += length(points_.all[line[n + 1]] - points_.all[line[n]]);
    return sum;
  }

  bool ends_nowhere(const Vertices& line) const { return degrees_[line.front()] == 1 || degrees_[line.back()] == 1; }

  // Drops short lines with an open end, and connected lines that are short together if one has an open end. Rough
  // surfaces have such sharp edges here and there, and no mesh needs them.
  void drop_scraps(std::vector<Vertices>& lines) {
    DisjointSets sets(points_.all.size());
    for (const Vertices& line : lines) {
      sets.join(line.front(), line.back());
    }
    std::map<uint32_t, double> lengths;
    std::map<uint32_t, bool> is_open;
    for (const Vertices& line : lines) {
      const uint32_t root = sets.root(line.front());
      lengths[root] += length_of(line);
      is_open[root] |= ends_nowhere(line);
    }
    std::erase_if(lines, [&](const Vertices& line) {
      const uint32_t root = sets.root(line.front());
      if (is_open[root] && lengths[root] < least_open_length * size_mm_) return true;
      return ends_nowhere(line) && length_of(line) < least_length * size_mm_;
    });
  }

  // Joins ends of lines that are far shorter than elements to one corner, since elements would have to be as small.
  void join_near_corners(std::vector<Vertices>& lines) {
    DisjointSets sets(points_.all.size());
    const auto is_short = [&](const Vertices& line) { return length_of(line) < join_length * size_mm_; };
    for (const Vertices& line : lines) {
      if (!is_short(line)) continue;
      sets.join(line.front(), line.back());
    }
    std::erase_if(lines, is_short);
    for (Vertices& line : lines) {
      line.front() = sets.root(line.front());
      line.back() = sets.root(line.back());
    }
  }

  void keep(const Vertices& line) {
    std::vector<Vec3> points;
    for (const uint32_t n : line) points.push_back(points_.all[n]);
    const bool is_ring = line.front() == line.back();
    std::vector<Vec3> simple;
    if (is_ring) {
      // A ring is simplified in two halves, since it has no direction as a whole.
      const auto far = farthest_from_first(points);
      simple = simplified({points.begin(), points.begin() + far + 1});
      const auto rest = simplified({points.begin() + far, points.end()});
      simple.insert(simple.end(), rest.begin() + 1, rest.end());
    } else {
      simple = simplified(points);
    }
    if (is_ring && simple.size() < 4) return;  // there and back
    split(simple, is_ring);
  }

  // Drops rings whose simplified sides are the same line. They belong to slivers of the surface, and are not edges.
  void drop_doubled() {
    using Ends = std::pair<Key, Key>;
    const auto key = [](Vec3 p) { return Key{p.x, p.y, p.z}; };
    const auto ends = [&](const std::vector<Vec3>& line) -> Ends {
      return std::minmax(key(line.front()), key(line.back()));
    };
    std::map<Ends, int> counts;
    for (const auto& line : found_.lines)
      if (line.size() == 2) ++counts[ends(line)];
    std::erase_if(found_.lines, [&](const auto& line) { return line.size() == 2 && counts[ends(line)] > 1; });
  }

  static ptrdiff_t farthest_from_first(const std::vector<Vec3>& points) {
    const auto far = std::ranges::max_element(points, {}, [&](Vec3 p) { return length(p - points.front()); });
    return far - points.begin();
  }

  // Leaves out points that lie within the tolerance of the line.
  std::vector<Vec3> simplified(const std::vector<Vec3>& points) const {
    const auto distance = [&](size_t n, size_t begin, size_t end) {
      const Vec3 along = points[end] - points[begin], away = points[n] - points[begin];
      const double share = dot(along, along) > 0 ? std::clamp(dot(away, along) / dot(along, along), 0.0, 1.0) : 0;
      return length(away - share * along);
    };
    const std::vector<bool> kept = kept_points(points.size(), tolerance_mm_, distance);
    std::vector<Vec3> left;
    for (size_t n = 0; n < points.size(); ++n)
      if (kept[n]) left.push_back(points[n]);
    return left;
  }

  static bool turns_at(Vec3 before, Vec3 at, Vec3 after) {
    const Vec3 a = at - before, b = after - at;
    return dot(a, b) < corner_cosine * length(a) * length(b);
  }

  // Splits a line where it turns sharply.
  void split(std::vector<Vec3> points, bool is_ring) {
    if (is_ring && points.size() > 3) {
      // A ring begins in a corner, if it has any.
      points.pop_back();
      const size_t count = points.size();
      size_t corner = 0;
      while (corner < count &&
             !turns_at(points[(corner + count - 1) % count], points[corner], points[(corner + 1) % count]))
        ++corner;
      if (corner < count) std::rotate(points.begin(), points.begin() + static_cast<ptrdiff_t>(corner), points.end());
      points.push_back(points.front());
    }
    std::vector<Vec3> line{points.front()};
    for (size_t n = 1; n < points.size(); ++n) {
      line.push_back(points[n]);
      if (n + 1 == points.size() || !turns_at(points[n - 1], points[n], points[n + 1])) continue;
      found_.lines.push_back(line);
      line = {points[n]};
    }
    found_.lines.push_back(line);
  }

  double tolerance_mm_, size_mm_;
  Points points_;
  std::vector<Edge> edges_;
  std::vector<std::vector<uint32_t>> neighbours_;
  std::vector<uint32_t> degrees_;
  SharpEdges found_;
};

}  // namespace

SharpEdges find_sharp_edges(const std::vector<surface::Body>& bodies, double tolerance_mm, double size_mm) {
  EdgeFinder finder(tolerance_mm, size_mm);
  for (const surface::Body& body : bodies) finder.add(body);
  return finder.lines();
}

}  // namespace ombre::compile
