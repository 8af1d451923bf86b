// SPDX-License-Identifier: BSD-3-Clause
// Your own motion: a pendulum that swings by a sine, and the time when it hits a wall. Exits 0 if
// that agrees with the pendulum's angle.
#include <cmath>
#include <iostream>
#include <numbers>

#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"

using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

/// Rotates about y through the origin by `amplitude` sin(pi t).
class Pendulum : public swept::Motion {
 public:
  explicit Pendulum(double amplitude) : Motion(Vector3d::Zero()), amplitude_(amplitude) {}

  Eigen::Isometry3d at(double t) const override {
    return Eigen::Isometry3d(Eigen::AngleAxisd(amplitude_ * std::sin(kPi * t), Vector3d::UnitY()));
  }
  swept::Twist velocity(double t) const override {
    return {Vector3d::Zero(), amplitude_ * kPi * std::cos(kPi * t) * Vector3d::UnitY()};
  }
  /// The reference point, the hinge, stands still. The bounds for the whole motion hold for each
  /// part.
  swept::MotionRates rates(double /*from*/, double /*to*/) const override {
    const double fastest = std::abs(amplitude_) * kPi * (1.0 + 1e-15);
    return {0.0, 0.0, fastest, fastest * kPi * (1.0 + 1e-15)};
  }
  /// Sine, cosine and the rotation's entries are accurate to a few ulps each.
  double rounding(double reach) const override {
    return 1e-14 * (1.0 + std::abs(amplitude_) * kPi) * reach;
  }

 private:
  double amplitude_;  ///< rad
};

int main() {
  const Pendulum swing(1.2);
  const swept::AttachedFrame bob(swing, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -1.0)));
  const auto still = swept::UniformMotion::still(Eigen::Isometry3d::Identity());
  const auto found = swept::continuousCollide(swept::makeHalfSpace(Vector3d::UnitX(), -0.6), still,
                                              swept::makeSphere(0.1), bob, {.tolerance = 1e-6});

  // The bob's centre is at x = -sin(angle), and touches at -0.5.
  const double expected = std::asin(std::asin(0.5) / 1.2) / kPi;
  std::cout.precision(9);
  std::cout << toString(found.verdict) << ": proven free until " << found.freeUntil
            << ", in contact at " << found.contactBy << ", expected at " << expected << '\n';
  return found.verdict == swept::Verdict::Collision && found.freeUntil <= expected &&
                 found.contactBy >= expected && found.contactBy - found.freeUntil < 1e-6
             ? 0
             : 1;
}
