#include "solids.h"

#include <cmath>
#include <iterator>
#include <utility>

namespace baseline {
namespace {

Box around(const Point& a, const Point& b, double margin) {
  return {{std::min(a.x, b.x) - margin, std::min(a.y, b.y) - margin, std::min(a.z, b.z) - margin},
          {std::max(a.x, b.x) + margin, std::max(a.y, b.y) + margin, std::max(a.z, b.z) + margin}};
}

Box meet(const Box& a, const Box& b) {
  return {{std::max(a.lo.x, b.lo.x), std::max(a.lo.y, b.lo.y), std::max(a.lo.z, b.lo.z)},
          {std::min(a.hi.x, b.hi.x), std::min(a.hi.y, b.hi.y), std::min(a.hi.z, b.hi.z)}};
}

Box hull(const Box& a, const Box& b) {
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

template <class Combine>
Box combined_box(const Nodes& children, Combine combine) {
  Box box = children.front()->box();
  for (const NodePtr& child : children) box = combine(box, child->box());
  return box;
}

double Point::*longest_side(const Box& box) {
  const Point size = box.hi - box.lo;
  if (size.x >= size.y && size.x >= size.z) return &Point::x;
  return size.y >= size.z ? &Point::y : &Point::z;
}

class Sphere final : public Leaf {
 public:
  Sphere(double radius, size_t material) : Leaf(around({}, {}, radius), material), radius_(radius) {}
  double distance(const Point& p) const override { return std::sqrt(dot(p, p)) - radius_; }

 private:
  double radius_;
};

class Block final : public Leaf {
 public:
  Block(const Point& size, size_t material) : Leaf(around(size * -0.5, size * 0.5, 0), material), half_(size * 0.5) {}

  double distance(const Point& p) const override {
    const Point q = Point{std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)} - half_;
    const Point out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
    return std::sqrt(dot(out, out)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
  }

 private:
  Point half_;
};

class Strut final : public Leaf {
 public:
  Strut(const Point& start, const Point& end, double radius, bool round, size_t material)
      : Leaf(around(start, end, radius), material),
        start_(start),
        length_(std::sqrt(dot(end - start, end - start))),
        along_((end - start) * (1 / length_)),
        radius_(radius),
        round_(round) {}

  double distance(const Point& p) const override {
    const Point q = p - start_;
    const double at = dot(q, along_);
    if (round_) {
      const Point off = q - along_ * std::clamp(at, 0.0, length_);
      return std::sqrt(dot(off, off)) - radius_;
    }
    const double beyond = std::max(-at, at - length_);
    const double aside = std::sqrt(std::max(dot(q, q) - at * at, 0.0)) - radius_;
    return std::max(beyond, aside);
  }

 private:
  Point start_;
  double length_;
  Point along_;
  double radius_;
  bool round_;
};

class Translate final : public Node {
 public:
  Translate(const Point& by, NodePtr child)
      : Node({child->box().lo + by, child->box().hi + by}), by_(by), child_(std::move(child)) {}
  double distance(const Point& p) const override { return child_->distance(p - by_); }
  void add_composition(const Point& p, Composition& shares) const override { child_->add_composition(p - by_, shares); }

 private:
  Point by_;
  NodePtr child_;
};

// Children whose box misses the point are not asked.
class Union final : public Node {
 public:
  explicit Union(Nodes children) : Node(combined_box(children, hull)), children_(std::move(children)) {
    for (const NodePtr& child : children_) boxes_.push_back(child->box());
  }

  double distance(const Point& p) const override {
    double least = far_away;
    for (size_t i = 0; i < children_.size(); ++i)
      if (boxes_[i].contains(p)) least = std::min(least, children_[i]->distance(p));
    return least;
  }

  void add_composition(const Point& p, Composition& shares) const override {
    for (size_t i = 0; i < children_.size(); ++i)
      if (boxes_[i].contains(p) && children_[i]->distance(p) <= 0) children_[i]->add_composition(p, shares);
  }

 private:
  Nodes children_;
  std::vector<Box> boxes_;
};

class Intersection final : public Node {
 public:
  explicit Intersection(Nodes children) : Node(combined_box(children, meet)), children_(std::move(children)) {}

  double distance(const Point& p) const override {
    double greatest = -far_away;
    for (const NodePtr& child : children_) greatest = std::max(greatest, child->distance(p));
    return greatest;
  }

  void add_composition(const Point& p, Composition& shares) const override {
    for (const NodePtr& child : children_) child->add_composition(p, shares);
  }

 private:
  Nodes children_;
};

// The first child without the others.
class Difference final : public Node {
 public:
  explicit Difference(Nodes children) : Node(children.front()->box()), children_(std::move(children)) {}

  double distance(const Point& p) const override {
    double greatest = children_.front()->distance(p);
    for (size_t i = 1; i < children_.size(); ++i) greatest = std::max(greatest, -children_[i]->distance(p));
    return greatest;
  }

  void add_composition(const Point& p, Composition& shares) const override {
    children_.front()->add_composition(p, shares);
  }

 private:
  Nodes children_;
};

}  // namespace

NodePtr sphere(double radius, size_t material) { return std::make_unique<Sphere>(radius, material); }
NodePtr block(const Point& size, size_t material) { return std::make_unique<Block>(size, material); }
NodePtr strut(const Point& start, const Point& end, double radius, bool round, size_t material) {
  return std::make_unique<Strut>(start, end, radius, round, material);
}
NodePtr translate(const Point& by, NodePtr child) { return std::make_unique<Translate>(by, std::move(child)); }
// Many children become a hierarchy of boxes: without one, thousands of struts would take thousands of times
// as long, which is not what the 2025 paper measured.
NodePtr unite(Nodes children) {
  constexpr size_t few = 8;
  if (children.size() <= few) return std::make_unique<Union>(std::move(children));
  const auto middle = children.begin() + static_cast<std::ptrdiff_t>(children.size() / 2);
  const auto along = longest_side(combined_box(children, hull));
  std::nth_element(children.begin(), middle, children.end(), [along](const NodePtr& a, const NodePtr& b) {
    return a->box().lo.*along + a->box().hi.*along < b->box().lo.*along + b->box().hi.*along;
  });
  Nodes lower(std::make_move_iterator(children.begin()), std::make_move_iterator(middle));
  Nodes upper(std::make_move_iterator(middle), std::make_move_iterator(children.end()));
  Nodes halves;
  halves.push_back(unite(std::move(lower)));
  halves.push_back(unite(std::move(upper)));
  return std::make_unique<Union>(std::move(halves));
}
NodePtr intersect(Nodes children) { return std::make_unique<Intersection>(std::move(children)); }
NodePtr subtract(Nodes children) { return std::make_unique<Difference>(std::move(children)); }

}  // namespace baseline
