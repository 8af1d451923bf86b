// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "continuous/motion_input.hpp"
#include "geometry/error_model.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr int kMaxDegree = 7;

/// A Bézier curve in position and rotation vector at once.
struct Curve {
  std::array<ControlPose, kMaxDegree + 1> control;
  int degree = 0;
};

ControlPose mix(const ControlPose& a, const ControlPose& b, double u) {
  return {(1.0 - u) * a.position + u * b.position, (1.0 - u) * a.rotation + u * b.rotation};
}

/// De Casteljau. `left` and `right`, if given, become the parts before and after u.
ControlPose divide(Curve curve, double u, Curve* left, Curve* right) {
  const int n = curve.degree;
  if (left != nullptr) left->degree = n;
  if (right != nullptr) right->degree = n;
  for (int level = 0; level <= n; ++level) {
    if (left != nullptr) left->control[level] = curve.control[0];
    if (right != nullptr) right->control[n - level] = curve.control[n - level];
    for (int i = 0; i < n - level; ++i) {
      curve.control[i] = mix(curve.control[i], curve.control[i + 1], u);
    }
  }
  return curve.control[0];
}

/// Its derivative by the parameter; a point's is a point at zero.
Curve derivative(const Curve& curve) {
  Curve result;
  result.degree = std::max(0, curve.degree - 1);
  result.control[0] = {Vector3d::Zero(), Vector3d::Zero()};
  for (int i = 0; i < curve.degree; ++i) {
    result.control[i] = {
        curve.degree * (curve.control[i + 1].position - curve.control[i].position),
        curve.degree * (curve.control[i + 1].rotation - curve.control[i].rotation)};
  }
  return result;
}

/// NaN if either is: then there is no bound.
double larger(double a, double b) {
  return a > b || std::isnan(a) ? a : b;
}

/// The longest vectors of a curve's control polygon: no vector of the curve is longer.
struct Longest {
  double position = 0.0;
  double rotation = 0.0;
};
Longest longest(const Curve& curve) {
  Longest most;
  for (int i = 0; i <= curve.degree; ++i) {
    most.position = larger(most.position, curve.control[i].position.norm());
    most.rotation = larger(most.rotation, curve.control[i].rotation.norm());
  }
  return most;
}

/// Bound on the curve's vectors over [from, to] of its parameter, rounding included: each step of
/// de Casteljau's rounds by two ulps of the largest control vector.
Longest longestWithin(const Curve& curve, double from, double to) {
  const Longest whole = longest(curve);
  Curve part = curve;
  if (to < 1.0) divide(curve, to, &part, nullptr);
  if (from > 0.0) {
    const Curve before = part;
    divide(before, to > from ? from / to : 1.0, nullptr, &part);
  }
  const Longest found = longest(part);
  return {std::min(whole.position, found.position + detail::kCurveRounding * whole.position),
          std::min(whole.rotation, found.rotation + detail::kCurveRounding * whole.rotation)};
}

Matrix3d exponential(const Vector3d& turn) {
  return Eigen::AngleAxisd(turn.stableNorm(), turn.stableNormalized()).toRotationMatrix();
}

/// The left Jacobian of the rotation group applied to a vector: the angular velocity of
/// exp(rotation) if the rotation vector changes by `rate`.
Vector3d leftJacobian(const Vector3d& rotation, const Vector3d& rate) {
  const double squared = rotation.squaredNorm();
  const Vector3d once = rotation.cross(rate);
  const Vector3d twice = rotation.cross(once);
  if (squared < 1e-4) {
    // Taylor series; the terms left out are below 1e-16.
    const double first = 0.5 - squared / 24.0 + squared * squared / 720.0;
    const double second = 1.0 / 6.0 - squared / 120.0 + squared * squared / 5040.0;
    return rate + first * once + second * twice;
  }
  const double angle = std::sqrt(squared);
  const double sine = std::sin(0.5 * angle);
  return rate + (2.0 * sine * sine / squared) * once +
         ((angle - std::sin(angle)) / (squared * angle)) * twice;
}

/// `most` 0: any number.
void requireControl(std::span<const ControlPose> control, std::size_t least, std::size_t most) {
  if (control.size() < least || (most > 0 && control.size() > most)) {
    std::ostringstream what;
    what << "motion: " << control.size() << " control poses, where " << least;
    if (most > 0) {
      what << " to " << most;
    } else {
      what << " or more";
    }
    what << " are needed";
    throw std::invalid_argument(what.str());
  }
  for (std::size_t i = 0; i < control.size(); ++i) {
    const std::string which = "control pose " + std::to_string(i);
    detail::requireFinite(control[i].position, which + "'s position");
    detail::requireFinite(control[i].rotation, which + "'s rotation");
  }
}

struct Place {
  int span;
  double u;  ///< in [0, 1] for t in [0, 1]
};
Place placeOf(double t, int spans) {
  const double scaled = t * spans;
  const double last = spans - 1;
  const double span = scaled > 0.0 ? std::min(std::floor(scaled), last) : 0.0;
  return {static_cast<int>(span), scaled - span};
}

Curve curveOf(const std::vector<ControlPose>& control, int degree, int span) {
  Curve curve;
  curve.degree = degree;
  std::copy_n(control.begin() + static_cast<std::ptrdiff_t>(span) * (degree + 1), degree + 1,
              curve.control.begin());
  return curve;
}

}  // namespace

SplineMotion::SplineMotion(const Matrix3d& orientation, std::vector<ControlPose> control,
                           int degree)
    : Motion(Vector3d::Zero()),
      orientation_(orientation),
      control_(std::move(control)),
      degree_(degree),
      spans_(static_cast<int>(control_.size()) / (degree + 1)) {
  for (const ControlPose& pose : control_) {
    reach_ = std::max(reach_, pose.position.norm());
    turn_ = std::max(turn_, pose.rotation.norm());
  }
}

SplineMotion SplineMotion::bezier(const Matrix3d& orientation,
                                  std::span<const ControlPose> control) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, control] { return SplineMotion::bezier(orientation, control); });
  }
  requireControl(control, 2, kMaxDegree + 1);
  return {detail::checkedRotation(orientation, "orientation"),
          {control.begin(), control.end()},
          static_cast<int>(control.size()) - 1};
}

// Each span of the B-spline as a Bézier curve.
SplineMotion SplineMotion::uniformCubic(const Matrix3d& orientation,
                                        std::span<const ControlPose> control) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, control] { return SplineMotion::uniformCubic(orientation, control); });
  }
  requireControl(control, 4, 0);
  std::vector<ControlPose> pieces;
  for (std::size_t i = 0; i + 3 < control.size(); ++i) {
    const ControlPose &b = control[i + 1], &c = control[i + 2];
    const ControlPose afterB = mix(b, c, 1.0 / 3.0), beforeC = mix(b, c, 2.0 / 3.0);
    pieces.push_back(mix(mix(control[i], b, 2.0 / 3.0), afterB, 0.5));
    pieces.push_back(afterB);
    pieces.push_back(beforeC);
    pieces.push_back(mix(beforeC, mix(c, control[i + 3], 1.0 / 3.0), 0.5));
  }
  return {detail::checkedRotation(orientation, "orientation"), std::move(pieces), 3};
}

Isometry3d SplineMotion::at(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return SplineMotion::at(t); });
  }
  const Place place = placeOf(t, spans_);
  const ControlPose pose =
      divide(curveOf(control_, degree_, place.span), place.u, nullptr, nullptr);
  Isometry3d result;
  result.linear() = exponential(pose.rotation) * orientation_;
  result.translation() = pose.position;
  result.makeAffine();
  return result;
}

Twist SplineMotion::velocity(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return SplineMotion::velocity(t); });
  }
  const Place place = placeOf(t, spans_);
  const Curve curve = curveOf(control_, degree_, place.span);
  const ControlPose pose = divide(curve, place.u, nullptr, nullptr);
  const ControlPose rate = divide(derivative(curve), place.u, nullptr, nullptr);
  return {spans_ * rate.position, leftJacobian(pose.rotation, spans_ * rate.rotation)};
}

// Lemma: the angular velocity is J p', with p the rotation vector and J the mean of exp(s [p]) over
// s in [0, 1], so |J| <= 1. exp(s p) turns at most s |p'| when p changes by p', hence J' is at most
// |p'| / 2 long, and the angular acceleration J p'' + J' p' at most |p''| + |p'|^2 / 2.
MotionRates SplineMotion::rates(double from, double to) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to] { return SplineMotion::rates(from, to); });
  }
  // t times the number of spans rounds: an end may belong to either of two spans.
  const Place first = placeOf(from - 1e-14, spans_), last = placeOf(to + 1e-14, spans_);
  MotionRates most;
  double turnRate = 0.0, turnChange = 0.0;
  for (int span = first.span; span <= last.span; ++span) {
    const double begin = span == first.span ? std::clamp(first.u, 0.0, 1.0) : 0.0;
    const double end = span == last.span ? std::clamp(last.u, 0.0, 1.0) : 1.0;
    const Curve rate = derivative(curveOf(control_, degree_, span));
    const Longest speed = longestWithin(rate, begin, end);
    const Longest change = longestWithin(derivative(rate), begin, end);
    most.speed = larger(most.speed, speed.position);
    most.acceleration = larger(most.acceleration, change.position);
    turnRate = larger(turnRate, speed.rotation);
    turnChange = larger(turnChange, change.rotation);
  }
  const double scale = spans_ * (1.0 + 1e-12), squared = scale * scale;
  most.speed *= scale;
  most.acceleration *= squared;
  most.angularSpeed = scale * turnRate;
  most.angularAcceleration = squared * turnChange + 0.5 * most.angularSpeed * most.angularSpeed;
  return most;
}

// Lengths of control vectors bound those of the curve. Those of its derivative are at most 2 degree
// spans times as long, and round in proportion.
double SplineMotion::rounding(double reach) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, reach] { return SplineMotion::rounding(reach); });
  }
  const double perUnit = 2.0 * degree_ * spans_;
  return tolerance::kRoundingPerJoint * (1.0 + perUnit) * ((1.0 + turn_) * reach + reach_);
}

}  // namespace swept
