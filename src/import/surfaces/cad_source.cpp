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

// Triangles may be farther from the surface than the library was asked for, but not by so much.
constexpr double deflections_of_doubt = 4;

// Points whose time is measured.
constexpr int sampled_points = 500;
// Faces are taken for flat, as their edges and corners need it, where they are curved by radii of so many reaches.
constexpr double radii_of_reach = 4;
// Normals of faces that meet, as a cosine: sharper edges are left to the library.
constexpr double sharpest = -0.9;
// So close to a face, mm, the library decides.
constexpr double least_certain = 1e-7;
// A solid is in its box, but for rounding; mm.
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

// Queries that wait for a thread.
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

// Which faces of a solid are near.
class FaceTree {
 public:
  FaceTree(const formats::Mesh& mesh, std::vector<uint32_t> face_of)
      : face_of_(std::move(face_of)), triangles_(std::make_unique<ClosestPoint>(surface_of(mesh))) {}

  // Those with triangles that are no farther away; each once, ascending.
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

// 0 within it.
double distance_to(const Box& box, Vec3 p) {
  Vec3 beyond;
  for (int axis = 0; axis < 3; ++axis) beyond[axis] = std::max({box.lo[axis] - p[axis], p[axis] - box.hi[axis], 0.0});
  return length(beyond);
}

// A solid whose triangles decide what is inside where they leave no doubt.
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

  // No farther from the distance than the doubt.
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

  // The surface is nearest to p at one of the faces whose triangles are in reach. At an edge or a corner of several, p
  // is inside one of them at least if it is inside the solid, and outside of one at least if it is outside. So where
  // all agree they are right; nothing where they do not, or where faces turn back so sharply that curvature counts.
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
  std::optional<FaceTree> faces_;  // where triangles close
  double doubt_;
};

class ExactSource final : public program::FieldSource {
 public:
  ExactSource(std::string name, Hash content, double doubt_mm)
      : name_(std::move(name)), content_(content), doubt_(doubt_mm) {}

  void add(const cad::SolidPtr& solid, program::SourceField triangles, std::optional<FaceTree> faces) {
    solids_.push_back(std::make_unique<ExactSolid>(solid, std::move(triangles), std::move(faces), doubt_));
    bounds_ = hull(bounds_, solid->bounds);
  }

  std::string name() const override { return name_; }
  Hash content() const override { return content_; }
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
  // What is clear of one solid spares questions about others.
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

  // Of the solids that may be the nearest.
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

  std::string name_;
  Hash content_;
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

// The nth point of an even sequence in the triangle (Roberts 2018), moved along the normal.
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

// Points at equal steps of the area, on both sides of the triangles.
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

// Closed triangles have the nonzero winding number. A seam that the library left open gets the generalized one.
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
  query_all();  // builds the solids' queries, which later ones find
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
