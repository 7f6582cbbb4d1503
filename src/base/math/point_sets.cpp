// Convex hulls, Delaunay and Voronoi edges, computed by Qhull.
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include "base/math/point_set_checks.h"
#include "base/math/point_sets.h"
#include "base/system/not_copied.h"
#include "base/text/error.h"

#ifdef OMBRE_QHULL

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace ombre {
namespace {

// A million cells take some 5 GB while they are made.
constexpr size_t most_of_hull = 100'000, most_with_cells = 1'000'000;

// A run of Qhull over points. Its facets are valid as long as the object lives.
class Qhull : NotCopied {
 public:
  Qhull(std::span<const Vec3> points, const char* command)
      : count_(points.size()), silence_(std::fopen("/dev/null", "w")) {
    if (!silence_) throw Error("/dev/null cannot be opened");
    for (const Vec3& p : points) coordinates_.insert(coordinates_.end(), {p.x, p.y, p.z});
    qh_zero(&qh_, silence_.get());
    std::string words = command;
    failed_ = qh_new_qhull(&qh_, 3, static_cast<int>(points.size()), coordinates_.data(), 0, words.data(), nullptr,
                           silence_.get()) != 0;
  }
  ~Qhull() {
    qh_freeqhull(&qh_, 0);
    int blocks = 0, bytes = 0;
    qh_memfreeshort(&qh_, &blocks, &bytes);
  }

  bool failed() const { return failed_; }
  qhT* handle() { return &qh_; }

  template <class Visit>
  void for_facets(const Visit& visit) {
    for (facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next) visit(*facet);
  }

  // Returns the indices of the facet's points in ascending order, without the point at infinity.
  std::vector<size_t> corners(const facetT& facet) {
    std::vector<size_t> numbers;
    for_each<vertexT>(facet.vertices, [&](const vertexT& vertex) {
      const int number = qh_pointid(&qh_, vertex.point);
      if (number >= 0 && static_cast<size_t>(number) < count_) numbers.push_back(static_cast<size_t>(number));
    });
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  }

  template <class Visit>
  void for_neighbours(const facetT& facet, const Visit& visit) {
    for_each<facetT>(facet.neighbors, visit);
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  template <class T, class Visit>
  static void for_each(setT* set, const Visit& visit) {
    if (!set) return;
    for (setelemT* element = set->e; element->p; ++element) visit(*static_cast<T*>(element->p));
  }

  size_t count_;
  std::unique_ptr<std::FILE, Close> silence_;
  std::vector<double> coordinates_;
  qhT qh_{};
  bool failed_ = false;
};

constexpr const char* no_answer = "the points are too close to a plane, a line or each other for their rounding";

bool is_before(Vec3 a, Vec3 b) { return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z}; }

// Sorts the ends of each edge, then the edges, by coordinates.
void put_in_order(std::vector<Edge3>& edges) {
  for (Edge3& edge : edges)
    if (is_before(edge[1], edge[0])) std::swap(edge[0], edge[1]);
  std::sort(edges.begin(), edges.end(), [](const Edge3& a, const Edge3& b) {
    return is_before(a[0], b[0]) || (a[0] == b[0] && is_before(a[1], b[1]));
  });
}

// Returns the part of the line from + t * way, t in [0, most], that lies in the box.
std::optional<Edge3> cut(Vec3 from, Vec3 way, double most, const Box& box) {
  double begin = 0, end = most;
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) {
      if (from[axis] < box.lo[axis] || from[axis] > box.hi[axis]) return std::nullopt;
      continue;
    }
    const double a = (box.lo[axis] - from[axis]) / way[axis], b = (box.hi[axis] - from[axis]) / way[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  if (!(begin < end)) return std::nullopt;
  const Vec3 first = begin == 0 ? from : from + begin * way, last = end == 1 ? from + way : from + end * way;
  return Edge3{first, last};
}

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum;
  for (const Vec3& p : points) sum = sum + p;
  return (1 / static_cast<double>(points.size())) * sum;
}

// Returns the normal of the face shared by two Voronoi cells, pointing away from `middle`; nothing if the face has no
// area.
std::optional<Vec3> outward(std::span<const Vec3> points, const std::vector<size_t>& corners, Vec3 middle) {
  if (corners.size() < 3) return std::nullopt;
  const Vec3 a = points[corners[0]];
  Vec3 best;
  for (size_t i = 1; i < corners.size(); ++i)
    for (size_t j = i + 1; j < corners.size(); ++j) {
      const Vec3 area = cross(points[corners[i]] - a, points[corners[j]] - a);
      if (length(area) > length(best)) best = area;
    }
  if (!(length(best) > 0)) return std::nullopt;
  best = (1 / length(best)) * best;
  return dot(best, a - middle) < 0 ? -best : best;
}

Vec3 center_of(const facetT& facet) { return {facet.center[0], facet.center[1], facet.center[2]}; }

}  // namespace

bool knows_point_sets() { return true; }

OfPoints<Plane> hull_planes(std::span<const Vec3> points) {
  if (std::string problem = problem_of_points(points, 4, most_of_hull, true); !problem.empty())
    return {{}, std::move(problem)};
  Qhull hull(points, "qhull Pp");
  if (hull.failed()) return {{}, no_answer};
  OfPoints<Plane> planes;
  hull.for_facets([&](const facetT& facet) {
    const Vec3 normal{facet.normal[0], facet.normal[1], facet.normal[2]};
    double offset = -facet.offset;
    for (const size_t corner : hull.corners(facet)) offset = std::max(offset, dot(normal, points[corner]));
    planes.list.push_back({normal, offset});
  });
  std::sort(planes.list.begin(), planes.list.end(),
            [](const Plane& a, const Plane& b) { return is_before(a.normal, b.normal); });
  return planes;
}

namespace {

// Calls visit(corners) for each tetrahedron of the Delaunay triangulation. Returns what is wrong with the points, if
// anything is.
template <class Visit>
std::string for_tetrahedra(std::span<const Vec3> points, const Visit& visit) {
  if (std::string problem = problem_of_points(points, 5, most_with_cells, false); !problem.empty()) return problem;
  Qhull cells(points, "qhull d Qt Qbb Qc Qz Q12 Pp");
  if (cells.failed()) return no_answer;
  cells.for_facets([&](const facetT& facet) {
    if (!facet.upperdelaunay) visit(cells.corners(facet));
  });
  return {};
}

template <class List>
void sort_without_repeated(List& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

OfPoints<Edge3> delaunay_edges(std::span<const Vec3> points) {
  std::vector<std::array<size_t, 2>> pairs;
  std::string problem = for_tetrahedra(points, [&](const std::vector<size_t>& corners) {
    for (size_t i = 0; i < corners.size(); ++i)
      for (size_t j = i + 1; j < corners.size(); ++j) pairs.push_back({corners[i], corners[j]});
  });
  if (!problem.empty()) return {{}, std::move(problem)};
  sort_without_repeated(pairs);
  OfPoints<Edge3> edges;
  for (const auto [a, b] : pairs) edges.list.push_back({points[a], points[b]});
  return edges;
}

OfPoints<std::array<size_t, 4>> delaunay_tetrahedra(std::span<const Vec3> points) {
  OfPoints<std::array<size_t, 4>> found;
  found.problem = for_tetrahedra(points, [&](const std::vector<size_t>& corners) {
    if (corners.size() == 4) found.list.push_back({corners[0], corners[1], corners[2], corners[3]});
  });
  std::sort(found.list.begin(), found.list.end());
  return found;
}

OfPoints<std::array<Vec3, 3>> delaunay_faces(std::span<const Vec3> points) {
  std::vector<std::array<size_t, 3>> triples;
  std::string problem = for_tetrahedra(points, [&](const std::vector<size_t>& corners) {
    for (size_t i = 0; i < corners.size(); ++i)
      for (size_t j = i + 1; j < corners.size(); ++j)
        for (size_t k = j + 1; k < corners.size(); ++k) triples.push_back({corners[i], corners[j], corners[k]});
  });
  if (!problem.empty()) return {{}, std::move(problem)};
  sort_without_repeated(triples);
  OfPoints<std::array<Vec3, 3>> faces;
  for (const auto [a, b, c] : triples) faces.list.push_back({points[a], points[b], points[c]});
  return faces;
}

OfPoints<Edge3> voronoi_edges(std::span<const Vec3> points, const std::optional<Box>& box) {
  if (std::string problem = problem_of_points(points, 5, most_with_cells, false); !problem.empty())
    return {{}, std::move(problem)};
  Qhull cells(points, "qhull v Qbb Qc Qz Q12 Pp");
  if (cells.failed()) return {{}, no_answer};
  qh_setvoronoi_all(cells.handle());
  const Vec3 middle = mean_of(points);
  OfPoints<Edge3> edges;
  const auto add = [&](Vec3 from, Vec3 way, double most) {
    if (!box) {
      edges.list.push_back({from, from + way});
    } else if (const auto part = cut(from, way, most, *box)) {
      edges.list.push_back(*part);
    }
  };
  cells.for_facets([&](const facetT& facet) {
    if (facet.upperdelaunay || !facet.center) return;
    cells.for_neighbours(facet, [&](const facetT& other) {
      if (!other.upperdelaunay) {
        if (facet.id < other.id && other.center && !(center_of(facet) == center_of(other)))
          add(center_of(facet), center_of(other) - center_of(facet), 1);
        return;
      }
      if (!box) return;
      std::vector<size_t> common;
      const std::vector<size_t> mine = cells.corners(facet), others = cells.corners(other);
      std::set_intersection(mine.begin(), mine.end(), others.begin(), others.end(), std::back_inserter(common));
      if (const auto way = outward(points, common, middle)) add(center_of(facet), *way, Box::inf);
    });
  });
  put_in_order(edges.list);
  return edges;
}

}  // namespace ombre

#else

namespace ombre {

bool knows_point_sets() { return false; }

namespace {
constexpr const char* no_library =
    "this ombre was built without Qhull; install libqhull-dev, configure with -DOMBRE_QHULL=ON and build again";
}

OfPoints<Plane> hull_planes(std::span<const Vec3>) { return {{}, no_library}; }
OfPoints<Edge3> delaunay_edges(std::span<const Vec3>) { return {{}, no_library}; }
OfPoints<std::array<size_t, 4>> delaunay_tetrahedra(std::span<const Vec3>) { return {{}, no_library}; }
OfPoints<std::array<Vec3, 3>> delaunay_faces(std::span<const Vec3>) { return {{}, no_library}; }
OfPoints<Edge3> voronoi_edges(std::span<const Vec3>, const std::optional<Box>&) { return {{}, no_library}; }

}  // namespace ombre

#endif
