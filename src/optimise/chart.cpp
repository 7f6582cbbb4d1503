#include "optimise/chart.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"

namespace ombre::optimise {
namespace {

constexpr double width = 640, height = 440, left = 80, right = 20, top = 40, bottom = 60;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return result;
}

std::string px(double value) { return format_number(std::round(value * 100) / 100); }

// An axis from one round number to another.
struct Axis {
  double low = 0, high = 1, step = 0.2;

  Axis(const std::vector<ChartPoint>& points, double ChartPoint::*coordinate) {
    if (points.empty()) return;
    const auto [least, most] = std::ranges::minmax_element(points, {}, coordinate);
    const double first = *least.*coordinate, last = *most.*coordinate;
    const double span = last > first ? last - first : std::max(std::abs(first), 1.0);
    const double power = std::pow(10, std::floor(std::log10(span / 5)));
    const double digit = span / 5 / power;
    step = power * (digit <= 1 ? 1 : digit <= 2 ? 2 : digit <= 5 ? 5 : 10);
    low = std::floor(first / step) * step;
    high = std::max(std::ceil(last / step) * step, low + step);
  }
  double share(double value) const { return (value - low) / (high - low); }
  int ticks() const { return static_cast<int>(std::lround((high - low) / step)); }
  std::string label(int tick) const { return format_rounded(low + tick * step, 6); }
};

class Drawing {
 public:
  explicit Drawing(const Chart& chart)
      : chart_(chart), x_(chart.points, &ChartPoint::x), y_(chart.points, &ChartPoint::y) {}

  std::string svg() {
    text_ =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"640\" height=\"440\" viewBox=\"0 0 640 440\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"640\" height=\"440\" fill=\"white\"/>\n";
    label(width / 2, 24, "middle", chart_.title, " font-size=\"15\"");
    draw_axes();
    if (chart_.joins_best) draw_line();
    for (const auto kind : {ChartPoint::Kind::other, ChartPoint::Kind::feasible, ChartPoint::Kind::best})
      for (const ChartPoint& point : chart_.points)
        if (point.kind == kind) draw(point);
    return text_ + "</svg>\n";
  }

 private:
  double across(double x) const { return left + x_.share(x) * (width - left - right); }
  double down(double y) const { return height - bottom - y_.share(y) * (height - top - bottom); }

  void label(double x, double y, const char* anchor, const std::string& text, const std::string& more = "") {
    text_ += "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" +
             escaped(text) + "</text>\n";
  }

  void line(double x0, double y0, double x1, double y1) {
    text_ += "<path d=\"M" + px(x0) + " " + px(y0) + "L" + px(x1) + " " + px(y1) + "\" stroke=\"#ddd\"/>\n";
  }

  void draw_axes() {
    for (int tick = 0; tick <= x_.ticks(); ++tick) {
      const double x = across(x_.low + tick * x_.step);
      line(x, top, x, height - bottom);
      label(x, height - bottom + 18, "middle", x_.label(tick));
    }
    for (int tick = 0; tick <= y_.ticks(); ++tick) {
      const double y = down(y_.low + tick * y_.step);
      line(left, y, width - right, y);
      label(left - 8, y + 4, "end", y_.label(tick));
    }
    label((left + width - right) / 2, height - 16, "middle", chart_.x_label);
    const double middle = (top + height - bottom) / 2;
    label(20, middle, "middle", chart_.y_label, " transform=\"rotate(-90 20 " + px(middle) + ")\"");
  }

  void draw_line() {
    std::string path;
    for (const ChartPoint& point : chart_.points)
      if (point.kind == ChartPoint::Kind::best)
        path += (path.empty() ? "M" : "L") + px(across(point.x)) + " " + px(down(point.y));
    if (!path.empty()) text_ += "<path d=\"" + path + "\" fill=\"none\" stroke=\"#c0392b\"/>\n";
  }

  void draw(const ChartPoint& point) {
    const char* const colour = point.kind == ChartPoint::Kind::best       ? "#c0392b"
                               : point.kind == ChartPoint::Kind::feasible ? "#2c6fad"
                                                                          : "#bbb";
    text_ += "<circle cx=\"" + px(across(point.x)) + "\" cy=\"" + px(down(point.y)) + "\" r=\"" +
             (point.kind == ChartPoint::Kind::best ? "4" : "3") + "\" fill=\"" + colour + "\"/>\n";
  }

  const Chart& chart_;
  Axis x_, y_;
  std::string text_;
};

}  // namespace

std::string chart_svg(const Chart& chart) { return Drawing(chart).svg(); }

}  // namespace ombre::optimise
