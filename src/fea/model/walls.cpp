#include "fea/model/walls.h"

#include <algorithm>
#include <numeric>

namespace ombre::fea {
namespace {

// Marks the thin walls along an axis.
class Runs {
 public:
  Runs(const Bricks& bricks, size_t axis, std::vector<uint8_t>& is_thin)
      : bricks_(bricks), axis_(axis), is_thin_(is_thin), order_(bricks.count()) {
    std::iota(order_.begin(), order_.end(), size_t{0});
    const auto key = [&](size_t n) {
      const Cell& cell = bricks_.cells[n];
      return std::array{cell[(axis_ + 1) % 3], cell[(axis_ + 2) % 3], cell[axis_]};
    };
    std::ranges::sort(order_, {}, key);
  }

  void mark() {
    for (size_t begin = 0; begin < order_.size();) {
      size_t end = begin + 1;
      while (end < order_.size() && is_on_line(order_[begin], order_[end])) ++end;
      mark_line(begin, end);
      begin = end;
    }
  }

 private:
  bool is_on_line(size_t a, size_t b) const {
    const Cell &one = bricks_.cells[a], &other = bricks_.cells[b];
    return one[(axis_ + 1) % 3] == other[(axis_ + 1) % 3] && one[(axis_ + 2) % 3] == other[(axis_ + 2) % 3];
  }

  int32_t place(size_t n) const { return bricks_.cells[order_[n]][axis_]; }

  // If the mesh repeats, the last run of the line may continue in the first.
  void mark_line(size_t begin, size_t end) {
    std::vector<size_t> starts;
    for (size_t n = begin; n < end; ++n)
      if (n == begin || place(n) != place(n - 1) + 1) starts.push_back(n);
    const int32_t period = bricks_.period[axis_];
    const bool joins = period > 0 && place(begin) == 0 && place(end - 1) == period - 1;
    if (joins && starts.size() == 1) return;
    std::vector<double> lengths;
    for (size_t n = 0; n < starts.size(); ++n) lengths.push_back(length(starts[n], behind(starts, n, end)));
    if (joins) lengths.front() = lengths.back() = lengths.front() + lengths.back();
    constexpr double rounding = 1e-9;
    for (size_t n = 0; n < starts.size(); ++n)
      if (lengths[n] < few_bricks - rounding)
        for (size_t at = starts[n]; at < behind(starts, n, end); ++at) is_thin_[order_[at]] = 1;
  }

  static size_t behind(const std::vector<size_t>& starts, size_t n, size_t end) {
    return n + 1 < starts.size() ? starts[n + 1] : end;
  }

  double length(size_t begin, size_t end) const {
    double sum = 0;
    for (size_t n = begin; n < end; ++n) sum += bricks_.share(order_[n]);
    return sum;
  }

  const Bricks& bricks_;
  size_t axis_;
  std::vector<uint8_t>& is_thin_;
  std::vector<size_t> order_;
};

}  // namespace

std::vector<uint8_t> bricks_of_thin_walls(const Bricks& bricks) {
  std::vector<uint8_t> is_thin(bricks.count());
  for (size_t axis = 0; axis < 3; ++axis) Runs(bricks, axis, is_thin).mark();
  return is_thin;
}

double share_of_thin_walls(const Bricks& bricks) {
  const std::vector<uint8_t> is_thin = bricks_of_thin_walls(bricks);
  double thin = 0, all = 0;
  for (size_t n = 0; n < bricks.count(); ++n) {
    all += bricks.share(n);
    if (is_thin[n] != 0) thin += bricks.share(n);
  }
  return all > 0 ? thin / all : 0;
}

}  // namespace ombre::fea
