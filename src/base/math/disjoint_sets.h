// Numbers 0, 1, 2, ... that are joined into sets.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace ombre {

// Union-find with path halving (R. E. Tarjan and J. van Leeuwen, 1984). The least number of a set stands for it, so
// that results do not depend on the order in which sets are joined.
class DisjointSets {
 public:
  explicit DisjointSets(size_t count = 0) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), uint32_t{0});
  }

  size_t count() const { return parents_.size(); }
  // Adds a set of one number, and returns that.
  uint32_t add() {
    parents_.push_back(static_cast<uint32_t>(parents_.size()));
    return parents_.back();
  }
  // Returns the least number of the set that holds n.
  uint32_t root(uint32_t n) {
    while (parents_[n] != n) n = parents_[n] = parents_[parents_[n]];
    return n;
  }
  void join(uint32_t a, uint32_t b) {
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parents_;
};

}  // namespace ombre
