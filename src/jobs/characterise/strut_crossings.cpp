#include "jobs/characterise/strut_crossings.h"

#include <algorithm>
#include <cmath>

#include "base/math/box_tree.h"
#include "base/math/periodic_copies.h"

namespace ombre::compile {
namespace {

Box box_of(const GraphStrut& strut) { return hull(Box{strut.start, strut.start}, Box{strut.end, strut.end}); }

// Finds the places along a strut, from 0 at its start to 1 at its end, where others meet it between its ends.
class MeetingPlaces {
 public:
  MeetingPlaces(const GraphStrut& strut, double tolerance)
      : strut_(strut), way_(strut.end - strut.start), length_(length(way_)), tolerance_(tolerance) {}

  void add(const GraphStrut& other) {
    for (const Vec3 end : {other.start, other.end}) {
      const double at = dot(end - strut_.start, way_) / (length_ * length_);
      if (length(strut_.start + at * way_ - end) <= tolerance_) add(at);
    }
    add_crossing(other);
  }

  // Returns the parts of the strut between the places.
  std::vector<GraphStrut> parts() {
    std::ranges::sort(places_);
    std::vector<GraphStrut> all;
    double from = 0;
    for (const double at : places_) {
      if ((at - from) * length_ <= tolerance_) continue;
      all.push_back({point(from), point(at), strut_.radius});
      from = at;
    }
    all.push_back({point(from), strut_.end, strut_.radius});
    return all;
  }

 private:
  void add(double at) {
    if (std::min(at, 1 - at) * length_ > tolerance_) places_.push_back(at);
  }

  // Struts that are in line but for the tolerance meet at their ends alone.
  void add_crossing(const GraphStrut& other) {
    const Vec3 other_way = other.end - other.start, normal = cross(way_, other_way),
               between = other.start - strut_.start;
    const double other_length = length(other_way), sine = length(normal) / (length_ * other_length);
    if (!(sine > same_joint)) return;
    if (std::abs(dot(between, normal)) > tolerance_ * length(normal)) return;
    const double squared = dot(normal, normal);
    const double here = dot(cross(between, other_way), normal) / squared;
    const double there = dot(cross(between, way_), normal) / squared;
    if (std::max(-there, there - 1) * other_length <= tolerance_) add(here);
  }

  Vec3 point(double at) const { return at == 0 ? strut_.start : strut_.start + at * way_; }

  GraphStrut strut_;
  Vec3 way_;
  double length_, tolerance_;
  std::vector<double> places_;
};

// A strut that begins in the first period, so that few copies come near it.
GraphStrut moved_home(const GraphStrut& strut, Vec3 period) {
  const Vec3 by = within_period(strut.start, period) - strut.start;
  return {strut.start + by, strut.end + by, strut.radius};
}

}  // namespace

std::vector<GraphStrut> split_at_joints(const std::vector<GraphStrut>& struts, Vec3 period, double tolerance) {
  std::vector<GraphStrut> home, copies;
  Box all;
  for (const GraphStrut& strut : struts) {
    if (length(strut.end - strut.start) <= tolerance) continue;
    home.push_back(moved_home(strut, period));
    all = hull(all, box_of(home.back()).expanded(tolerance));
  }
  for (const GraphStrut& strut : home)
    each_copy_that_meets(box_of(strut), all, period, [&](Vec3 by) {
      copies.push_back({strut.start + by, strut.end + by, strut.radius});
    });
  std::vector<Box> boxes;
  for (const GraphStrut& copy : copies) boxes.push_back(box_of(copy));
  const BoxTree tree(boxes);
  std::vector<GraphStrut> parts;
  for (const GraphStrut& strut : home) {
    MeetingPlaces places(strut, tolerance);
    tree.each_that_meets(box_of(strut).expanded(tolerance), [&](size_t n) { places.add(copies[n]); });
    std::ranges::copy(places.parts(), std::back_inserter(parts));
  }
  return parts;
}

}  // namespace ombre::compile
