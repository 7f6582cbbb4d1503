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

formats::Mesh mesh_of(const std::vector<cad::SolidPtr>& solids, double deflection_mm) {
  formats::Mesh mesh;
  for (const cad::SolidPtr& solid : solids) {
    const cad::Triangles part = solid->triangulate(deflection_mm);
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
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

class ExactSource final : public program::FieldSource {
 public:
  ExactSource(std::string name, const std::vector<cad::SolidPtr>& solids, Hash content, double deflection_mm)
      : name_(std::move(name)),
        content_(content),
        triangles_(make_triangle_source(name_, solids, content, deflection_mm)),
        triangle_distance_(triangles_->channel("distance")),
        doubt_(deflections_of_doubt * deflection_mm) {
    for (const cad::SolidPtr& solid : solids) {
      queries_.push_back(std::make_unique<QueryPool>(solid));
      bounds_ = hull(bounds_, solid->bounds);
    }
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
  double near_distance(Vec3 p) const { return triangles_->sample(triangle_distance_, p); }

  double inside(Vec3 p) const {
    if (!bounds_.contains(p)) return 0;
    const double value = near_distance(p);
    if (std::abs(value) > doubt_) return value < 0 ? 1 : 0;
    const auto holds = [&](const auto& pool) { return pool->with([&](cad::Query& q) { return q.is_inside(p); }); };
    return std::any_of(queries_.begin(), queries_.end(), holds) ? 1 : 0;
  }

  double distance(Vec3 p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& pool : queries_)
      least = std::min(least, pool->with([&](cad::Query& query) {
        const double distance = query.surface_distance(p);
        return query.is_inside(p) ? -distance : distance;
      }));
    return least;
  }

  std::string name_;
  Hash content_;
  program::SourceField triangles_;
  int triangle_distance_;
  double doubt_;
  std::vector<std::unique_ptr<QueryPool>> queries_;
  Box bounds_;
};

void check_distances(const program::FieldSource& source) {
  if (source.channel("distance") < 0)
    throw Error("CAD solids are not available: this build has no library for distances to triangles");
}

}  // namespace

program::SourceField make_triangle_source(const std::string& name, const std::vector<cad::SolidPtr>& solids,
                                          Hash content, double deflection_mm) {
  formats::Mesh mesh = mesh_of(solids, deflection_mm);
  // A seam that the library left open is narrower than the deflection.
  const InsideRule rule = inspect(mesh).is_closed() ? InsideRule::nonzero : InsideRule::generalized;
  program::SourceField source = make_mesh_source(name, std::move(mesh), content, {rule});
  check_distances(*source);
  return source;
}

program::SourceField make_exact_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                                       double deflection_mm) {
  return std::make_shared<ExactSource>(name, solids, content, deflection_mm);
}

}  // namespace ombre::importing
