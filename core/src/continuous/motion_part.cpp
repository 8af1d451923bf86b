// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>
#include <stdexcept>

#include "swept/core/continuous/motions.hpp"

namespace swept {

MotionPart::MotionPart(const Motion& whole, double from, double to)
    : Motion(whole.reference()), whole_(whole), from_(from), length_(to - from) {
  if (0.0 <= from && from <= to && to <= 1.0) return;
  std::ostringstream what;
  what << "motion: the part [" << from << ", " << to << "] is not within [0, 1]";
  throw std::invalid_argument(what.str());
}

Eigen::Isometry3d MotionPart::at(double t) const {
  return whole_.at(from_ + t * length_);
}

Twist MotionPart::velocity(double t) const {
  const Twist whole = whole_.velocity(from_ + t * length_);
  return {length_ * whole.linear, length_ * whole.angular};
}

MotionState MotionPart::state(double t) const {
  const MotionState whole = whole_.state(from_ + t * length_);
  return {whole.pose, {length_ * whole.twist.linear, length_ * whole.twist.angular}};
}

MotionRates MotionPart::rates(double from, double to) const {
  const MotionRates whole = whole_.rates(from_ + from * length_, from_ + to * length_);
  const double squared = length_ * length_;
  return {length_ * whole.speed, squared * whole.acceleration, length_ * whole.angularSpeed,
          squared * whole.angularAcceleration};
}

// The whole's t is rounded by an ulp of 1 before the whole rounds what it makes of it.
double MotionPart::rounding(double reach) const {
  const MotionRates rates = whole_.rates(0.0, 1.0);
  const double arm = reach + reference().norm();
  const double speed = rates.speed + rates.angularSpeed * arm;
  const double acceleration =
      rates.acceleration +
      (rates.angularAcceleration + rates.angularSpeed * rates.angularSpeed) * arm;
  return whole_.rounding(reach) + 4e-16 * (speed + acceleration);
}

}  // namespace swept
