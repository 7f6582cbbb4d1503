// Draws polar diagrams of a stiffness.
#include <algorithm>
#include <array>

#include "base/math/math.h"
#include "base/math/round_numbers.h"
#include "fea/solve/homogenise.h"
#include "formats/containers/svg_picture.h"

namespace ombre::fea {
namespace {

constexpr double radius = 100, gap = 40, top = 50;  // pixels
constexpr int directions = 180, rings = 4;
constexpr const char* thin = "fill=\"none\" stroke=\"#999\" stroke-width=\".5\"";
constexpr const char* filled = "fill=\"#3b6fb6\" fill-opacity=\".3\" stroke=\"#3b6fb6\" stroke-width=\"1.5\"";

struct ChartPlane {
  const char* name;
  int first, second;  // axes to the right and upwards
};
constexpr std::array<ChartPlane, 3> planes{{{"xy", 0, 1}, {"yz", 1, 2}, {"zx", 2, 0}}};

struct Reach {
  double right, up;  // the direction in the plane
  double modulus;    // MPa
};

std::vector<Reach> reaches_of(const Stiffness& stiffness, const ChartPlane& plane) {
  std::vector<Reach> reaches;
  for (int n = 0; n < directions; ++n) {
    const double angle = 360.0 * n / directions * math::degree;
    Vec3 d;
    d[plane.first] = math::cos(angle);
    d[plane.second] = math::sin(angle);
    reaches.push_back({math::cos(angle), math::sin(angle), modulus_along(stiffness, d)});
  }
  return reaches;
}

void draw_plane(formats::SvgPicture& picture, const std::vector<Reach>& reaches, const ChartPlane& plane, double x,
                double most) {
  constexpr double y = top + radius;
  for (int n = 1; n <= rings; ++n) picture.circle(x, y, radius * n / rings, thin);
  picture.line(x - radius, y, x + radius, y, thin);
  picture.line(x, y - radius, x, y + radius, thin);
  formats::SvgPath path;
  for (const Reach& reach : reaches) {
    const double length = reach.modulus / most * radius;
    path.to(x + length * reach.right, y - length * reach.up);
  }
  picture.path(path.closed(), filled);
  constexpr std::string_view axes = "xyz";
  picture.words(x + radius + 4, y + 4, "start", axes.substr(static_cast<size_t>(plane.first), 1));
  picture.words(x, y - radius - 4, "middle", axes.substr(static_cast<size_t>(plane.second), 1));
  picture.words(x, y + radius + 18, "middle", std::string("plane ") + plane.name);
}

}  // namespace

std::string stiffness_chart(const Stiffness& stiffness, const std::string& title) {
  std::array<std::vector<Reach>, planes.size()> reaches;
  double greatest = 0;
  for (size_t n = 0; n < planes.size(); ++n) {
    reaches[n] = reaches_of(stiffness, planes[n]);
    greatest = std::max(greatest, std::ranges::max(reaches[n], {}, &Reach::modulus).modulus);
  }
  const double step = greatest > 0 ? math::least_round(greatest / rings) : 1;
  constexpr double width = 3 * (2 * radius + gap) + gap, height = top + 2 * radius + 60;
  formats::SvgPicture picture(width, height);
  picture.words(width / 2, 20, "middle", title);
  for (size_t n = 0; n < planes.size(); ++n)
    draw_plane(picture, reaches[n], planes[n], gap + radius + static_cast<double>(n) * (2 * radius + gap),
               step * rings);
  picture.words(width / 2, height - 12, "middle",
                "Young's modulus by direction; rings every " + format_rounded(step, 3) + " MPa");
  return picture.svg();
}

}  // namespace ombre::fea
