// How much of the view from a point the caps of a surface fill, and how fast that changes.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "import/surfaces/capped_surface.h"
#include "import/surfaces/solid_angle.h"

namespace ombre::importing {

// The sum of the caps' winding numbers. One alone is 0.5 on its flat middle and falls off with the square of the
// distance; on the cap it jumps by 1, elsewhere it is smooth.
class CapWinding {
 public:
  explicit CapWinding(std::vector<Cap> caps);

  struct Estimate {
    double middle = 0;     // the sum at the centre of a box
    double variation = 0;  // no point of the box differs by more, jumps aside; infinity where an edge is too near
    double most = 0;       // the sum's magnitude is no larger anywhere in the box; infinity likewise
  };

  // The caps that a box has to look at, and a bound on the magnitude of all others together.
  struct Relevant {
    std::vector<uint32_t> caps;
    double others = 0;
  };

  const Relevant& all() const { return all_; }
  // What is left of `around`, the relevant caps of a larger box.
  Relevant relevant(const Box& box, const Relevant& around) const;
  // `middle` is the sum of the relevant caps of the box, or of a larger one, at its centre.
  Estimate estimate(const Box& box, double middle, const Relevant& relevant) const;
  // Large numbers of edges are summed approximately.
  void sum(std::span<const Vec3> points, std::span<const uint32_t> caps, std::span<double> sums) const;
  // Bounds the error of the above.
  static constexpr double error = 1e-9, error_of_many = 0.02;

 private:
  struct Edge {
    Vec3 middle;
    double half = 0;  // of its length
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
  std::unique_ptr<SolidAngle> many_;  // of all caps, where they have many edges
};

}  // namespace ombre::importing
