#include "nodes/common/poisson_discs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <unordered_map>

#include "base/system/tasks.h"
#include "base/text/text.h"
#include "nodes/common/lattice_noise.h"

namespace ombre::nodes {
namespace {

constexpr size_t chunk = 4096;           // cells of one task
constexpr size_t most_cells = 20000000;  // for memory
constexpr int deepest = 24;              // level of the smallest cells
constexpr int finest_division = 3;       // cells without a disc are divided so often

// A cube of an octree, by its position among the cubes of its level.
struct Cube {
  int32_t i = 0, j = 0, k = 0;
  int16_t level = 0;
  int8_t divided = 0;     // times that it was divided since darts were first thrown
  bool is_whole = false;  // lies in the host, as far as points may
};

class Octree {
 public:
  // The root's edge is a power of two times `finest`, and contains the box.
  Octree(const Box& box, double finest) : low_(box.lo) {
    const Vec3 size = box.size();
    const double whole = std::max({size.x, size.y, size.z}) * (1 + 1e-9);
    edge_ = finest > 0 && std::isfinite(finest) ? std::ldexp(finest, std::ilogb(whole / finest) + 1) : whole;
  }
  double edge(const Cube& cube) const { return std::ldexp(edge_, -cube.level); }
  Vec3 place(const Cube& cube, Vec3 share) const {
    const double e = edge(cube);
    return low_ + Vec3{(cube.i + share.x) * e, (cube.j + share.y) * e, (cube.k + share.z) * e};
  }
  Vec3 center(const Cube& cube) const { return place(cube, {0.5, 0.5, 0.5}); }
  Box box(const Cube& cube) const { return {place(cube, {0, 0, 0}), place(cube, {1, 1, 1})}; }

  template <class Visit>
  static void for_children(const Cube& cube, const Visit& visit) {
    for (int n = 0; n < 8; ++n)
      visit(Cube{2 * cube.i + (n & 1), 2 * cube.j + (n >> 1 & 1), 2 * cube.k + (n >> 2),
                 static_cast<int16_t>(cube.level + 1), cube.divided, cube.is_whole});
  }

 private:
  Vec3 low_;
  double edge_ = 0;
};

// Points with discs, in hashed grids for each size of discs.
class Discs {
 public:
  void add(Vec3 p, double apart) {
    Grid& grid = grid_of(std::ilogb(apart));
    grid.greatest = std::max(grid.greatest, apart);
    uint32_t& first = grid.first.try_emplace(key_at(p, grid), none).first->second;
    next_.push_back(first);
    first = static_cast<uint32_t>(points.size());
    points.push_back(p);
    apart_.push_back(apart);
  }
  // Moves a point.
  void replace(uint32_t n, Vec3 p, double apart) {
    uint32_t* link = &grid_of(std::ilogb(apart_[n])).first.at(key_at(points[n], grid_of(std::ilogb(apart_[n]))));
    while (*link != n) link = &next_[*link];
    *link = next_[n];
    points[n] = p;
    apart_[n] = apart;
    Grid& grid = grid_of(std::ilogb(apart));
    grid.greatest = std::max(grid.greatest, apart);
    uint32_t& first = grid.first.try_emplace(key_at(p, grid), none).first->second;
    next_[n] = first;
    first = n;
  }
  // True if the point, which wants this distance, is too close to another one; `except` is ignored.
  bool conflicts(Vec3 p, double apart, uint32_t except = none) const {
    return any_near(p, apart, [&](uint32_t n) {
      const Vec3 way = points[n] - p;
      const double least = std::max(apart, apart_[n]);
      return n != except && dot(way, way) < least * least;
    });
  }
  // True if one disc holds the whole cube.
  bool covers(Vec3 center, double edge) const {
    return any_near(center, 0, [&](uint32_t n) {
      Vec3 far;
      for (int axis = 0; axis < 3; ++axis) far[axis] = std::abs(points[n][axis] - center[axis]) + edge / 2;
      return dot(far, far) < apart_[n] * apart_[n];
    });
  }
  // Returns the nearest point, the first of several; there must be one. It is fast if that is not much farther than
  // `reach`.
  uint32_t nearest(Vec3 p, double reach) const {
    uint32_t found = none;
    for (double within = 1.3 * reach; found == none; within *= 2) {
      double least = within * within;
      any_near(p, within, [&](uint32_t n) {
        const Vec3 way = points[n] - p;
        const double squared = dot(way, way);
        if (squared < least || (squared == least && n < found)) {
          least = squared;
          found = n;
        }
        return false;
      });
    }
    return found;
  }

  std::vector<Vec3> points;

 private:
  static constexpr uint32_t none = ~uint32_t{0};
  struct Grid {
    int level = 0;
    double edge = 0;      // of its cells
    double greatest = 0;  // radius of its discs
    std::unordered_map<uint64_t, uint32_t> first;
  };

  Grid& grid_of(int level) {
    for (Grid& grid : grids_)
      if (grid.level == level) return grid;
    grids_.push_back({level, std::ldexp(1.0, level + 1), 0, {}});
    return grids_.back();
  }
  static int64_t cell_of(double v, const Grid& grid) { return static_cast<int64_t>(std::floor(v / grid.edge)); }
  // Different cells may have the same key, which costs time but changes nothing.
  static uint64_t key_of(int64_t i, int64_t j, int64_t k) {
    return static_cast<uint64_t>(i) * 0x9E3779B97F4A7C15u ^ static_cast<uint64_t>(j) * 0xC2B2AE3D27D4EB4Fu ^
           static_cast<uint64_t>(k) * 0x165667B19E3779F9u;
  }
  static uint64_t key_at(Vec3 p, const Grid& grid) {
    return key_of(cell_of(p.x, grid), cell_of(p.y, grid), cell_of(p.z, grid));
  }
  template <class Test>
  bool any_near(Vec3 p, double apart, const Test& test) const {
    for (const Grid& grid : grids_) {
      const double reach = std::max(apart, grid.greatest);
      for (int64_t i = cell_of(p.x - reach, grid); i <= cell_of(p.x + reach, grid); ++i)
        for (int64_t j = cell_of(p.y - reach, grid); j <= cell_of(p.y + reach, grid); ++j)
          for (int64_t k = cell_of(p.z - reach, grid); k <= cell_of(p.z + reach, grid); ++k) {
            const auto found = grid.first.find(key_of(i, j, k));
            if (found == grid.first.end()) continue;
            for (uint32_t n = found->second; n != none; n = next_[n])
              if (test(n)) return true;
          }
    }
    return false;
  }

  std::vector<Grid> grids_;
  std::vector<uint32_t> next_;
  std::vector<double> apart_;
};

struct Dart {
  Vec3 at;
  double apart = 0;
  uint64_t order = 0;
};

class Scatter {
 public:
  Scatter(const PointHost& host, const PointRules& rules)
      : host_(host), rules_(rules), tree_(host.box, host.range(host.box)[1].lo / std::numbers::sqrt3) {}

  ScatteredPoints run() {
    std::vector<Cube> cubes = first_cubes();
    if (!problem_.empty()) return {{}, problem_, hint_};
    const std::vector<Cube> all = rules_.relaxations > 0 ? cubes : std::vector<Cube>();
    for (int round = 0; !cubes.empty() && problem_.empty(); ++round) {
      accept(darts(cubes, static_cast<uint64_t>(round)));
      cubes = left_of(cubes);
    }
    if (!problem_.empty()) return {{}, problem_, hint_};
    std::vector<Vec3> points = discs_.points;
    if (rules_.relaxations > 0 && !points.empty()) relax(all, points);
    return {std::move(points), {}, {}};
  }

 private:
  bool is_allowed(double outside) const { return outside <= -rules_.clearance && outside <= 0; }

  bool is_sound(double apart, Vec3 at) {
    if (apart > 0 && std::isfinite(apart)) return true;
    if (!problem_.empty()) return false;
    problem_ = "the distance between points is " + format_rounded(apart) + " at (" + format_rounded(at.x) + ", " +
               format_rounded(at.y) + ", " + format_rounded(at.z) + "), but it must be positive";
    hint_ = "write a formula that is positive in all of the solid";
    return false;
  }

  // Returns the cubes that may hold a point and are so small that they hold one at most.
  std::vector<Cube> first_cubes() {
    std::vector<Cube> level{Cube{}}, found;
    while (!level.empty()) {
      std::vector<Divided> parts((level.size() + chunk - 1) / chunk);
      in_chunks(level.size(), [&](size_t begin, size_t end, std::vector<double>& memory) {
        for (size_t n = begin; n < end; ++n) divide(level[n], parts[begin / chunk], memory);
      });
      level.clear();
      double estimate = 0;
      for (const Divided& part : parts) {
        estimate += part.estimate;
        if (part.unsound && !is_sound(part.unsound->apart, part.unsound->at)) return {};
        found.insert(found.end(), part.small.begin(), part.small.end());
        level.insert(level.end(), part.children.begin(), part.children.end());
      }
      if (found.size() + level.size() > most_cells || estimate > static_cast<double>(rules_.most)) return too_many();
    }
    return found;
  }

  struct Divided {
    std::vector<Cube> small, children;
    double estimate = 0;          // points in the cubes that are divided and lie in the host
    std::optional<Dart> unsound;  // a place where the distance is not positive
  };
  void divide(const Cube& cube, Divided& part, std::vector<double>& memory) const {
    const auto [outside, apart] = host_.range(tree_.box(cube));
    if (!is_allowed(outside.lo)) return;
    const double diagonal = tree_.edge(cube) * std::numbers::sqrt3;
    double small = apart.lo;
    if (diagonal > small) {
      // Ranges of formulas may be wide, so the value in the middle limits the divisions.
      const Vec3 center = tree_.center(cube);
      const double middle = host_.at(center, memory)[1];
      const bool is_positive = middle > 0 && std::isfinite(middle);
      if (outside.hi <= 0 && !is_positive && !part.unsound) part.unsound = Dart{center, middle};
      if (is_positive) small = std::max(small, middle / 4);
      const double share = tree_.edge(cube) / middle;
      if (is_positive && is_allowed(outside.hi)) part.estimate += points_per_cubed_distance * share * share * share;
    }
    if (diagonal <= small || cube.level > deepest) {
      part.small.push_back(cube);
      part.small.back().is_whole = is_allowed(outside.hi);
    } else {
      Octree::for_children(cube, [&](const Cube& child) { part.children.push_back(child); });
    }
  }
  std::vector<Cube> too_many() {
    problem_ = "more than " + std::to_string(rules_.most) + " points would fit";
    hint_ = "make the distance greater, or the solid smaller";
    return {};
  }

  // Calls work(begin, end, memory) for ranges of numbers below `count`, in parallel.
  template <class Work>
  static void in_chunks(size_t count, const Work& work) {
    run_parallel((count + chunk - 1) / chunk, 0, [&](size_t n) {
      std::vector<double> memory;
      work(n * chunk, std::min(count, (n + 1) * chunk), memory);
    });
  }

  // Throws a dart into each cube, and returns those that hit the host, in random order.
  std::vector<Dart> darts(const std::vector<Cube>& cubes, uint64_t round) {
    std::vector<Dart> all(cubes.size());
    in_chunks(cubes.size(), [&](size_t begin, size_t end, std::vector<double>& memory) {
      for (size_t n = begin; n < end; ++n) {
        const Cube& cube = cubes[n];
        const uint64_t bits =
            cell_bits(cube.i, cube.j, cube.k,
                      rules_.seed * 0x9E3779B97F4A7C15u + (round << 8) + static_cast<uint64_t>(cube.level));
        const Vec3 at = tree_.place(cube, {unit_of(bits, 0), unit_of(bits, 1), unit_of(bits, 2)});
        const auto [outside, apart] = host_.at(at, memory);
        if (is_allowed(outside)) all[n] = {at, apart, cell_bits(cube.k, cube.j, cube.i, bits)};
      }
    });
    // Only darts that hit have an order.
    std::erase_if(all, [](const Dart& dart) { return dart.order == 0; });
    std::ranges::sort(all, [](const Dart& a, const Dart& b) {
      return std::tie(a.order, a.at.x, a.at.y, a.at.z) < std::tie(b.order, b.at.x, b.at.y, b.at.z);
    });
    return all;
  }

  void accept(const std::vector<Dart>& darts) {
    for (const Dart& dart : darts) {
      if (!is_sound(dart.apart, dart.at)) return;
      if (discs_.conflicts(dart.at, dart.apart)) continue;
      discs_.add(dart.at, dart.apart);
      if (discs_.points.size() > rules_.most) {
        too_many();
        return;
      }
    }
  }

  // Returns the parts of cubes that no disc holds and that may hold a point of the host.
  std::vector<Cube> left_of(const std::vector<Cube>& cubes) const {
    std::vector<std::vector<Cube>> left((cubes.size() + chunk - 1) / chunk);
    in_chunks(cubes.size(), [&](size_t begin, size_t end, std::vector<double>&) {
      std::vector<Cube>& here = left[begin / chunk];
      for (size_t n = begin; n < end; ++n) {
        if (cubes[n].divided >= finest_division || discs_.covers(tree_.center(cubes[n]), tree_.edge(cubes[n])))
          continue;
        Octree::for_children(cubes[n], [&](Cube child) {
          if (discs_.covers(tree_.center(child), tree_.edge(child))) return;
          if (!child.is_whole && !is_allowed(host_.range(tree_.box(child))[0].lo)) return;
          ++child.divided;
          here.push_back(child);
        });
      }
    });
    std::vector<Cube> all;
    for (const std::vector<Cube>& some : left) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

  struct Sample {
    Vec3 at;
    double weight = 0, apart = 0;
    uint32_t nearest = 0;
  };

  // Returns the middles of the cubes, or of their eighths where these are large. Where points are graded, a weight of
  // the inverse fifth power of their distance makes centroidal cells keep that grading (Q. Du, V. Faber and M.
  // Gunzburger, SIAM Review 41, 1999).
  std::vector<Sample> samples_of(const std::vector<Cube>& cubes) const {
    constexpr double largest = 0.7;  // diagonals, as shares of the distance
    std::vector<std::vector<Sample>> parts((cubes.size() + chunk - 1) / chunk);
    in_chunks(cubes.size(), [&](size_t begin, size_t end, std::vector<double>& memory) {
      std::vector<Sample>& part = parts[begin / chunk];
      const auto add = [&](const Cube& cube) {
        const Vec3 at = tree_.center(cube);
        const auto [outside, apart] = host_.at(at, memory);
        const double edge = tree_.edge(cube), share = edge / apart;
        if (outside <= 0 && apart > 0) part.push_back({at, share * share * share / (apart * apart), apart, 0});
        return edge * std::numbers::sqrt3 > largest * apart;
      };
      for (size_t n = begin; n < end; ++n) {
        const size_t before = part.size();
        if (!add(cubes[n])) continue;
        part.resize(before);
        Octree::for_children(cubes[n], add);
      }
    });
    std::vector<Sample> samples;
    for (const std::vector<Sample>& part : parts) samples.insert(samples.end(), part.begin(), part.end());
    return samples;
  }

  void relax(const std::vector<Cube>& cubes, std::vector<Vec3>& points) {
    std::vector<Sample> samples = samples_of(cubes);
    for (int step = 0; step < rules_.relaxations; ++step) {
      in_chunks(samples.size(), [&](size_t begin, size_t end, std::vector<double>&) {
        for (size_t n = begin; n < end; ++n) samples[n].nearest = discs_.nearest(samples[n].at, samples[n].apart);
      });
      std::vector<Vec3> sums(points.size());
      std::vector<double> weights(points.size());
      for (const Sample& sample : samples) {
        sums[sample.nearest] = sums[sample.nearest] + sample.weight * (sample.at - points[sample.nearest]);
        weights[sample.nearest] += sample.weight;
      }
      move(sums, weights, points);
    }
  }
  // Moves points one after the other, each as far as the others and the border allow.
  void move(const std::vector<Vec3>& sums, const std::vector<double>& weights, std::vector<Vec3>& points) {
    std::vector<double> memory;
    for (size_t n = 0; n < points.size(); ++n) {
      if (!(weights[n] > 0)) continue;
      const Vec3 way = (1 / weights[n]) * sums[n];
      for (const double share : {1.0, 0.5, 0.25, 0.1}) {
        const Vec3 to = points[n] + share * way;
        const auto [outside, apart] = host_.at(to, memory);
        if (!is_allowed(outside) || !(apart > 0) || discs_.conflicts(to, apart, static_cast<uint32_t>(n))) continue;
        discs_.replace(static_cast<uint32_t>(n), to, apart);
        points[n] = to;
        break;
      }
    }
  }

  const PointHost& host_;
  const PointRules& rules_;
  Octree tree_;
  Discs discs_;
  std::string problem_, hint_;
};

}  // namespace

ScatteredPoints scatter_points(const PointHost& host, const PointRules& rules) { return Scatter(host, rules).run(); }

}  // namespace ombre::nodes
