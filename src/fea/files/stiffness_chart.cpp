// Draws polar diagrams of a stiffness.
#include <cmath>

#include "base/math/math.h"
#include "base/text/text.h"
#include "fea/solve/homogenise.h"

namespace ombre::fea {
namespace {

constexpr double radius = 100, gap = 40, top = 50;  // lengths in the picture's units
constexpr int directions = 180, rings = 4;

struct ChartPlane {
  const char* name;
  int first, second;  // axes to the right and upwards
};
constexpr std::array<ChartPlane, 3> planes{{{"xy", 0, 1}, {"yz", 1, 2}, {"zx", 2, 0}}};

std::string number(double value) { return format_rounded(value, 6); }

std::string text_at(double x, double y, const std::string& text, const char* anchor) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\">" + text + "</text>\n";
}

// Returns the step between rings, the smallest of 1, 2 and 5 times a power of 10 with which the outermost ring
// encloses the greatest value.
double step_for(double greatest) {
  if (!(greatest > 0)) return 1;
  double power = 1;
  while (power * rings > greatest) power /= 10;
  while (10 * power * rings <= greatest) power *= 10;
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power * rings >= greatest) return factor * power;
  return 10 * power;
}

std::string diagram(const Stiffness& stiffness, const ChartPlane& plane, double x, double step) {
  const double y = top + radius;
  const char* axes = "xyz";
  std::string svg;
  for (int n = 1; n <= rings; ++n)
    svg += "<circle class=\"ring\" cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"" +
           number(radius * n / rings) + "\"/>\n";
  svg += "<path class=\"ring\" d=\"M" + number(x - radius) + " " + number(y) + "H" + number(x + radius) + "M" +
         number(x) + " " + number(y - radius) + "V" + number(y + radius) + "\"/>\n<path class=\"modulus\" d=\"";
  for (int n = 0; n < directions; ++n) {
    const double angle = 360.0 * n / directions * math::degree;
    Vec3 d;
    d[plane.first] = math::cos(angle);
    d[plane.second] = math::sin(angle);
    const double reach = modulus_along(stiffness, d) / (step * rings) * radius;
    svg += (n == 0 ? "M" : "L") + number(x + reach * math::cos(angle)) + " " + number(y - reach * math::sin(angle));
  }
  svg += "Z\"/>\n";
  svg += text_at(x + radius + 4, y + 4, std::string(1, axes[plane.first]), "start");
  svg += text_at(x, y - radius - 4, std::string(1, axes[plane.second]), "middle");
  svg += text_at(x, y + radius + 18, std::string("plane ") + plane.name, "middle");
  return svg;
}

}  // namespace

std::string stiffness_chart(const Stiffness& stiffness, const std::string& title) {
  double greatest = 0;
  for (const ChartPlane& plane : planes)
    for (int n = 0; n < directions; ++n) {
      Vec3 d;
      d[plane.first] = math::cos(360.0 * n / directions * math::degree);
      d[plane.second] = math::sin(360.0 * n / directions * math::degree);
      greatest = std::max(greatest, modulus_along(stiffness, d));
    }
  const double step = step_for(greatest), width = 3 * (2 * radius + gap) + gap, height = top + 2 * radius + 60;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width) + " " + number(height) +
                    "\" font-family=\"sans-serif\" font-size=\"12\">\n"
                    "<style>.ring{fill:none;stroke:#999;stroke-width:.5}.modulus{fill:#3b6fb6;fill-opacity:.3;"
                    "stroke:#3b6fb6;stroke-width:1.5}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  svg += text_at(width / 2, 20, title, "middle");
  for (size_t n = 0; n < planes.size(); ++n)
    svg += diagram(stiffness, planes[n], gap + radius + static_cast<double>(n) * (2 * radius + gap), step);
  svg += text_at(width / 2, height - 12,
                 "Young's modulus by direction; rings every " + format_rounded(step, 3) + " MPa", "middle");
  return svg + "</svg>\n";
}

}  // namespace ombre::fea
