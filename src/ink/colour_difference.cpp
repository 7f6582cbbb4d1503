#include "ink/colour_difference.h"

#include "base/math/srgb.h"

namespace ombre::ink {
namespace {

constexpr double full_turn = 360;

double degrees_of(double y, double x) {
  if (x == 0 && y == 0) return 0;
  const double angle = math::atan2(y, x) / math::degree;
  return angle < 0 ? angle + full_turn : angle;
}

double sine(double degrees) { return math::sin(degrees * math::degree); }
double cosine(double degrees) { return math::cos(degrees * math::degree); }

// Returns v^7 / (v^7 + 25^7).
double share_of_seventh(double v) {
  const double power = math::pow(v, 7), reference = math::pow(25, 7);
  return power / (power + reference);
}

// Chroma and hue of a colour, whose a* is stretched near gray.
struct Polar {
  double chroma = 0, hue = 0;  // hue in degrees, from 0 to 360
  Polar(const Lab& lab, double stretch)
      : chroma(length(Vec3{stretch * lab.y, lab.z, 0})), hue(degrees_of(lab.z, stretch * lab.y)) {}
  bool is_gray() const { return chroma == 0; }
};

double hue_difference(const Polar& a, const Polar& b) {
  if (a.is_gray() || b.is_gray()) return 0;
  const double difference = b.hue - a.hue;
  if (difference > full_turn / 2) return difference - full_turn;
  return difference < -full_turn / 2 ? difference + full_turn : difference;
}

double mean_hue(const Polar& a, const Polar& b) {
  const double sum = a.hue + b.hue;
  if (a.is_gray() || b.is_gray()) return sum;
  if (math::abs(a.hue - b.hue) <= full_turn / 2) return sum / 2;
  return sum < full_turn ? (sum + full_turn) / 2 : (sum - full_turn) / 2;
}

constexpr double end_of_line = 6.0 / 29;  // where the curve of L*a*b* becomes a straight line

double lab_curve(double t) {
  return t <= end_of_line * end_of_line * end_of_line ? t / (3 * end_of_line * end_of_line) + 4.0 / 29
                                                      : math::pow(t, 1.0 / 3);
}
double inverse_curve(double f) { return f <= end_of_line ? 3 * end_of_line * end_of_line * (f - 4.0 / 29) : f * f * f; }

}  // namespace

Lab lab_of_srgb(const Vec3& srgb) {
  // XYZ relative to the white of D50, from the primaries of sRGB. Rows add up to 1.
  constexpr double rows[3][3] = {{0.4360747 / 0.96422, 0.3850649 / 0.96422, 0.1430804 / 0.96422},
                                 {0.2225045, 0.7168786, 0.0606169},
                                 {0.0139322 / 0.82521, 0.0971045 / 0.82521, 0.7141733 / 0.82521}};
  const Vec3 light{linear_of_srgb(srgb.x), linear_of_srgb(srgb.y), linear_of_srgb(srgb.z)};
  Vec3 xyz;
  for (int n = 0; n < 3; ++n) xyz[n] = rows[n][0] * light.x + rows[n][1] * light.y + rows[n][2] * light.z;
  return lab_of_xyz(xyz);
}

Vec3 xyz_of_lab(const Lab& lab) {
  const double y = (lab.x + 16) / 116;
  return {inverse_curve(y + lab.y / 500), inverse_curve(y), inverse_curve(y - lab.z / 200)};
}

Lab lab_of_xyz(const Vec3& xyz) {
  const double x = lab_curve(xyz.x), y = lab_curve(xyz.y), z = lab_curve(xyz.z);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double ciede2000(const Lab& a, const Lab& b) {
  const double mean_plain = (length(Vec3{a.y, a.z, 0}) + length(Vec3{b.y, b.z, 0})) / 2;
  const double stretch = 1 + 0.5 * (1 - math::sqrt(share_of_seventh(mean_plain)));
  const Polar p(a, stretch), q(b, stretch);
  const double lightness = b.x - a.x, chroma = q.chroma - p.chroma;
  const double hue = 2 * math::sqrt(p.chroma * q.chroma) * sine(hue_difference(p, q) / 2);

  // The weights depend on the mean colour.
  const double mean_chroma = (p.chroma + q.chroma) / 2, h = mean_hue(p, q);
  const double from_middle = math::square((a.x + b.x) / 2 - 50);
  const double t =
      1 - 0.17 * cosine(h - 30) + 0.24 * cosine(2 * h) + 0.32 * cosine(3 * h + 6) - 0.20 * cosine(4 * h - 63);
  const double of_lightness = lightness / (1 + 0.015 * from_middle / math::sqrt(20 + from_middle));
  const double of_chroma = chroma / (1 + 0.045 * mean_chroma), of_hue = hue / (1 + 0.015 * mean_chroma * t);
  // Blue colours turn: their chroma and hue count together.
  const double turn = 30 * math::exp(-math::square((h - 275) / 25));
  const double together = -sine(2 * turn) * 2 * math::sqrt(share_of_seventh(mean_chroma));
  return math::sqrt(math::max(
      0, math::square(of_lightness) + math::square(of_chroma) + math::square(of_hue) + together * of_chroma * of_hue));
}

}  // namespace ombre::ink
