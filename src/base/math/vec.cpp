#include "base/math/vec.h"

#include <algorithm>
#include <numbers>

#include "base/math/math.h"

namespace ombre {
namespace {

// Multiples of 90 degrees give exact zeros and ones, so that turned boxes stay aligned with the axes.
struct CosSin {
  double cos, sin;
};

CosSin cos_sin_degrees(double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  if (turn == 0) return {1, 0};
  if (turn == 90) return {0, 1};
  if (turn == -90) return {0, -1};
  if (std::abs(turn) == 180) return {-1, 0};
  const double radians = turn * std::numbers::pi / 180;
  return {math::cos(radians), math::sin(radians)};
}

// Computes the eigenvalues of a symmetric 3x3 matrix by Jacobi rotations.
Vec3 symmetric_eigenvalues(std::array<std::array<double, 3>, 3> m) {
  for (int sweep = 0; sweep < 32; ++sweep) {
    if (std::abs(m[0][1]) + std::abs(m[0][2]) + std::abs(m[1][2]) == 0) break;
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (m[p][q] == 0) continue;
        const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const double t = (theta >= 0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double kp = m[k][p], kq = m[k][q];
          m[k][p] = c * kp - s * kq;
          m[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 3; ++k) {
          const double pk = m[p][k], qk = m[q][k];
          m[p][k] = c * pk - s * qk;
          m[q][k] = s * pk + c * qk;
        }
      }
    }
  }
  return {m[0][0], m[1][1], m[2][2]};
}

}  // namespace

Affine Affine::rotation(Vec3 axis, double degrees) {
  // Divides by the greatest component first, so that an axis along x, y or z gets a length of exactly one.
  const double size = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
  const Vec3 along{axis.x / size, axis.y / size, axis.z / size};
  const Vec3 n = (1 / ombre::length(along)) * along;
  const auto [c, s] = cos_sin_degrees(degrees);
  const double k = 1 - c;
  return {{Vec3{c + k * n.x * n.x, k * n.x * n.y - s * n.z, k * n.x * n.z + s * n.y},
           Vec3{k * n.x * n.y + s * n.z, c + k * n.y * n.y, k * n.y * n.z - s * n.x},
           Vec3{k * n.x * n.z - s * n.y, k * n.y * n.z + s * n.x, c + k * n.z * n.z}},
          {}};
}

Affine operator*(const Affine& c_from_b, const Affine& b_from_a) {
  Affine result;
  for (int row = 0; row < 3; ++row) {
    const Vec3& r = c_from_b.rows[row];
    result.rows[row] = r.x * b_from_a.rows[0] + r.y * b_from_a.rows[1] + r.z * b_from_a.rows[2];
  }
  result.offset = c_from_b(b_from_a.offset);
  return result;
}

double determinant(const Affine& map) { return dot(map.rows[0], cross(map.rows[1], map.rows[2])); }

Affine inverse(const Affine& map) {
  // Scales the entries by a power of two to about one, since the determinant of tiny entries underflows.
  double greatest = 0;
  for (const Vec3& row : map.rows) greatest = std::max({greatest, std::abs(row.x), std::abs(row.y), std::abs(row.z)});
  const double unit = std::ldexp(1.0, -std::ilogb(greatest));
  const Affine near_one{{unit * map.rows[0], unit * map.rows[1], unit * map.rows[2]}, {}};
  const double scale = unit / determinant(near_one);
  // The columns of the inverse are cross products of the rows.
  const Vec3 a = scale * cross(near_one.rows[1], near_one.rows[2]);
  const Vec3 b = scale * cross(near_one.rows[2], near_one.rows[0]);
  const Vec3 c = scale * cross(near_one.rows[0], near_one.rows[1]);
  Affine result{{Vec3{a.x, b.x, c.x}, Vec3{a.y, b.y, c.y}, Vec3{a.z, b.z, c.z}}, {}};
  result.offset = -result.linear(map.offset);
  return result;
}

bool mixes_axes(const Affine& map) {
  return std::ranges::any_of(map.rows, [](const Vec3& row) { return (row.x != 0) + (row.y != 0) + (row.z != 0) > 1; });
}

Stretch stretch(const Affine& map) {
  std::array<std::array<double, 3>, 3> gram{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) gram[i][j] += map.rows[k][i] * map.rows[k][j];
  const Vec3 squares = symmetric_eigenvalues(gram);
  return {std::sqrt(std::max(0.0, std::min({squares.x, squares.y, squares.z}))),
          std::sqrt(std::max({squares.x, squares.y, squares.z}))};
}

}  // namespace ombre
