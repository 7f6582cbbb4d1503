#include "jobs/characterise/strut_joints.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math/segment_sets.h"

namespace ombre::compile {
namespace {

double greatest_length(const std::vector<GraphStrut>& struts) {
  double greatest = 0;
  for (const GraphStrut& strut : struts) greatest = std::max(greatest, length(strut.end - strut.start));
  return greatest;
}

std::vector<Edge3> edges_of(const std::vector<GraphStrut>& struts) {
  std::vector<Edge3> edges;
  for (const GraphStrut& strut : struts) edges.push_back({strut.start, strut.end});
  return edges;
}

class GraphMaker {
 public:
  GraphMaker(const std::vector<GraphStrut>& struts, Vec3 period, const Affine& mm_from_here)
      : tolerance_(same_joint * greatest_length(struts)), mm_from_here_(mm_from_here) {
    // Each of two ends may be away from the place that both stand for, and places of three struts from each other.
    const double of_ends = 3 * tolerance_;
    const std::vector<GraphStrut> parts = split_at_joints(struts, period, tolerance_);
    const std::vector<uint32_t> places = places_of_ends(edges_of(parts), of_ends, period);
    ways_.resize(places.size());
    for (size_t n = 0; n < parts.size(); ++n) add(parts[n], places[2 * n], places[2 * n + 1], 2 * of_ends);
  }

  StrutGraph make() {
    is_counted_.assign(count_, false);
    for (size_t place = 0; place < ways_.size(); ++place)
      if (!ways_[place].empty() && !go_straight_on(ways_[place])) count_joint(place);
    // The struts that are left are lines that close in their period. One joint stands for each line.
    for (size_t place = 0; place < ways_.size(); ++place)
      if (!ways_[place].empty() && go_straight_on(ways_[place]) && !is_counted_[ways_[place][0].strut])
        count_joint(place);
    graph_.struts = lengths_.size() / 2;
    graph_.length = Spread::of(lengths_);
    if (slenderness_.size() == lengths_.size()) graph_.slenderness = Spread::of(slenderness_);
    return std::move(graph_);
  }

 private:
  // Half of a strut, as it leaves a place.
  struct Way {
    size_t strut = 0, to = 0;
    Vec3 along;  // from place to place
    double radius = 0;
  };
  struct Line {
    double length = 0, radius = 0;  // mm; the least radius
  };

  // Adds a strut. Of equal struts, whose ends are at most `apart` from each other, the thickest counts.
  void add(const GraphStrut& strut, size_t from, size_t to, double apart) {
    const Vec3 along = strut.end - strut.start;
    if (from == to && length(along) <= apart) return;
    const auto is_same = [&](const Way& way) { return way.to == to && length(way.along - along) <= apart; };
    const auto same = std::ranges::find_if(ways_[from], is_same);
    if (same != ways_[from].end()) return thicken(same->strut, from, to, strut.radius);
    ways_[from].push_back({count_, to, along, strut.radius});
    ways_[to].push_back({count_, from, -along, strut.radius});
    ++count_;
  }

  // An unknown radius may be the greater one.
  void thicken(size_t strut, size_t from, size_t to, double radius) {
    for (const size_t place : {from, to})
      for (Way& way : ways_[place])
        if (way.strut == strut) way.radius = std::min(way.radius, radius) > 0 ? std::max(way.radius, radius) : 0;
  }

  // Returns true if two struts of one line meet here, and no others.
  static bool go_straight_on(const std::vector<Way>& ways) {
    if (ways.size() != 2) return false;
    const Vec3 a = ways[0].along, b = ways[1].along;
    return dot(a, b) < 0 && length(cross(a, b)) < same_joint * length(a) * length(b);
  }

  // Counts a joint and the lengths of its struts. All lengths are there twice at last, from both ends.
  void count_joint(size_t place) {
    ++graph_.joints;
    ++graph_.joints_of_degree[ways_[place].size()];
    for (const Way& way : ways_[place]) {
      const Line line = followed(way, place);
      lengths_.push_back(line.length);
      if (line.radius > 0) slenderness_.push_back(2 * line.length / line.radius);
    }
  }

  // Follows a way to the next joint, at which it does not go straight on, or back to its beginning.
  Line followed(Way way, size_t beginning) {
    Line line{mm(way), way.radius};
    is_counted_[way.strut] = true;
    while (way.to != beginning && go_straight_on(ways_[way.to])) {
      const std::vector<Way>& ways = ways_[way.to];
      way = ways[0].strut == way.strut ? ways[1] : ways[0];
      is_counted_[way.strut] = true;
      line.length += mm(way);
      line.radius = std::min(line.radius, way.radius);
    }
    return line;
  }

  double mm(const Way& way) const { return length(mm_from_here_.linear(way.along)); }

  double tolerance_;
  Affine mm_from_here_;
  size_t count_ = 0;
  std::vector<std::vector<Way>> ways_;  // by place
  std::vector<bool> is_counted_;
  std::vector<double> lengths_, slenderness_;
  StrutGraph graph_;
};

}  // namespace

StrutGraph graph_of(const std::vector<GraphStrut>& struts, Vec3 period, const Affine& mm_from_here) {
  return GraphMaker(struts, period, mm_from_here).make();
}

}  // namespace ombre::compile
