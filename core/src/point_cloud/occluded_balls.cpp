// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "geometry/point_text.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/sensed_space.hpp"

namespace swept {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostBalls = 10'000'000;

void require(double value, const char* what) {
  if (value > 0.0 && std::isfinite(value)) return;
  std::ostringstream message;
  message << what << " of the occluded space is " << value << "; allowed: finite and above zero";
  throw std::invalid_argument(message.str());
}

void requireFinite(const Vector3d& p, const std::string& what) {
  if (p.allFinite()) return;
  std::ostringstream message;
  message << what << " of the occluded space is " << detail::pointText(p)
          << "; allowed: finite coordinates";
  throw std::invalid_argument(message.str());
}

/// Checks that this many balls, and those along another ray from a share exp(-length) of the range
/// on, are at most as many as allowed.
void requireFew(std::size_t balls, double length, double factor, double radius, double range) {
  const double more = factor > 1.0 ? length / std::log(factor) : HUGE_VAL;
  if (static_cast<double>(balls) + more <= static_cast<double>(kMostBalls)) return;
  std::ostringstream message;
  message << "the occluded space of points of radius " << radius << " up to a range of " << range
          << " takes more than " << kMostBalls << " balls; a larger radius takes fewer";
  throw std::invalid_argument(message.str());
}

/// Lemma: a point hidden by a ball at the distance d is in the cone around it, of tangent
/// t = r / sqrt(d^2 - r^2), at least d - r^2 / d along the axis. At s along the axis, within a
/// share `step` of it, the cone's points are within s sqrt(step^2 + ((1 + step) t)^2) of the point
/// of the axis at s. Successive s, a factor of (1 + step) / (1 - step) apart, leave no gap.
void addShadow(const Vector3d& away, double radius, const Vector3d& sensor, double range,
               Balls& balls) {
  constexpr double kStep = 0.75;  // of the tangent: balls reach 1.3 times as far as the cone
  constexpr double kMostStep = 0.5;
  constexpr double kRounding = 1.0 + 1e-12;
  const double d = away.norm();
  if (!(d > radius) || !(d < range)) return;
  const double tangent = radius / std::sqrt((d - radius) * (d + radius));
  const double step = std::min(kStep * tangent, kMostStep);
  const double reach = kRounding * std::hypot(step, (1.0 + step) * tangent);
  const double first = (d - radius * (radius / d)) / (1.0 - step);
  const double factor = (1.0 + step) / (1.0 - step) / kRounding;
  requireFew(balls.radii.size(), std::log(range / (first * (1.0 - step))), factor, radius, range);
  for (double s = first; s * (1.0 - step) < range; s *= factor) {
    balls.centers.push_back(sensor + (s / d) * away);
    balls.radii.push_back(s * reach);
  }
}

}  // namespace

Balls occludedBalls(std::span<const Vector3d> points, double radius, const Vector3d& sensor,
                    double range) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, points, radius, range] { return occludedBalls(points, radius, sensor, range); });
  }
  require(radius, "radius");
  require(range, "range");
  requireFinite(sensor, "sensor");
  Balls balls;
  for (std::size_t i = 0; i < points.size(); ++i) {
    requireFinite(points[i], "point " + std::to_string(i));
    addShadow(points[i] - sensor, radius, sensor, range, balls);
  }
  return balls;
}

}  // namespace swept
