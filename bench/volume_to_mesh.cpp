// OpenVDB's volume-to-mesh on the distance grid of a .vdb file, for the table of meshes.
#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

double six_times_volume(const openvdb::Vec3s& a, const openvdb::Vec3s& b, const openvdb::Vec3s& c) {
  return openvdb::Vec3d(a).dot(openvdb::Vec3d(b).cross(openvdb::Vec3d(c)));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "bench_volume_to_mesh FILE.vdb ADAPTIVITY\n");
    return 2;
  }
  openvdb::initialize();
  openvdb::io::File file(arguments[1]);
  file.open(false);
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("distance"));
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  const auto start = Clock::now();
  openvdb::tools::volumeToMesh(*grid, points, triangles, quads, 0.0, std::atof(arguments[2]));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  double volume = 0;
  for (const auto& t : triangles) volume += six_times_volume(points[t[0]], points[t[1]], points[t[2]]);
  for (const auto& q : quads)
    volume += six_times_volume(points[q[0]], points[q[1]], points[q[2]]) +
              six_times_volume(points[q[0]], points[q[2]], points[q[3]]);
  std::printf("{\"seconds\": %.6f, \"triangles\": %zu, \"volume_mm3\": %.6f}\n", seconds,
              triangles.size() + 2 * quads.size(), -volume / 6);
}
