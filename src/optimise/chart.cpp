#include "optimise/chart.h"

#include <algorithm>
#include <cmath>

#include "base/math/round_numbers.h"
#include "formats/containers/svg_picture.h"

namespace ombre::optimise {
namespace {

constexpr double width = 640, height = 440, left = 80, right = 20, top = 40, bottom = 60;  // pixels
constexpr const char *grid = "stroke=\"#ddd\"", *front = "fill=\"none\" stroke=\"#c0392b\"";

// An axis from one round number to another.
struct Axis {
  double low = 0, high = 1, step = 0.2;

  Axis(const std::vector<ChartPoint>& points, double ChartPoint::*coordinate) {
    if (points.empty()) return;
    const auto [least, most] = std::ranges::minmax_element(points, {}, coordinate);
    const double first = *least.*coordinate, last = *most.*coordinate;
    const double span = last > first ? last - first : std::max(std::abs(first), 1.0);
    step = math::least_round(span / 5);
    low = std::floor(first / step) * step;
    high = std::max(std::ceil(last / step) * step, low + step);
  }
  double share(double value) const { return (value - low) / (high - low); }
  int ticks() const { return static_cast<int>(std::lround((high - low) / step)); }
  double at(int tick) const { return low + tick * step; }
  std::string label(int tick) const { return format_rounded(at(tick), 6); }
};

class Drawing {
 public:
  explicit Drawing(const Chart& chart)
      : chart_(chart), x_(chart.points, &ChartPoint::x), y_(chart.points, &ChartPoint::y) {}

  std::string svg() {
    picture_.words(width / 2, 24, "middle", chart_.title, "font-size=\"15\"");
    draw_axes();
    if (chart_.joins_best) draw_line();
    for (const auto kind : {ChartPoint::Kind::other, ChartPoint::Kind::feasible, ChartPoint::Kind::best})
      for (const ChartPoint& point : chart_.points)
        if (point.kind == kind) draw(point);
    return picture_.svg();
  }

 private:
  double across(double x) const { return left + x_.share(x) * (width - left - right); }
  double down(double y) const { return height - bottom - y_.share(y) * (height - top - bottom); }

  void draw_axes() {
    for (int tick = 0; tick <= x_.ticks(); ++tick) {
      const double x = across(x_.at(tick));
      picture_.line(x, top, x, height - bottom, grid);
      picture_.words(x, height - bottom + 18, "middle", x_.label(tick));
    }
    for (int tick = 0; tick <= y_.ticks(); ++tick) {
      const double y = down(y_.at(tick));
      picture_.line(left, y, width - right, y, grid);
      picture_.words(left - 8, y + 4, "end", y_.label(tick));
    }
    picture_.words((left + width - right) / 2, height - 16, "middle", chart_.x_label);
    constexpr double middle = (top + height - bottom) / 2;
    picture_.words(20, middle, "middle", chart_.y_label,
                   "transform=\"rotate(-90 20 " + format_rounded(middle, 6) + ")\"");
  }

  void draw_line() {
    formats::SvgPath path;
    for (const ChartPoint& point : chart_.points)
      if (point.kind == ChartPoint::Kind::best) path.to(across(point.x), down(point.y));
    if (!path.open().empty()) picture_.path(path.open(), front);
  }

  void draw(const ChartPoint& point) {
    const bool is_best = point.kind == ChartPoint::Kind::best;
    const char* const colour = is_best ? "#c0392b" : point.kind == ChartPoint::Kind::feasible ? "#2c6fad" : "#bbb";
    picture_.circle(across(point.x), down(point.y), is_best ? 4 : 3, std::string("fill=\"") + colour + "\"");
  }

  const Chart& chart_;
  Axis x_, y_;
  formats::SvgPicture picture_{width, height};
};

}  // namespace

std::string chart_svg(const Chart& chart) { return Drawing(chart).svg(); }

}  // namespace ombre::optimise
