// A tree of virtual nodes that is asked one point at a time, in double precision: the method of the 2023 paper.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

namespace baseline {

struct Point {
  double x = 0, y = 0, z = 0;
};

inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator*(const Point& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

constexpr double far_away = 1e30;  // the distance to what is not near enough to ask

struct Box {
  Point lo{-far_away, -far_away, -far_away}, hi{far_away, far_away, far_away};

  bool contains(const Point& p) const {
    return lo.x <= p.x && p.x <= hi.x && lo.y <= p.y && p.y <= hi.y && lo.z <= p.z && p.z <= hi.z;
  }
};

// Shares of the design's materials, not normalised.
using Composition = std::vector<double>;

class Node {
 public:
  explicit Node(const Box& box) : box_(box) {}
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  virtual ~Node() = default;

  // Negative inside.
  virtual double distance(const Point& p) const = 0;

  // Adds the shares of the materials at a point inside.
  virtual void add_composition(const Point& p, Composition& shares) const = 0;

  const Box& box() const { return box_; }

 private:
  Box box_;
};

using NodePtr = std::unique_ptr<Node>;
using Nodes = std::vector<NodePtr>;

}  // namespace baseline
