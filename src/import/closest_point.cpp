// The distance from a point to a mesh.
#include "import/closest_point.h"

#ifdef OMBRE_EMBREE_VERSION

#include <cmath>
#include <future>
#include <limits>

#include "base/error.h"
#include "base/module_loader.h"
#include "import/embree_calls.h"
#include "import/triangle_distance.h"

namespace ombre::importing {

bool has_mesh_distance() { return true; }

namespace {

constexpr Module embree_module{"ombre_embree",        "Embree",
                               "distances to meshes", "libembree-dev",
                               "OMBRE_MESH_DISTANCE", "ask only for the inside of meshes"};

// Loaded when the first distance is asked for.
const EmbreeCalls& embree() {
  static const EmbreeCalls& calls = *load_function<decltype(ombre_embree_calls)>(embree_module, "ombre_embree_calls")();
  return calls;
}

// Of Embree's single precision, relative to the mesh's size: rounded vertices, points and boxes.
constexpr double rounding_room = 16 * std::numeric_limits<float>::epsilon();

struct Release {
  void operator()(RTCDevice device) const { embree().release_device(device); }
  void operator()(RTCScene scene) const { embree().release_scene(scene); }
  void operator()(RTCGeometry geometry) const { embree().release_geometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using Scene = std::unique_ptr<RTCSceneTy, Release>;
using Geometry = std::unique_ptr<RTCGeometryTy, Release>;

// Embree sees the mesh moved and scaled into a cube of half-width one.
struct Frame {
  Vec3 center;
  double scale = 1;

  explicit Frame(const Box& box) : center(box.center()) {
    const Vec3 half = 0.5 * box.size();
    const double widest = std::max({half.x, half.y, half.z});
    if (widest > 0) scale = 1 / widest;
  }
  Vec3 operator()(Vec3 p) const { return scale * (p - center); }
};

struct Search {
  const Surface* surface;
  Vec3 point;
  double scale;
  double room;                                            // added to radii, in the frame
  double best = std::numeric_limits<double>::infinity();  // squared
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
  Search& search = *static_cast<Search*>(arguments->userPtr);
  const double squared = squared_distance(search.point, search.surface->corners(arguments->primID));
  if (squared >= search.best) return false;
  search.best = squared;
  arguments->query->radius = static_cast<float>(std::sqrt(squared) * search.scale + search.room);
  return true;
}

struct Neighbours {
  const Surface* surface;
  Vec3 point;
  double squared_distance;
  const std::function<void(uint32_t)>* visit;
};

bool visit_neighbour(RTCPointQueryFunctionArguments* arguments) {
  const Neighbours& search = *static_cast<Neighbours*>(arguments->userPtr);
  if (squared_distance(search.point, search.surface->corners(arguments->primID)) <= search.squared_distance)
    (*search.visit)(arguments->primID);
  return false;
}

}  // namespace

struct ClosestPoint::Tree {
  SurfacePtr surface;
  Frame frame;
  Device device;
  Scene scene;

  explicit Tree(SurfacePtr of) : surface(std::move(of)), frame(bounds(*surface)), device(embree().new_device(nullptr)) {
    if (!device) throw Error("Embree, which measures distances to meshes, cannot start on this machine");
    scene.reset(embree().new_scene(device.get()));
    embree().set_scene_flags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    add_triangles();
    embree().commit_scene(scene.get());
    if (embree().get_device_error(device.get()) != RTC_ERROR_NONE)
      throw Error(Code::memory,
                  "Embree cannot build the search tree for distances to a mesh (is there enough memory?)");
  }

  void add_triangles() {
    const Geometry geometry(embree().new_geometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* const points = static_cast<float*>(embree().set_new_geometry_buffer(
        geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), surface->vertices.size()));
    auto* const corners = static_cast<uint32_t*>(embree().set_new_geometry_buffer(
        geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), surface->triangles.size()));
    if (points == nullptr || corners == nullptr) throw Error(Code::memory, "out of memory for distances to a mesh");
    for (size_t i = 0; i < surface->vertices.size(); ++i) {
      const Vec3 p = frame(surface->vertices[i]);
      for (int axis = 0; axis < 3; ++axis) points[3 * i + axis] = static_cast<float>(p[axis]);
    }
    for (size_t i = 0; i < surface->triangles.size(); ++i)
      for (size_t corner = 0; corner < 3; ++corner) corners[3 * i + corner] = surface->triangles[i][corner];
    embree().commit_geometry(geometry.get());
    embree().attach_geometry(scene.get(), geometry.get());
  }

  void ask(Vec3 at, double radius, RTCPointQueryFunction answer, void* search) const {
    RTCPointQuery query{};
    query.x = static_cast<float>(at.x);
    query.y = static_cast<float>(at.y);
    query.z = static_cast<float>(at.z);
    query.radius = static_cast<float>(radius);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    embree().point_query(scene.get(), &query, &context, answer, search);
  }

  static double room_at(Vec3 at) { return rounding_room * (1 + length(at)); }

  void visit_within(Vec3 p, double distance_mm, const std::function<void(uint32_t)>& visit) const {
    const Vec3 at = frame(p);
    Neighbours search{surface.get(), p, distance_mm * distance_mm, &visit};
    ask(at, distance_mm * frame.scale + room_at(at), visit_neighbour, &search);
  }

  double distance(Vec3 p, double at_most) const {
    const Vec3 at = frame(p);
    Search search{surface.get(), p, frame.scale, room_at(at)};
    ask(at, at_most * frame.scale + search.room, visit, &search);
    return std::sqrt(std::isinf(search.best) ? squared_distance_to_all(p) : search.best);
  }

  // So far away that Embree's numbers overflow.
  double squared_distance_to_all(Vec3 p) const {
    double best = std::numeric_limits<double>::infinity();
    for (uint32_t i = 0; i < surface->triangles.size(); ++i)
      best = std::min(best, squared_distance(p, surface->corners(i)));
    return best;
  }
};

// Embree builds with tasks. A thread of its own keeps them apart from ours: a worker of ours that
// waits for the tree must not meanwhile begin another piece of work that needs the same tree.
ClosestPoint::ClosestPoint(SurfacePtr surface)
    : tree_(std::async(std::launch::async, [&] { return std::make_unique<Tree>(std::move(surface)); }).get()) {}

ClosestPoint::~ClosestPoint() = default;

double ClosestPoint::distance(Vec3 p, double at_most) const {
  return is_finite(p) ? tree_->distance(p, at_most) : std::numeric_limits<double>::infinity();
}

void ClosestPoint::visit_within(Vec3 p, double distance_mm, const std::function<void(uint32_t)>& visit) const {
  if (is_finite(p)) tree_->visit_within(p, distance_mm, visit);
}

}  // namespace ombre::importing

#else

#include <limits>

#include "base/assert.h"

namespace ombre::importing {

bool has_mesh_distance() { return false; }

struct ClosestPoint::Tree {};
ClosestPoint::ClosestPoint(SurfacePtr) { ASSERT(has_mesh_distance()); }
ClosestPoint::~ClosestPoint() = default;
double ClosestPoint::distance(Vec3, double) const { return std::numeric_limits<double>::infinity(); }
void ClosestPoint::visit_within(Vec3, double, const std::function<void(uint32_t)>&) const {}

}  // namespace ombre::importing

#endif
