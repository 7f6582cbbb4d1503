// Draws charts of points as SVG.
#pragma once

#include <string>
#include <vector>

namespace ombre::optimise {

struct ChartPoint {
  double x = 0, y = 0;
  enum class Kind { best, feasible, other } kind = Kind::feasible;
};

struct Chart {
  std::string title, x_label, y_label;
  std::vector<ChartPoint> points;
  bool joins_best = false;  // draws a line through the best points, in their order
};

// Returns a picture of 640 by 440 pixels, with axes and round numbers on them.
std::string chart_svg(const Chart& chart);

}  // namespace ombre::optimise
