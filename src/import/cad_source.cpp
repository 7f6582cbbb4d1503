// Solids of CAD files as field sources.
#include "import/cad_source.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "base/error.h"
#include "import/channels.h"
#include "import/mesh_source.h"

namespace ombre::importing {
namespace {

// Triangles may be farther from the surface than the library was asked for, but not by so much.
constexpr double deflections_of_doubt = 4;

// A solid is in its box, but for rounding; mm.
constexpr double box_rounding = 1e-6;

formats::Mesh mesh_of(const cad::Solid& solid, double deflection_mm) {
  cad::Triangles part = solid.triangulate(deflection_mm);
  formats::Mesh mesh;
  mesh.vertices = std::move(part.vertices);
  mesh.triangles = std::move(part.triangles);
  return mesh;
}

void append(formats::Mesh& mesh, const formats::Mesh& part) {
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

// 0 within it.
double distance_to(const Box& box, Vec3 p) {
  Vec3 beyond;
  for (int axis = 0; axis < 3; ++axis) beyond[axis] = std::max({box.lo[axis] - p[axis], p[axis] - box.hi[axis], 0.0});
  return length(beyond);
}

// A solid whose triangles decide what is inside where they leave no doubt.
class ExactSolid {
 public:
  ExactSolid(cad::SolidPtr solid, program::SourceField triangles, double doubt_mm)
      : box_(solid->bounds.expanded(box_rounding)),
        pool_(std::move(solid)),
        triangles_(std::move(triangles)),
        distance_channel_(triangles_->channel("distance")),
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
    return pool_.with([&](cad::Query& query) { return query.is_inside(p); });
  }

  Box box_;
  QueryPool pool_;
  program::SourceField triangles_;
  int distance_channel_;
  double doubt_;
};

class ExactSource final : public program::FieldSource {
 public:
  ExactSource(std::string name, Hash content, double doubt_mm)
      : name_(std::move(name)), content_(content), doubt_(doubt_mm) {}

  void add(const cad::SolidPtr& solid, program::SourceField triangles) {
    solids_.push_back(std::make_unique<ExactSolid>(solid, std::move(triangles), doubt_));
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
    throw Error("CAD solids are not available: this build has no library for distances to triangles");
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
    const formats::Mesh mesh = mesh_of(*solid, deflection_mm);
    if (const auto edges = find_open_edges(mesh)) made.open.push_back({solid->name, *edges});
    append(all, mesh);
  }
  made.source = source_of(name, std::move(all), content, made.open.empty());
  return made;
}

CadSource make_exact_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                            double deflection_mm) {
  const double doubt = deflections_of_doubt * deflection_mm;
  CadSource made;
  const auto source = std::make_shared<ExactSource>(name, content, doubt);
  for (const cad::SolidPtr& solid : solids) {
    formats::Mesh mesh = mesh_of(*solid, deflection_mm);
    const auto edges = find_open_edges(mesh);
    if (edges && edges->gap_mm > doubt) made.open.push_back({solid->name, *edges});
    source->add(solid, source_of(name, std::move(mesh), content, !edges));
  }
  made.source = source;
  return made;
}

}  // namespace ombre::importing
