// Solids of CAD files as field sources.
#include "import/surfaces/cad_source.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "base/system/stopwatch.h"
#include "base/text/error.h"
#include "import/fields/channels.h"
#include "import/surfaces/closest_point.h"
#include "import/surfaces/mesh_source.h"

namespace ombre::importing {
namespace {

// Greatest distance of triangles from the surface in deflections; the library may exceed the requested deflection, but
// not by this factor.
constexpr double deflections_of_doubt = 4;

// Number of points whose time is measured.
constexpr int sampled_points = 500;
// Least radius of curvature, in reaches, at which a face counts as flat near its edges and corners.
constexpr double radii_of_reach = 4;
// Least cosine between the normals of faces that meet; at sharper edges the library decides.
constexpr double sharpest = -0.9;
// Distance from a face in mm below which the library decides.
constexpr double least_certain = 1e-7;
// Margin in mm around a solid's box for rounding.
constexpr double box_rounding = 1e-6;

formats::Mesh mesh_of(cad::Triangles part) {
  formats::Mesh mesh;
  mesh.vertices = std::move(part.vertices);
  mesh.triangles = std::move(part.triangles);
  return mesh;
}

void append_mesh(formats::Mesh& mesh, const formats::Mesh& part) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

// Queries that are not in use by any thread.
class QueryPool {
 public:
  explicit QueryPool(cad::SolidPtr solid) : solid_(std::move(solid)) {}

  template <class Ask>
  auto with(Ask ask) const {
    std::unique_ptr<cad::Query> query = take();
    const auto answer = ask(*query);
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(query));
    return answer;
  }

 private:
  std::unique_ptr<cad::Query> take() const {
    {
      const std::lock_guard lock(mutex_);
      if (!waiting_.empty()) {
        std::unique_ptr<cad::Query> query = std::move(waiting_.back());
        waiting_.pop_back();
        return query;
      }
    }
    return solid_->query();
  }

  cad::SolidPtr solid_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<cad::Query>> waiting_;
};

// Finds the faces of a solid near a point.
class FaceTree {
 public:
  FaceTree(const formats::Mesh& mesh, std::vector<uint32_t> face_of)
      : face_of_(std::move(face_of)), triangles_(std::make_unique<ClosestPoint>(surface_of(mesh))) {}

  // Returns the faces with a triangle within the distance, each once, in ascending order.
  std::vector<uint32_t> within(Vec3 p, double distance_mm) const {
    std::vector<uint32_t> faces;
    triangles_->visit_within(p, distance_mm, [&](uint32_t triangle) { faces.push_back(face_of_[triangle]); });
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

 private:
  static SurfacePtr surface_of(const formats::Mesh& mesh) {
    return std::make_shared<Surface>(Surface{mesh.vertices, mesh.triangles});
  }

  std::vector<uint32_t> face_of_;
  std::unique_ptr<ClosestPoint> triangles_;
};

// Returns the distance to a box, 0 inside it.
double distance_to(const Box& box, Vec3 p) {
  Vec3 beyond;
  for (int axis = 0; axis < 3; ++axis) beyond[axis] = std::max({box.lo[axis] - p[axis], p[axis] - box.hi[axis], 0.0});
  return length(beyond);
}

// A solid that decides what is inside by its triangles, except near its surface.
class ExactSolid {
 public:
  ExactSolid(cad::SolidPtr solid, program::SourceField triangles, std::optional<FaceTree> faces, double doubt_mm)
      : box_(solid->bounds.expanded(box_rounding)),
        pool_(std::move(solid)),
        triangles_(std::move(triangles)),
        distance_channel_(triangles_->channel("distance")),
        faces_(std::move(faces)),
        doubt_(doubt_mm) {}

  const Box& box() const { return box_; }

  // Returns a distance that differs from the exact one by at most the doubt.
  double near_distance(Vec3 p) const { return triangles_->sample(distance_channel_, p); }

  bool is_surely_inside(Vec3 p) const { return box_.contains(p) && near_distance(p) < -doubt_; }

  bool is_inside(Vec3 p) const { return box_.contains(p) && is_inside(p, near_distance(p)); }

  double distance(Vec3 p, double near) const {
    const double distance = pool_.with([&](cad::Query& query) { return query.surface_distance(p); });
    return is_inside(p, near) ? -distance : distance;
  }

 private:
  bool is_inside(Vec3 p, double near) const {
    if (std::abs(near) > doubt_) return near < 0;
    return pool_.with([&](cad::Query& query) {
      const std::optional<bool> by_faces = faces_ ? inside_faces(p, near, query) : std::nullopt;
      return by_faces ? *by_faces : query.is_inside(p);
    });
  }

  // Decides by the faces whose triangles are within reach; the nearest point of the surface is on one of them. At an
  // edge or a corner of several faces, p is on the inner side of at least one of them if it is inside the solid, and on
  // the outer side of at least one if it is outside. So if all faces agree, they are right. Returns null if they
  // disagree, or if they meet at so sharp an edge that curvature matters.
  std::optional<bool> inside_faces(Vec3 p, double near, cad::Query& query) const {
    const double reach = std::abs(near) + 2 * doubt_;
    std::vector<cad::FaceSide> sides;
    for (const uint32_t face : faces_->within(p, reach)) {
      const auto side = query.side_of_face(face, p, radii_of_reach * reach);
      if (!side || std::abs(side->distance) < least_certain) return std::nullopt;
      for (const cad::FaceSide& other : sides)
        if ((other.distance < 0) != (side->distance < 0) || dot(other.normal, side->normal) < sharpest)
          return std::nullopt;
      sides.push_back(*side);
    }
    if (sides.empty()) return std::nullopt;
    return sides.front().distance < 0;
  }

  Box box_;
  QueryPool pool_;
  program::SourceField triangles_;
  int distance_channel_;
  std::optional<FaceTree> faces_;  // null if the triangles are not closed
  double doubt_;
};

class ExactSource final : public program::NamedSource {
 public:
  ExactSource(std::string name, Hash content, double doubt_mm)
      : NamedSource(std::move(name), content), doubt_(doubt_mm) {}

  void add(const cad::SolidPtr& solid, program::SourceField triangles, std::optional<FaceTree> faces) {
    solids_.push_back(std::make_unique<ExactSolid>(solid, std::move(triangles), std::move(faces), doubt_));
    bounds_ = hull(bounds_, solid->bounds);
  }

  Box bounds() const override { return bounds_; }

  int channel(std::string_view channel_name) const override { return channel_of(channel_name); }

  double sample(int channel, Vec3 p) const override { return channel == inside_channel ? inside(p) : distance(p); }

  Interval range(int channel, const Box& box) const override {
    if (!box.is_bounded()) return channel == inside_channel ? Interval(0, 1) : Interval::everything();
    const double value = near_distance(box.center()), room = 0.5 * length(box.size()) + doubt_;
    if (channel == distance_channel) return outward(value - room, value + room);
    return value > room ? Interval(0) : value < -room ? Interval(1) : Interval(0, 1);
  }

 private:
  // Points surely inside one solid need no exact query of others.
  double inside(Vec3 p) const {
    if (!bounds_.contains(p)) return 0;
    if (std::ranges::any_of(solids_, [&](const auto& solid) { return solid->is_surely_inside(p); })) return 1;
    return std::ranges::any_of(solids_, [&](const auto& solid) { return solid->is_inside(p); }) ? 1 : 0;
  }

  double near_distance(Vec3 p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& solid : solids_)
      if (distance_to(solid->box(), p) < least) least = std::min(least, solid->near_distance(p));
    return least;
  }

  // Returns the least distance among the solids that may be the nearest.
  double distance(Vec3 p) const {
    const double farthest = near_distance(p) + 2 * doubt_;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& solid : solids_) {
      if (distance_to(solid->box(), p) > std::max(farthest, 0.0)) continue;
      const double near = solid->near_distance(p);
      if (near <= farthest) least = std::min(least, solid->distance(p, near));
    }
    return least;
  }

  double doubt_;
  std::vector<std::unique_ptr<ExactSolid>> solids_;
  Box bounds_;
};

void check_distances(const program::FieldSource& source) {
  if (source.channel("distance") < 0)
    throw Error(Code::library_missing,
                "CAD solids are not available: this build has no library for distances to triangles");
}

double area_of(const std::array<Vec3, 3>& t) { return length(cross(t[1] - t[0], t[2] - t[0])) / 2; }

// Returns the nth point of an even sequence in the triangle (Roberts 2018), moved along the normal.
Vec3 point_beside(const std::array<Vec3, 3>& t, int n, double doubt) {
  constexpr double first_step = 0.7548776662466927, second_step = 0.5698402909980532;
  double u = n * first_step - std::floor(n * first_step), v = n * second_step - std::floor(n * second_step);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const Vec3 across = cross(t[1] - t[0], t[2] - t[0]);
  const double aside = doubt * (n % 8 - 3.5) / 4;
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) + (aside / length(across)) * across;
}

// Adds points spread evenly by area, on both sides of the triangles.
void add_doubtful(const formats::Mesh& mesh, double doubt, CadSource& made) {
  const auto corners = [&](const auto& t) {
    return std::array<Vec3, 3>{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  };
  double area = 0;
  for (const auto& t : mesh.triangles) area += area_of(corners(t));
  made.doubtful_mm3 = 2 * doubt * area;
  const double step = area / sampled_points;
  double to_next = 0.5 * step;
  for (const auto& t : mesh.triangles) {
    to_next -= area_of(corners(t));
    for (; to_next < 0; to_next += step)
      made.doubtful_points.push_back(point_beside(corners(t), static_cast<int>(made.doubtful_points.size()), doubt));
  }
}

// Returns the source of the triangles: by nonzero winding numbers if they are closed, by generalized ones if the
// library left a seam open.
program::SourceField source_of(const std::string& name, formats::Mesh mesh, Hash content, bool is_closed) {
  const InsideRule rule = is_closed ? InsideRule::nonzero : InsideRule::generalized;
  program::SourceField source = make_mesh_source(name, std::move(mesh), content, {rule});
  check_distances(*source);
  return source;
}

}  // namespace

CadSource make_triangle_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                               double deflection_mm) {
  CadSource made;
  formats::Mesh all;
  for (const cad::SolidPtr& solid : solids) {
    const formats::Mesh mesh = mesh_of(solid->triangulate(deflection_mm));
    if (const auto edges = find_open_edges(mesh)) made.open.push_back({solid->name, *edges});
    append_mesh(all, mesh);
  }
  made.source = source_of(name, std::move(all), content, made.open.empty());
  return made;
}

double measure_doubtful_seconds(const CadSource& exact) {
  if (exact.doubtful_points.empty()) return 0;
  const auto query_all = [&] {
    const Stopwatch watch;
    for (const Vec3& p : exact.doubtful_points) exact.source->sample(inside_channel, p);
    return watch.seconds();
  };
  query_all();  // builds the solids' queries, which later calls reuse
  return query_all() / static_cast<double>(exact.doubtful_points.size());
}

CadSource make_exact_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                            double deflection_mm) {
  const double doubt = deflections_of_doubt * deflection_mm;
  CadSource made;
  formats::Mesh all;
  const auto source = std::make_shared<ExactSource>(name, content, doubt);
  for (const cad::SolidPtr& solid : solids) {
    cad::Triangles triangles = solid->triangulate(deflection_mm);
    std::vector<uint32_t> face_of = std::move(triangles.faces);
    formats::Mesh mesh = mesh_of(std::move(triangles));
    const auto edges = find_open_edges(mesh);
    if (edges && edges->gap_mm > doubt) made.open.push_back({solid->name, *edges});
    append_mesh(all, mesh);
    std::optional<FaceTree> faces;
    if (!edges && has_mesh_distance()) faces.emplace(mesh, std::move(face_of));
    source->add(solid, source_of(name, std::move(mesh), content, !edges), std::move(faces));
  }
  add_doubtful(all, doubt, made);
  made.source = source;
  return made;
}

}  // namespace ombre::importing
