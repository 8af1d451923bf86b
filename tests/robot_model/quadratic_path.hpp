// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "kinematics/joint_path.hpp"

namespace swept::test {

/// Values that are quadratic in t between knots and have continuous rates: of turning, prismatic
/// and planar joints.
class QuadraticPath final : public detail::JointPath {
 public:
  /// `rates`: per unit of t, at knots that are evenly spaced over [0, 1]; [knot][value].
  QuadraticPath(const detail::KinematicModel& model, std::vector<double> from,
                std::vector<std::vector<double>> rates)
      : model_(model), rates_(std::move(rates)), values_{std::move(from)} {
    for (std::size_t k = 0; k + 1 < rates_.size(); ++k) {
      values_.push_back(values_[k]);
      for (std::size_t i = 0; i < values_[k].size(); ++i)
        values_.back()[i] += 0.5 * width() * (rates_[k][i] + rates_[k + 1][i]);
    }
  }

  bool linearize(double t, double half, std::span<detail::JointMotion> joints) const override {
    for (std::size_t i = 1; i < joints.size(); ++i)
      if (!linearize(model_.bodies[i], t, half, joints[i])) return false;
    return true;
  }

  void interpolate(double t, std::span<double> q) const override {
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = around(i, t, 0.0).value;
  }

 private:
  struct Scalar {
    double value, rate, low, high, speed, acceleration;
  };

  double width() const { return 1.0 / static_cast<double>(rates_.size() - 1); }

  /// Value and rate at t, and bounds over [t - half, t + half].
  Scalar around(std::size_t i, double t, double half) const {
    const auto pieceOf = [&](double at) {
      const auto piece = static_cast<std::size_t>(std::max(0.0, at / width()));
      return std::min(piece, rates_.size() - 2);
    };
    const auto accelerationOf = [&](std::size_t k) {
      return (rates_[k + 1][i] - rates_[k][i]) / width();
    };
    const std::size_t k = pieceOf(t);
    const double since = t - static_cast<double>(k) * width();
    Scalar at{};
    at.rate = rates_[k][i] + since * accelerationOf(k);
    at.value = values_[k][i] + 0.5 * since * (rates_[k][i] + at.rate);
    for (std::size_t j = pieceOf(t - half); j <= pieceOf(t + half); ++j)
      at.acceleration = std::max(at.acceleration, std::abs(accelerationOf(j)));
    at.speed = std::abs(at.rate) + half * at.acceleration;
    at.low = at.value - half * at.speed;
    at.high = at.value + half * at.speed;
    return at;
  }

  bool linearize(const detail::MovingBody& body, double t, double half,
                 detail::JointMotion& joint) const {
    joint = {};
    joint.anchor = t;
    const auto first = static_cast<std::size_t>(body.variable);
    const Scalar own = around(first, t, half);
    const double factor = std::abs(body.multiplier);
    const double value = body.multiplier * own.value + body.offset;
    const double reach = factor * half * own.speed;
    if (detail::turns(body.type)) {
      turn(value, body.multiplier * own.rate, factor, own, body.axis, joint);
      joint.lowAngle = value - reach;
      joint.highAngle = value + reach;
    } else if (body.type == JointType::Prismatic) {
      joint.translation = value * body.axis;
      joint.rate = body.multiplier * own.rate * body.axis;
      joint.speed = factor * own.speed;
      joint.acceleration = factor * own.acceleration;
      joint.low = value - reach;
      joint.high = value + reach;
      return joint.low >= body.lower && joint.high <= body.upper;
    } else {
      const Scalar y = around(first + 1, t, half);
      const Scalar angle = around(first + 2, t, half);
      joint.translation = body.planarBasis * Eigen::Vector3d(own.value, y.value, 0.0);
      joint.rate = body.planarBasis * Eigen::Vector3d(own.rate, y.rate, 0.0);
      joint.speed = own.speed + y.speed;
      joint.acceleration = own.acceleration + y.acceleration;
      joint.maxTranslation = joint.translation.norm() + half * joint.speed;
      turn(angle.value, angle.rate, 1.0, angle, body.planarBasis.col(2), joint);
    }
    return true;
  }

  static void turn(double value, double rate, double factor, const Scalar& own,
                   const Eigen::Vector3d& axis, detail::JointMotion& joint) {
    joint.angle = value;
    joint.angleRate = rate;
    joint.spin = rate * axis;
    joint.spinSpeed = factor * own.speed;
    joint.spinAcceleration = factor * own.acceleration;
    joint.largestAngle = std::abs(value) + joint.spinSpeed;
  }

  const detail::KinematicModel& model_;
  std::vector<std::vector<double>> rates_, values_;
};

}  // namespace swept::test
