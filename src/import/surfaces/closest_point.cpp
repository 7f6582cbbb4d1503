// The distance from a point to a mesh.
#include "import/surfaces/closest_point.h"

#ifdef OMBRE_EMBREE_VERSION

#include <array>
#include <bit>
#include <cmath>
#include <future>
#include <limits>

#include "base/system/module_loader.h"
#include "base/text/error.h"
#include "import/fields/triangle_distance.h"
#include "import/surfaces/embree_calls.h"
#include "import/surfaces/triangle_clusters.h"

namespace ombre::importing {

bool has_mesh_distance() { return true; }

namespace {

constexpr Module embree_module{"ombre_embree",        "Embree",
                               "distances to meshes", "libembree-dev",
                               "OMBRE_MESH_DISTANCE", "ask only for the inside of meshes"};

// Embree is loaded when a distance is first needed.
const EmbreeCalls& embree() {
  static const EmbreeCalls& calls = *load_function<decltype(ombre_embree_calls)>(embree_module, "ombre_embree_calls")();
  return calls;
}

// Rounding of vertices, points and boxes to Embree's single precision, relative to the mesh's size.
constexpr double rounding_room = 16 * std::numeric_limits<float>::epsilon();

struct Release {
  void operator()(RTCDevice device) const { embree().release_device(device); }
  void operator()(RTCScene scene) const { embree().release_scene(scene); }
  void operator()(RTCGeometry geometry) const { embree().release_geometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using Scene = std::unique_ptr<RTCSceneTy, Release>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release>;

struct Query {
  const Surface* surface;
  const TriangleCluster* clusters;
  Vec3 point;
  std::array<float, 3> at;  // in the frame
  double scale, room;       // scale of the frame; margin added to radii in it

  Query(const Surface& of, const std::vector<TriangleCluster>& all, const Frame& frame, Vec3 p)
      : surface(&of), clusters(all.data()), point(p), scale(frame.scale) {
    const Vec3 framed = frame(p);
    at = {static_cast<float>(framed.x), static_cast<float>(framed.y), static_cast<float>(framed.z)};
    room = rounding_room * (1 + length(framed));
  }

  float radius(double distance_mm) const { return static_cast<float>(distance_mm * scale + room); }

  // Calls take for each triangle of a cluster that may be within the radius.
  template <class Take>
  void each_within(uint32_t cluster, float radius, const Take& take) const {
    const TriangleCluster& all = clusters[cluster];
    for (uint32_t left = all.within(at, radius); left != 0; left &= left - 1)
      take(all.triangles[static_cast<size_t>(std::countr_zero(left))]);
  }
};

struct Search {
  Query query;
  double squared = std::numeric_limits<double>::infinity();
  ClosestPoint::Nearest nearest = {};

  // Returns true if the triangle is nearer than all before.
  bool take(uint32_t triangle) {
    const double found = squared_distance(query.point, query.surface->corners(triangle));
    if (found >= squared) return false;
    squared = found;
    nearest = {std::sqrt(found), triangle};
    return true;
  }
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
  Search& search = *static_cast<Search*>(arguments->userPtr);
  bool is_nearer = false;
  search.query.each_within(arguments->primID, search.query.radius(search.nearest.distance_mm),
                           [&](uint32_t triangle) { is_nearer |= search.take(triangle); });
  if (is_nearer) arguments->query->radius = search.query.radius(search.nearest.distance_mm);
  return is_nearer;
}

struct Neighbours {
  Query query;
  double distance_mm;
  const std::function<void(uint32_t)>* visit;
};

bool visit_neighbours(RTCPointQueryFunctionArguments* arguments) {
  const Neighbours& search = *static_cast<Neighbours*>(arguments->userPtr);
  const Query& query = search.query;
  query.each_within(arguments->primID, query.radius(search.distance_mm), [&](uint32_t triangle) {
    const double squared = squared_distance(query.point, query.surface->corners(triangle));
    if (squared <= search.distance_mm * search.distance_mm) (*search.visit)(triangle);
  });
  return false;
}

void bounds_of_cluster(const RTCBoundsFunctionArguments* arguments) {
  const TriangleCluster& cluster = static_cast<const TriangleCluster*>(arguments->geometryUserPtr)[arguments->primID];
  RTCBounds& box = *arguments->bounds_o;
  box.lower_x = cluster.lo[0];
  box.lower_y = cluster.lo[1];
  box.lower_z = cluster.lo[2];
  box.upper_x = cluster.hi[0];
  box.upper_y = cluster.hi[1];
  box.upper_z = cluster.hi[2];
}

}  // namespace

struct ClosestPoint::Tree {
  SurfacePtr surface;
  Frame frame;
  std::vector<TriangleCluster> clusters;
  Device device;
  Scene scene;

  explicit Tree(SurfacePtr of)
      : surface(std::move(of)),
        frame(bounds(*surface)),
        clusters(cluster_triangles(*surface, frame)),
        device(embree().new_device(nullptr)) {
    if (!device) throw Error("Embree, which measures distances to meshes, cannot start on this machine");
    scene.reset(embree().new_scene(device.get()));
    embree().set_scene_flags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    add_clusters();
    embree().commit_scene(scene.get());
    if (embree().get_device_error(device.get()) != RTC_ERROR_NONE)
      throw Error(Code::memory,
                  "Embree cannot build the search tree for distances to a mesh (is there enough memory?)");
  }

  void add_clusters() {
    const Geometry geometry(embree().new_geometry(device.get(), RTC_GEOMETRY_TYPE_USER));
    embree().set_primitive_count(geometry.get(), static_cast<unsigned>(clusters.size()));
    embree().set_user_data(geometry.get(), clusters.data());
    embree().set_bounds(geometry.get(), bounds_of_cluster, nullptr);
    embree().commit_geometry(geometry.get());
    embree().attach_geometry(scene.get(), geometry.get());
  }

  Query query_at(Vec3 p) const { return {*surface, clusters, frame, p}; }

  void ask(const Query& at, double distance_mm, RTCPointQueryFunction answer, void* search) const {
    RTCPointQuery query{};
    query.x = at.at[0];
    query.y = at.at[1];
    query.z = at.at[2];
    query.radius = at.radius(distance_mm);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    embree().point_query(scene.get(), &query, &context, answer, search);
  }

  void visit_within(Vec3 p, double distance_mm, const std::function<void(uint32_t)>& visit) const {
    Neighbours search{query_at(p), distance_mm, &visit};
    ask(search.query, distance_mm, visit_neighbours, &search);
  }

  Nearest nearest(Vec3 p, uint32_t guess) const {
    Search search{query_at(p)};
    if (guess != none) search.take(guess);
    ask(search.query, search.nearest.distance_mm, visit, &search);
    // The point is so far away that Embree's single-precision numbers overflow.
    if (search.nearest.triangle == none)
      for (uint32_t n = 0; n < surface->triangles.size(); ++n) search.take(n);
    return search.nearest;
  }
};

// Embree builds its tree with tasks. A separate thread isolates them: a worker thread of this project that waits for
// the tree must not start other work that needs the same tree.
ClosestPoint::ClosestPoint(SurfacePtr surface)
    : tree_(std::async(std::launch::async, [&] { return std::make_unique<Tree>(std::move(surface)); }).get()) {}

ClosestPoint::~ClosestPoint() = default;

ClosestPoint::Nearest ClosestPoint::nearest(Vec3 p, uint32_t guess) const {
  return is_finite(p) ? tree_->nearest(p, guess) : Nearest{};
}

void ClosestPoint::visit_within(Vec3 p, double distance_mm, const std::function<void(uint32_t)>& visit) const {
  if (is_finite(p)) tree_->visit_within(p, distance_mm, visit);
}

}  // namespace ombre::importing

#else

#include <limits>

#include "base/system/assert.h"

namespace ombre::importing {

bool has_mesh_distance() { return false; }

struct ClosestPoint::Tree {};
ClosestPoint::ClosestPoint(SurfacePtr) { ASSERT(has_mesh_distance()); }
ClosestPoint::~ClosestPoint() = default;
ClosestPoint::Nearest ClosestPoint::nearest(Vec3, uint32_t) const { return {}; }
void ClosestPoint::visit_within(Vec3, double, const std::function<void(uint32_t)>&) const {}

}  // namespace ombre::importing

#endif
