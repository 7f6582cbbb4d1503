// Winding numbers of the caps of a surface, and their bounds in boxes.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "import/surfaces/capped_surface.h"
#include "import/surfaces/solid_angle.h"

namespace ombre::importing {

// The sum of the caps' winding numbers. A single flat cap has 0.5 at its middle, falling off with the square of the
// distance. The number jumps by 1 across the cap and is smooth elsewhere.
class CapWinding {
 public:
  explicit CapWinding(std::vector<Cap> caps);

  struct Estimate {
    double middle = 0;     // the sum at the centre of a box
    double variation = 0;  // upper bound on the difference within the box, jumps aside; infinity if an edge is too near
    double most = 0;       // upper bound on the sum's magnitude within the box; infinity likewise
  };

  // The caps that matter in a box, and an upper bound on the magnitude of all others together.
  struct Relevant {
    std::vector<uint32_t> caps;
    double others = 0;
  };

  const Relevant& all() const { return all_; }
  // Returns the caps relevant in a box inside of a larger box whose relevant caps are `around`.
  Relevant relevant(const Box& box, const Relevant& around) const;
  // Returns the bounds of a box; `middle` is the sum at its centre over the relevant caps of the box, or of a larger
  // one.
  Estimate estimate(const Box& box, double middle, const Relevant& relevant) const;
  // Computes the sums of caps at points; approximately if they have many edges.
  void sum(std::span<const Vec3> points, std::span<const uint32_t> caps, std::span<double> sums) const;
  // Upper bounds on the error of sum(), with few and with many edges.
  static constexpr double error = 1e-9, error_of_many = 0.02;

 private:
  struct Edge {
    Vec3 middle;
    double half = 0;  // half its length
  };
  struct Reach {
    Vec3 center;
    double radius = 0, area = 0;  // mm, mm2
    std::vector<Edge> edges;
  };

  double most_in(const Box& box, uint32_t cap) const;
  double variation(Vec3 center, double reach, uint32_t cap) const;
  bool meets(const Box& box, uint32_t cap) const;

  std::vector<Cap> caps_;
  std::vector<Reach> reaches_;
  Relevant all_;
  std::unique_ptr<SolidAngle> many_;  // approximates all caps if they have many edges
};

}  // namespace ombre::importing
