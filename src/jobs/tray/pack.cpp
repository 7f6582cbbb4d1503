#include "jobs/tray/pack.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace ombre::compile {
namespace {

struct FreeArea {
  int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  bool holds(const FreeArea& other) const {
    return x0 <= other.x0 && y0 <= other.y0 && x1 >= other.x1 && y1 >= other.y1;
  }
  bool overlaps(const FreeArea& other) const {
    return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
};

// The areas of the tray that are free, each as large as it can be; they overlap each other.
class FreeAreas {
 public:
  FreeAreas(int64_t width, int64_t height) : areas_{{0, 0, width, height}} {}

  // Returns the place that leaves the least beside the rectangle, and of several the lowest, then leftmost.
  std::optional<PackPlace> place(int64_t width, int64_t height) {
    std::optional<PackPlace> best;
    std::tuple<int64_t, int64_t, int64_t, int64_t> least;
    for (const FreeArea& area : areas_) {
      const int64_t beside = area.x1 - area.x0 - width, above = area.y1 - area.y0 - height;
      if (beside < 0 || above < 0) continue;
      const std::tuple rank{std::min(beside, above), std::max(beside, above), area.y0, area.x0};
      if (best && rank >= least) continue;
      best = PackPlace{area.x0, area.y0}, least = rank;
    }
    if (best) take({best->x, best->y, best->x + width, best->y + height});
    return best;
  }

 private:
  void take(const FreeArea& taken) {
    std::vector<FreeArea> left;
    for (const FreeArea& area : areas_) {
      if (!area.overlaps(taken)) {
        left.push_back(area);
        continue;
      }
      if (area.x0 < taken.x0) left.push_back({area.x0, area.y0, taken.x0, area.y1});
      if (taken.x1 < area.x1) left.push_back({taken.x1, area.y0, area.x1, area.y1});
      if (area.y0 < taken.y0) left.push_back({area.x0, area.y0, area.x1, taken.y0});
      if (taken.y1 < area.y1) left.push_back({area.x0, taken.y1, area.x1, area.y1});
    }
    areas_ = largest(left);
  }

  // Leaves out areas that lie in others; of equal ones the first stays.
  static std::vector<FreeArea> largest(const std::vector<FreeArea>& areas) {
    std::vector<FreeArea> kept;
    for (size_t n = 0; n < areas.size(); ++n) {
      bool is_held = false;
      for (size_t m = 0; m < areas.size() && !is_held; ++m)
        is_held = m != n && areas[m].holds(areas[n]) && (m < n || !areas[n].holds(areas[m]));
      if (!is_held) kept.push_back(areas[n]);
    }
    return kept;
  }

  std::vector<FreeArea> areas_;
};

}  // namespace

std::vector<std::optional<PackPlace>> pack(const std::vector<Rectangle>& rectangles, Rectangle tray, Rectangle gap) {
  std::vector<size_t> order(rectangles.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto longest_side = [&](size_t n) { return std::max(rectangles[n].width, rectangles[n].height); };
  std::ranges::stable_sort(order, [&](size_t a, size_t b) { return longest_side(a) > longest_side(b); });
  // Each rectangle takes the gap beside and above it; beyond the tray's edge there is room for it.
  FreeAreas areas(tray.width + gap.width, tray.height + gap.height);
  std::vector<std::optional<PackPlace>> places(rectangles.size());
  for (const size_t n : order)
    places[n] = areas.place(rectangles[n].width + gap.width, rectangles[n].height + gap.height);
  return places;
}

}  // namespace ombre::compile
