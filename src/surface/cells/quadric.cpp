#include "surface/cells/quadric.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace ombre::surface {
namespace {

// Least eigenvalue, as a share of the greatest, that counts as a constraint; smaller ones are noise and curvature.
// Planes that meet at about 10 degrees have 0.01.
constexpr double least_share = 0.01;

}  // namespace

void Quadric::add(Vec3 at, Vec3 n) {
  const double d = dot(n, at);
  xx_ += n.x * n.x;
  xy_ += n.x * n.y;
  xz_ += n.x * n.z;
  yy_ += n.y * n.y;
  yz_ += n.y * n.z;
  zz_ += n.z * n.z;
  linear_ = linear_ + d * n;
  constant_ += d * d;
  sum_ = sum_ + at;
  count_ += 1;
}

void Quadric::add(const Quadric& o) {
  xx_ += o.xx_;
  xy_ += o.xy_;
  xz_ += o.xz_;
  yy_ += o.yy_;
  yz_ += o.yz_;
  zz_ += o.zz_;
  linear_ = linear_ + o.linear_;
  constant_ += o.constant_;
  sum_ = sum_ + o.sum_;
  count_ += o.count_;
}

double Quadric::at(Vec3 p) const {
  const Vec3 image{xx_ * p.x + xy_ * p.y + xz_ * p.z, xy_ * p.x + yy_ * p.y + yz_ * p.z,
                   xz_ * p.x + yz_ * p.y + zz_ * p.z};
  return dot(p, image) - 2 * dot(p, linear_) + constant_;
}

Quadric::Least Quadric::least() const {
  Eigen::Matrix3d a;
  a << xx_, xy_, xz_, xy_, yy_, yz_, xz_, yz_, zz_;
  const Vec3 m = mean();
  const Eigen::Vector3d middle(m.x, m.y, m.z), linear(linear_.x, linear_.y, linear_.z);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(a);
  const Eigen::Vector3d& values = solver.eigenvalues();
  const Eigen::Vector3d rest = solver.eigenvectors().transpose() * (linear - a * middle);
  Eigen::Vector3d step = Eigen::Vector3d::Zero();
  for (int n = 0; n < 3; ++n)
    if (values[n] > least_share * values[2]) step += rest[n] / values[n] * solver.eigenvectors().col(n);
  const Vec3 best = m + Vec3{step[0], step[1], step[2]};
  return {best, std::sqrt(std::max(0.0, at(best)) / count_)};
}

}  // namespace ombre::surface
