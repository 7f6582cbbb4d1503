// Says how far a mesh of a design lies from the design's surface, and the surface from the mesh: both sides of the
// Hausdorff distance, at samples. The design is evaluated by the reference evaluator, the mesh by CGAL.
//
//   compare_mesh DESIGN.vcad MESH.off TOLERANCE_MM
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <set>

#include "base/system/tasks.h"
#include "load/load.h"
#include "off_soup.h"
#include "program/evaluate.h"
#include "questions/build.h"
#include "questions/partition_program.h"
#include "questions/region_request.h"
#include "surface/cells/point_evaluator.h"
#include "surface/cells/shortened.h"

namespace {

using namespace ombre;
using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

// Surfaces are looked for on a lattice of so many steps along the longest side, and so far around the mesh.
constexpr double steps_of_lattice = 190, farthest_in_tolerances = 16;
constexpr double growth = 1.05;    // of the reach; reported distances are too large by this factor at most
constexpr double rounding = 1e-6;  // of coordinates in files, relative to distances
constexpr int64_t steps_of_tile = 16;

struct Sample {
  Vec3 point, normal;
};

// One side of the distance.
struct Side {
  double farthest_mm = 0;
  Vec3 where;
  size_t samples = 0, beyond = 0;  // `beyond` the tolerance

  void add(double distance_mm, Vec3 point, double tolerance_mm) {
    ++samples;
    beyond += distance_mm > (1 + rounding) * tolerance_mm;
    if (distance_mm <= farthest_mm) return;
    farthest_mm = distance_mm;
    where = point;
  }
  void add(const Side& other) {
    samples += other.samples;
    beyond += other.beyond;
    if (other.farthest_mm <= farthest_mm) return;
    farthest_mm = other.farthest_mm;
    where = other.where;
  }
};

// What is inside, in the neighbourhood of a box.
class Insides {
 public:
  Insides(const surface::Partition& partition, const Box& box)
      : program_(surface::shortened_for(partition.label, box)) {
    asker_.begin(partition, program_);
  }
  Insides(const Insides&) = delete;

  std::vector<bool> at(const std::vector<Vec3>& points) {
    asker_.ask(points);
    std::vector<bool> result(points.size());
    for (size_t n = 0; n < points.size(); ++n) result[n] = asker_.label(n) != 0;
    return result;
  }

  // Halves the ways from `from` to `to`, between which the answer changes, until it does within `to`.
  void narrow(std::vector<Vec3>& from, std::vector<Vec3>& to, int rounds) {
    const std::vector<bool> beginnings = at(from);
    for (int round = 0; round < rounds; ++round) {
      std::vector<Vec3> middles;
      for (size_t n = 0; n < from.size(); ++n) middles.push_back(0.5 * (from[n] + to[n]));
      const std::vector<bool> answers = at(middles);
      for (size_t n = 0; n < from.size(); ++n) (answers[n] == beginnings[n] ? from : to)[n] = middles[n];
    }
  }

 private:
  program::Program program_;
  surface::PointEvaluator asker_;
};

// Along the normal first and against it, then all around.
constexpr size_t most_ways = 100;
Vec3 direction(size_t way, Vec3 normal) {
  if (way < 2) return way == 0 ? normal : -normal;
  constexpr double golden_angle = 2.399963229728653;  // of Fibonacci's lattice on the sphere
  const auto n = static_cast<double>(way - 2);
  const double z = 1 - 2 * (n + 0.5) / (most_ways - 2), radius = std::sqrt(1 - z * z);
  return {radius * std::cos(golden_angle * n), radius * std::sin(golden_angle * n), z};
}

// How far the design's surface is from points that should lie on it: where a way ends on the other side, it is no
// farther than the change along that way.
class Search {
 public:
  Search(Insides& insides, const std::vector<Sample>& samples, double tolerance_mm)
      : insides_(insides), samples_(samples), tolerance_mm_(tolerance_mm), open_(samples.size()) {
    std::vector<Vec3> points;
    for (const Sample& sample : samples) points.push_back(sample.point);
    here_ = insides.at(points);
    for (size_t n = 0; n < open_.size(); ++n) open_[n] = n;
  }

  Side run() {
    // Most lie on the surface nearly, and the shortest ways tell how nearly.
    for (const double share : {0.01, 0.1, 0.3, 0.5, 1.0}) go(share * tolerance_mm_, 2);
    // Small flecks are passed by longer ones.
    for (const double share : {0.001, 0.003, 0.01, 0.03, 0.1, 0.3}) go(share * tolerance_mm_, most_ways);
    for (double reach = tolerance_mm_; reach <= farthest_in_tolerances * tolerance_mm_; reach *= growth)
      go(reach, most_ways);
    const std::vector<Vec3> beginnings = from_;
    insides_.narrow(from_, to_, 8);
    Side side;
    for (size_t n = 0; n < to_.size(); ++n) side.add(length(to_[n] - beginnings[n]), beginnings[n], tolerance_mm_);
    for (const size_t n : open_) side.add(HUGE_VAL, samples_[n].point, tolerance_mm_);
    return side;
  }

 private:
  void go(double reach, size_t ways) {
    for (size_t way = 0; way < ways && !open_.empty(); ++way) {
      std::vector<Vec3> ends;
      for (const size_t n : open_) ends.push_back(samples_[n].point + reach * direction(way, samples_[n].normal));
      const std::vector<bool> there = insides_.at(ends);
      std::vector<size_t> still;
      for (size_t i = 0; i < open_.size(); ++i) {
        if (there[i] == here_[open_[i]]) {
          still.push_back(open_[i]);
          continue;
        }
        from_.push_back(samples_[open_[i]].point);
        to_.push_back(ends[i]);
      }
      open_ = std::move(still);
    }
  }

  Insides& insides_;
  const std::vector<Sample>& samples_;
  double tolerance_mm_;
  std::vector<bool> here_;
  std::vector<size_t> open_;     // whose surface was not found yet
  std::vector<Vec3> from_, to_;  // ways to it
};

using TileKey = std::array<int64_t, 3>;

// Space in tiles, each with a lattice of points.
struct Tiling {
  Vec3 origin;
  double step = 1;

  double width() const { return step * steps_of_tile; }
  TileKey tile_of(Vec3 p) const {
    TileKey key;
    for (int axis = 0; axis < 3; ++axis)
      key[static_cast<size_t>(axis)] = static_cast<int64_t>(std::floor((p[axis] - origin[axis]) / width()));
    return key;
  }
  Vec3 corner(const TileKey& key) const {
    return origin +
           width() * Vec3{static_cast<double>(key[0]), static_cast<double>(key[1]), static_cast<double>(key[2])};
  }
  Box box(const TileKey& key) const { return {corner(key), corner({key[0] + 1, key[1] + 1, key[2] + 1})}; }
};

// Points of the surface on the edges of a tile's lattice.
std::vector<Vec3> surface_points(Insides& insides, Vec3 corner, double step) {
  constexpr size_t side = steps_of_tile + 1;
  std::vector<Vec3> points;
  for (size_t k = 0; k < side; ++k)
    for (size_t j = 0; j < side; ++j)
      for (size_t i = 0; i < side; ++i)
        points.push_back(corner + step * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  const std::vector<bool> flags = insides.at(points);
  const std::array<size_t, 3> strides{1, side, side * side};
  std::vector<Vec3> from, to;
  for (size_t n = 0; n < points.size(); ++n)
    for (const size_t stride : strides) {
      if (n / stride % side == side - 1 || flags[n] == flags[n + stride]) continue;
      from.push_back(points[n]);
      to.push_back(points[n + stride]);
    }
  insides.narrow(from, to, 24);
  return to;
}

using Place = std::array<double, 3>;
Place place_of(Vec3 p) { return {p.x, p.y, p.z}; }

// Corners and middles of triangles' sides, their centres, and more by their area. Corners once, and sides once where
// two triangles go along them in opposite directions.
class Sampler {
 public:
  explicit Sampler(double spacing_mm) : spacing_mm_(spacing_mm) {}

  void add(const Kernel::Triangle_3& triangle) {
    const auto corner = [&](int n) { return Vec3{triangle[n].x(), triangle[n].y(), triangle[n].z()}; };
    const std::array<Vec3, 3> corners{corner(0), corner(1), corner(2)};
    const auto [a, b, c] = corners;
    const Vec3 across = cross(b - a, c - a);
    const double twice_area = length(across);
    normal_ = twice_area > 0 ? (1 / twice_area) * across : Vec3{0, 0, 1};
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    const int cuts = std::max(2, static_cast<int>(std::ceil(std::min(longest, std::sqrt(twice_area)) / spacing_mm_)));
    for (size_t n = 0; n < 3; ++n) add_side(corners[n], corners[(n + 1) % 3], cuts);
    for (int i = 1; i < cuts; ++i)
      for (int j = 1; i + j < cuts; ++j)
        add(a + (static_cast<double>(i) / cuts) * (b - a) + (static_cast<double>(j) / cuts) * (c - a));
    add((1.0 / 3) * (a + b + c));
  }

  std::vector<Sample> samples;

 private:
  void add(Vec3 at) { samples.push_back({at, normal_}); }

  void add_side(Vec3 from, Vec3 to, int cuts) {
    if (corners_.insert(place_of(from)).second) add(from);
    if (place_of(to) < place_of(from)) return;
    for (int n = 1; n < cuts; ++n) add(from + (static_cast<double>(n) / cuts) * (to - from));
  }

  double spacing_mm_;
  Vec3 normal_;
  std::set<Place> corners_;
};

double area(const Triangles& triangles) {
  double sum = 0;
  for (const auto& triangle : triangles) sum += std::sqrt(triangle.squared_area());
  return sum;
}

Triangles read_triangles(const std::string& path) {
  const Soup<Kernel::Point_3> soup = read_off<Kernel::Point_3>(path);
  Triangles triangles;
  for (const auto& t : soup.triangles) triangles.emplace_back(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
  return triangles;
}

class Comparison {
 public:
  Comparison(surface::Partition partition, const Box& box, const Triangles& triangles, double tolerance_mm)
      : partition_(std::move(partition)), triangles_(triangles), tolerance_mm_(tolerance_mm) {
    tree_.insert(triangles.begin(), triangles.end());
    tree_.accelerate_distance_queries();
    const double longest = std::max({box.size().x, box.size().y, box.size().z});
    tiling_.step = longest / steps_of_lattice;
    // Off the places where designs and cells have their faces.
    tiling_.origin = box.lo - tiling_.step * Vec3{1.3717, 1.4142, 1.6180};
    end_ = tiling_.tile_of(box.hi + tiling_.step * Vec3{1, 1, 1});
  }

  Side of_mesh() const {
    // Of about 300,000 samples.
    const double spacing = std::sqrt(area(triangles_) / 150'000);
    Sampler sampler(spacing);
    for (const auto& triangle : triangles_) sampler.add(triangle);
    std::map<TileKey, std::vector<Sample>> by_tile;
    for (const Sample& sample : sampler.samples) by_tile[tiling_.tile_of(sample.point)].push_back(sample);
    std::vector<const std::pair<const TileKey, std::vector<Sample>>*> tiles;
    for (const auto& tile : by_tile) tiles.push_back(&tile);
    return over(tiles.size(), [&](size_t n, Side& side) {
      Insides insides(partition_, tiling_.box(tiles[n]->first).expanded(farthest_in_tolerances * tolerance_mm_));
      side = Search(insides, tiles[n]->second, tolerance_mm_).run();
    });
  }

  Side of_design() const {
    std::vector<TileKey> tiles;
    for (int64_t k = 0; k <= end_[2]; ++k)
      for (int64_t j = 0; j <= end_[1]; ++j)
        for (int64_t i = 0; i <= end_[0]; ++i) tiles.push_back({i, j, k});
    return over(tiles.size(), [&](size_t n, Side& side) {
      const Box box = tiling_.box(tiles[n]);
      if (is_of_one_kind(box)) return;
      Insides insides(partition_, box.expanded(tiling_.step));
      for (const Vec3& p : surface_points(insides, box.lo, tiling_.step))
        side.add(std::sqrt(tree_.squared_distance(Kernel::Point_3(p.x, p.y, p.z))), p, tolerance_mm_);
    });
  }

 private:
  bool is_of_one_kind(const Box& box) const {
    std::vector<Interval> values;
    program::evaluate_intervals(partition_.label, box.expanded(tiling_.step), values);
    const Interval label = values[partition_.label.outputs[surface::Partition::label_output]];
    return label.hi < 1 || label.lo > 0;
  }

  static Side over(size_t count, const std::function<void(size_t, Side&)>& measure_one) {
    Side all;
    run_ordered<Side>(
        count, 0, 64,
        [&](size_t n) {
          Side side;
          measure_one(n, side);
          return side;
        },
        [&](size_t, Side& side) { all.add(side); });
    return all;
  }

  surface::Partition partition_;
  const Triangles& triangles_;
  double tolerance_mm_;
  Tree tree_;
  Tiling tiling_;
  TileKey end_{};
};

void print(const char* name, const Side& side) {
  std::cout << '"' << name << "\": {\"farthest_mm\": " << side.farthest_mm << ", \"at\": [" << side.where.x << ", "
            << side.where.y << ", " << side.where.z << "], \"samples\": " << side.samples
            << ", \"beyond\": " << side.beyond << "}";
}

int compare(const std::string& design_path, const std::string& mesh_path, double tolerance_mm) {
  Diagnostics diagnostics;
  const compile::LoadedPtr loaded = compile::load_design(design_path, {}, diagnostics);
  const auto box = loaded ? compile::design_box(loaded->design, diagnostics) : std::nullopt;
  // As fine as the mesh was asked for, where parts are as fine as the job.
  auto built =
      box ? compile::build_region_program(compile::for_tolerance(loaded->design, tolerance_mm), *box, {}, diagnostics)
          : std::nullopt;
  if (!built) {
    std::cerr << to_text(diagnostics);
    return 1;
  }
  const Triangles triangles = read_triangles(mesh_path);
  const Comparison comparison(std::move(built->partition), *box, triangles, tolerance_mm);
  std::cout << "{";
  print("mesh_to_design", comparison.of_mesh());
  std::cout << ", ";
  print("design_to_mesh", comparison.of_design());
  std::cout << "}\n";
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) return 1;
  std::cout.precision(9);
  return compare(arguments[1], arguments[2], std::stod(arguments[3]));
}
