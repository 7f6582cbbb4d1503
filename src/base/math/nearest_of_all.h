// Finds the nearest elements of a tree of boxes for many points, of which consecutive ones are near each other.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/math/box_tree.h"

namespace ombre {

// Lists what may be nearest to points that lie near each other, then shorter lists for parts of them, and so on. Where
// lists would be long, points are looked up one by one.
class NearestOfAll {
 public:
  struct Nearest {
    double squared = HUGE_VAL;  // mm^2
    uint32_t number = 0;
  };

  // Sets nearest[n] for points[n], which must be finite: of several nearest elements the one with the least number,
  // infinity in an empty tree.
  // `squared` returns the squared distance from a point to an element, by its number. It must be at least that to the
  // element's box, up to rounding.
  template <class Squared>
  void find(const BoxTree& tree, std::span<const Vec3> points, const Squared& squared, std::span<Nearest> nearest) {
    if (tree.empty()) return static_cast<void>(std::ranges::fill(nearest, Nearest{}));
    guess_.reset();
    for (size_t begin = 0; begin < points.size();) {
      const size_t count = std::min(together_, points.size() - begin);
      divide(tree, points.subspan(begin, count), squared, nearest.subspan(begin, count));
      begin += count;
    }
  }

  // Returns the nearest element to one point, none of which is farther than `reach`.
  template <class Squared>
  static Nearest find_one(const BoxTree& tree, Vec3 point, double reach, const Squared& squared) {
    Nearest best;
    tree.nearest(point, with_room(reach), -1, [&](uint32_t number) {
      take({squared(point, number), number}, best);
      return with_room(std::sqrt(best.squared));
    });
    return best;
  }

 private:
  static constexpr size_t few_points = 8;
  static constexpr size_t parts = 4;                                    // that points with a list are divided into
  static constexpr size_t per_element = 2;                              // points for each element of a list, at least
  static constexpr size_t most_together = 128, before_next_try = 1024;  // points

  struct Ball {
    Vec3 centre;
    double radius = 0;
  };
  // An element that may be nearest to points of a ball.
  struct Listed {
    double distance = 0;  // from the centre of the ball, mm
    uint32_t number = 0;
    bool operator<(const Listed& other) const { return distance < other.distance; }
  };

  // Returns a distance with room, so that rounding does not decide which elements are compared.
  static double with_room(double distance) { return distance * (1 + 1e-9) + 1e-9; }
  static void take(const Nearest& other, Nearest& best) {
    if (other.squared < best.squared || (other.squared == best.squared && other.number < best.number)) best = other;
  }
  static Ball ball_around(std::span<const Vec3> points) {
    Box box;
    for (const Vec3 p : points) box = hull(box, {p, p});
    return {box.center(), 0.5 * length(box.size())};
  }
  // Returns how far what is nearest to a point of the ball is from its centre at most.
  static double reach_of(const Ball& ball, double least) { return with_room(least + 2 * ball.radius); }

  // Divides the points until few elements may be nearest, or few points are left.
  template <class Squared>
  void divide(const BoxTree& tree, std::span<const Vec3> points, const Squared& squared, std::span<Nearest> nearest) {
    if (points.size() <= few_points) return find_each(tree, points, squared, nearest);
    const Ball ball = ball_around(points);
    list_.clear();
    if (list_near(tree, ball, points.size() / per_element, squared)) {
      if (points.size() == together_) together_ = std::min(2 * together_, most_together);
      return compare(points, ball, 0, squared, nearest);
    }
    const size_t half = points.size() / 2;
    together_ = std::max(half, few_points);
    divide(tree, points.first(half), squared, nearest.first(half));
    divide(tree, points.subspan(half), squared, nearest.subspan(half));
  }
  // Points that were too far from each other for lists are followed by others that may be nearer to each other.
  void count_alone(size_t points) {
    alone_ += points;
    if (alone_ < before_next_try) return;
    alone_ = 0;
    together_ = std::min(std::max(2 * together_, 4 * few_points), most_together);
  }

  // Finds the nearest element, which is not farther than the one that was found last.
  template <class Squared>
  Nearest find_next(const BoxTree& tree, Vec3 p, const Squared& squared) {
    const Nearest found = find_one(tree, p, guess_ ? std::sqrt(squared(p, *guess_)) : HUGE_VAL, squared);
    guess_ = found.number;
    return found;
  }
  template <class Squared>
  void find_each(const BoxTree& tree, std::span<const Vec3> points, const Squared& squared,
                 std::span<Nearest> nearest) {
    for (size_t n = 0; n < points.size(); ++n) nearest[n] = find_next(tree, points[n], squared);
    count_alone(points.size());
  }

  // Returns false if more than `most` elements may be nearest.
  template <class Squared>
  bool list_near(const BoxTree& tree, const Ball& ball, size_t most, const Squared& squared) {
    const double reach = reach_of(ball, std::sqrt(find_next(tree, ball.centre, squared).squared));
    const bool are_all = tree.each_within(ball.centre, reach, [&](uint32_t number) {
      const double distance = std::sqrt(squared(ball.centre, number));
      if (distance <= reach) list_.push_back({distance, number});
      return list_.size() <= most;
    });
    if (are_all) std::sort(list_.begin(), list_.end());
    return are_all;
  }

  // Looks for what is nearest in the list from `first` on, which was made for the ball and is sorted by distance.
  template <class Squared>
  void compare(std::span<const Vec3> points, const Ball& ball, size_t first, const Squared& squared,
               std::span<Nearest> nearest) {
    if (points.size() > few_points && list_.size() - first > 1)
      return compare_parts(points, ball, first, squared, nearest);
    for (size_t n = 0; n < points.size(); ++n) {
      const double moved = length(points[n] - ball.centre);
      Nearest best;
      double reach = HUGE_VAL;
      for (size_t i = first; i < list_.size() && list_[i].distance - moved <= reach; ++i) {
        take({squared(points[n], list_[i].number), list_[i].number}, best);
        reach = with_room(std::sqrt(best.squared));
      }
      nearest[n] = best;
    }
  }
  template <class Squared>
  void compare_parts(std::span<const Vec3> points, const Ball& ball, size_t first, const Squared& squared,
                     std::span<Nearest> nearest) {
    const size_t last = list_.size(), most = (points.size() + parts - 1) / parts;
    for (size_t begin = 0; begin < points.size(); begin += most) {
      const size_t count = std::min(most, points.size() - begin);
      const Ball part = ball_around(points.subspan(begin, count));
      shorten(ball, part, first, last, squared);
      compare(points.subspan(begin, count), part, last, squared, nearest.subspan(begin, count));
      list_.resize(last);
    }
  }
  // Appends those elements of [first, last) of the list, made for `ball`, that may be nearest to points of `part`.
  template <class Squared>
  void shorten(const Ball& ball, const Ball& part, size_t first, size_t last, const Squared& squared) {
    const double moved = length(part.centre - ball.centre);
    double reach = HUGE_VAL;
    for (size_t i = first; i < last && list_[i].distance - moved <= reach; ++i) {
      const double distance = std::sqrt(squared(part.centre, list_[i].number));
      reach = std::min(reach, reach_of(part, distance));
      list_.push_back({distance, list_[i].number});
    }
    const auto begin = list_.begin() + static_cast<std::ptrdiff_t>(last);
    std::sort(begin, list_.end());
    while (list_.back().distance > reach) list_.pop_back();
  }

  std::optional<uint32_t> guess_;    // what was found last
  size_t together_ = most_together;  // points that are tried at first; it changes no result
  size_t alone_ = 0;                 // points that were looked up one by one since the last try
  std::vector<Listed> list_;
};

}  // namespace ombre
