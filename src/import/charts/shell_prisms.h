// The prisms between a triangle of a surface and its moved copies.
#pragma once

#include <array>
#include <vector>

#include "base/math/box_tree.h"
#include "import/charts/surface_patch.h"

namespace ombre::importing {

// A place in a prism: the shares of the second and third corner, and the height.
struct PrismPlace {
  double second = 0, third = 0, height = 0;
  double first() const { return 1 - second - third; }
  double least_share() const { return std::min({first(), second, third}); }
};

// Points are x0 + t w0 + b (e1 + t m1) + c (e2 + t m2) for shares b and c and a height t. Triangles at a height have
// the normal c0 + t c1 + t^2 c2, whose length is twice their area.
struct PrismNumbers {
  Vec3 x0, e1, e2, w0, m1, m2, c0, c1, c2;
};

class Prism {
 public:
  Prism(const Shell& shell, const Corners& corners);

  const PrismNumbers& numbers() const { return n_; }
  Vec3 normal(double t) const { return n_.c0 + t * (n_.c1 + t * n_.c2); }
  Vec3 way(const PrismPlace& at) const { return n_.w0 + at.second * n_.m1 + at.third * n_.m2; }
  Vec3 point(const PrismPlace& at) const {
    return n_.x0 + at.height * n_.w0 + at.second * edge(1, at.height) + at.third * edge(2, at.height);
  }
  Vec3 edge(int n, double t) const { return n == 1 ? n_.e1 + t * n_.m1 : n_.e2 + t * n_.m2; }
  Vec3 corner_way(int n) const { return n == 0 ? n_.w0 : n == 1 ? n_.w0 + n_.m1 : n_.w0 + n_.m2; }
  // Returns the quadratic polynomial of the height whose value at a corner is the determinant of the map.
  std::array<double, 3> turns(int corner) const {
    const Vec3 way = corner_way(corner);
    return {dot(n_.c0, way), dot(n_.c1, way), dot(n_.c2, way)};
  }
  Box box(Interval heights) const;

  // Returns the place of a point if its height is among the given ones; the shares may be negative. Nothing if no such
  // height exists. The prism must not be folded.
  bool find(Vec3 p, Interval heights, PrismPlace& place) const;
  // Returns the place of the triangle's point nearest to p, with the height of p above its plane.
  PrismPlace nearest(Vec3 p) const;
  // Returns an interval that encloses the heights of the points in a box.
  Interval heights_of(const Box& box) const;

  // Derivatives of the shares and the height by x, y and z.
  struct Slopes {
    Vec3 second, third, height;
  };
  Slopes slopes(const PrismPlace& at) const;
  // Returns intervals around the parts of those derivatives, of the second share, the third and the height.
  std::array<std::array<Interval, 3>, 3> slope_ranges(Interval heights) const;

 private:
  PrismNumbers n_;
};

// All prisms of a shell, with a tree of boxes around slabs of them. Slabs are about as high as triangles are wide,
// since boxes around high slanted prisms would overlap many others.
class Prisms {
 public:
  explicit Prisms(const Shell& shell);

  // Heights of the prisms, which reach a little beyond the shell's.
  Interval heights() const { return heights_; }
  const Prism& operator[](size_t n) const { return all_[n]; }
  size_t count() const { return all_.size(); }
  // Calls visit(n) for each prism that may meet the box, perhaps several times.
  template <class Visit>
  void each_near(const Box& box, const Visit& visit) const {
    tree_.each_that_meets(box, [&](uint32_t slab) { visit(slab / slabs_); });
  }
  bool meets_any(const Box& box) const { return tree_.meets_any(box); }
  double mean_size() const { return mean_size_; }  // of boxes around slabs, mm

 private:
  std::vector<Prism> all_;
  Interval heights_;
  uint32_t slabs_ = 1;  // of each prism
  double mean_size_ = 0;
  BoxTree tree_;
};

}  // namespace ombre::importing
