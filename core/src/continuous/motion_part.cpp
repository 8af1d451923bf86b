// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>
#include <stdexcept>

#include "swept/core/continuous/motions.hpp"

#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace {

void requireWithin(double from, double to) {
  if (0.0 <= from && from <= to && to <= 1.0) return;
  std::ostringstream what;
  what << "motion: the part [" << from << ", " << to << "] is not within [0, 1]";
  throw std::invalid_argument(what.str());
}

}  // namespace

MotionPart::MotionPart(const Motion& whole, double from, double to)
    : Motion(whole.reference()),
      whole_(whole),
      from_(from),
      length_(inDefaultEnvironment([&] { return to - from; })) {
  inDefaultEnvironment([&] { requireWithin(from, to); });
}

Eigen::Isometry3d MotionPart::at(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return MotionPart::at(t); });
  }
  return whole_.at(from_ + t * length_);
}

Twist MotionPart::velocity(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return MotionPart::velocity(t); });
  }
  const Twist whole = whole_.velocity(from_ + t * length_);
  return {length_ * whole.linear, length_ * whole.angular};
}

MotionState MotionPart::state(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return MotionPart::state(t); });
  }
  const MotionState whole = whole_.state(from_ + t * length_);
  return {whole.pose, {length_ * whole.twist.linear, length_ * whole.twist.angular}};
}

MotionRates MotionPart::rates(double from, double to) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to] { return MotionPart::rates(from, to); });
  }
  const MotionRates whole = whole_.rates(from_ + from * length_, from_ + to * length_);
  const double squared = length_ * length_;
  return {length_ * whole.speed, squared * whole.acceleration, length_ * whole.angularSpeed,
          squared * whole.angularAcceleration};
}

// The whole's t is rounded by an ulp of 1, in addition to the whole's own rounding.
double MotionPart::rounding(double reach) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, reach] { return MotionPart::rounding(reach); });
  }
  const MotionRates rates = whole_.rates(0.0, 1.0);
  const double arm = reach + reference().norm();
  const double speed = rates.speed + rates.angularSpeed * arm;
  const double acceleration =
      rates.acceleration +
      (rates.angularAcceleration + rates.angularSpeed * rates.angularSpeed) * arm;
  return whole_.rounding(reach) + 4e-16 * (speed + acceleration);
}

}  // namespace swept
