// Joins lines whose ends meet to closed rings.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/math/polygons.h"

namespace ombre::formats {

// Closed rings, and what was found on the way to them.
struct JoinedLines {
  std::vector<Ring> rings;
  double tolerance = 0;   // the distance within which ends meet
  double joined_gap = 0;  // the greatest distance between ends that were joined
  size_t open = 0;        // chains whose ends do not meet, closed by a straight line
  double widest_gap = 0;  // the greatest distance between the ends of such a chain
  size_t single = 0;      // lines and chains that enclose nothing
  size_t doubles = 0;     // lines and rings that lie on another one; each counts once
};

class LineJoiner {
 public:
  void add(Ring line) {
    if (line.size() > 1) lines_.push_back(std::move(line));
  }

  // Joins the lines. Ends meet if their distance is at most 0.001, or a ten-thousandth of a small drawing's size.
  JoinedLines join();

 private:
  // The end of a line: its first point for an even number, else its last.
  using End = size_t;

  struct CellHash {
    size_t operator()(const std::pair<int64_t, int64_t>& cell) const {
      return std::hash<int64_t>()(cell.first * 0x9E3779B97F4A7C15LL ^ cell.second);
    }
  };

  void set_tolerance();
  void remove_doubles();
  void remove_double_rings();
  void index_ends();
  Vec2 point(End end) const { return end % 2 == 0 ? lines_[end / 2].front() : lines_[end / 2].back(); }
  std::pair<int64_t, int64_t> cell_of(Vec2 p) const;
  bool is_closed(const Ring& ring) const;
  void extend(Ring& ring);
  // Takes the nearest end that is free within the tolerance out of the index; SIZE_MAX if there is none.
  End take_end(Vec2 at);

  std::vector<Ring> lines_;
  std::vector<bool> is_used_;
  std::unordered_map<std::pair<int64_t, int64_t>, std::vector<End>, CellHash> ends_;
  JoinedLines result_;
};

}  // namespace ombre::formats
