// SPDX-License-Identifier: BSD-3-Clause
#include "truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trajectories {

namespace {

using Real = long double;

/// c[0] + c[1] t + ...
using Powers = std::array<Real, 6>;

Powers linear(Real p0, Real p1, Real T) {
  return {p0, (p1 - p0) / T};
}

Powers cubic(Real p0, Real v0, Real p1, Real v1, Real T) {
  return {p0, v0, (-3 * p0 + 3 * p1 - 2 * v0 * T - v1 * T) / (T * T),
          (2 * p0 - 2 * p1 + v0 * T + v1 * T) / (T * T * T)};
}

Powers quintic(Real p0, Real v0, Real a0, Real p1, Real v1, Real a1, Real T) {
  const Real T2 = T * T;
  const Real T3 = T2 * T;
  return {
      p0,
      v0,
      a0 / 2,
      (-20 * p0 + 20 * p1 - 3 * a0 * T2 + a1 * T2 - 12 * v0 * T - 8 * v1 * T) / (2 * T3),
      (30 * p0 - 30 * p1 + 3 * a0 * T2 - 2 * a1 * T2 + 16 * v0 * T + 14 * v1 * T) / (2 * T3 * T),
      (-12 * p0 + 12 * p1 - a0 * T2 + a1 * T2 - 6 * v0 * T - 6 * v1 * T) / (2 * T3 * T2)};
}

Real derivative(const Powers& c, Real t, int order) {
  Real sum = 0;
  for (int k = 5; k >= order; --k) {
    Real factor = 1;
    for (int i = 0; i < order; ++i) factor *= k - i;
    sum = sum * t + factor * c[static_cast<std::size_t>(k)];
  }
  return sum;
}

/// Per value, between two points.
std::vector<Powers> between(const swept::TrajectoryPoint& a, const swept::TrajectoryPoint& b) {
  const bool rates = !a.velocities.empty() && !b.velocities.empty();
  const bool both = rates && !a.accelerations.empty() && !b.accelerations.empty();
  const Real T = static_cast<Real>(b.time) - static_cast<Real>(a.time);
  std::vector<Powers> values;
  for (std::size_t i = 0; i < a.positions.size(); ++i)
    values.push_back(
        both    ? quintic(a.positions[i], a.velocities[i], a.accelerations[i], b.positions[i],
                          b.velocities[i], b.accelerations[i], T)
        : rates ? cubic(a.positions[i], a.velocities[i], b.positions[i], b.velocities[i], T)
                : linear(a.positions[i], b.positions[i], T));
  return values;
}

Real choose(int n, int k) {
  Real result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

/// Slerp of x, y, z, w (Shoemake 1985), the shorter way.
void slerp(const Eigen::MatrixXd& ends, Eigen::Index first, Real u, std::vector<double>& values) {
  std::array<Real, 4> a{}, b{};
  Real dot = 0, squaredA = 0, squaredB = 0;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    a[k] = ends(first + i, 0);
    b[k] = ends(first + i, 1);
    squaredA += a[k] * a[k];
    squaredB += b[k] * b[k];
    dot += a[k] * b[k];
  }
  const Real sign = dot < 0 ? -1 : 1;
  const Real angle = std::acos(std::min<Real>(1, std::abs(dot) / std::sqrt(squaredA * squaredB)));
  const bool turns = angle > 1e-9L;
  const Real shareA = turns ? std::sin((1 - u) * angle) / std::sin(angle) : 1 - u;
  const Real shareB = turns ? std::sin(u * angle) / std::sin(angle) : u;
  for (std::size_t i = 0; i < 4; ++i)
    values[static_cast<std::size_t>(first) + i] = static_cast<double>(
        shareA * a[i] / std::sqrt(squaredA) + sign * shareB * b[i] / std::sqrt(squaredB));
}

/// All of the degree's functions that are not zero between two knots, by Cox and de Boor.
std::vector<Real> basis(const std::vector<double>& knots, std::size_t span, std::size_t degree,
                        Real t) {
  std::vector<Real> own(degree + 1, 0);
  own[degree] = 1;
  for (std::size_t d = 1; d <= degree; ++d) {
    for (std::size_t k = degree - d; k <= degree; ++k) {
      // The function of the control point span - degree + k.
      const std::size_t i = span - degree + k;
      const Real low = knots[i], high = knots[i + d + 1];
      const Real first = knots[i + d], second = knots[i + 1];
      Real sum = 0;
      if (first > low) sum += (t - low) / (first - low) * own[k];
      if (k < degree && high > second) sum += (high - t) / (high - second) * own[k + 1];
      own[k] = sum;
    }
  }
  return own;
}

}  // namespace

std::size_t Truth::pieceAt(double t) const {
  const auto after = std::upper_bound(knots.begin() + 1, knots.end() - 1, t);
  return static_cast<std::size_t>(after - knots.begin()) - 1;
}

Truth truthOf(const swept::JointTrajectory& trajectory, const std::vector<double>& start) {
  std::vector<swept::TrajectoryPoint> points = trajectory.points;
  if (!start.empty() && points.front().time > 0.0) {
    swept::TrajectoryPoint rest{
        .time = 0.0, .positions = start, .velocities = {}, .accelerations = {}};
    rest.velocities.assign(points.front().velocities.size(), 0.0);
    rest.accelerations.assign(points.front().accelerations.size(), 0.0);
    points.insert(points.begin(), rest);
  }
  Truth truth;
  std::vector<std::vector<Powers>> pieces;
  for (std::size_t i = 0; i < points.size(); ++i) {
    truth.knots.push_back(points[i].time);
    if (i > 0) pieces.push_back(between(points[i - 1], points[i]));
  }
  truth.at = [pieces = std::move(pieces), knots = truth.knots](
                 std::size_t piece, double t, int order, std::vector<double>& values) {
    const Real since = static_cast<Real>(t) - static_cast<Real>(knots[piece]);
    values.clear();
    for (const Powers& value : pieces[piece])
      values.push_back(static_cast<double>(derivative(value, since, order)));
  };
  return truth;
}

Truth truthOf(std::vector<double> knots, std::vector<Eigen::MatrixXd> coefficients,
              std::vector<Eigen::Index> orientations) {
  Truth truth;
  truth.knots = knots;
  truth.at = [knots = std::move(knots), coefficients = std::move(coefficients),
              orientations = std::move(orientations)](std::size_t piece, double t, int order,
                                                      std::vector<double>& values) {
    const Eigen::MatrixXd& own = coefficients[piece];
    const Real begin = knots[piece];
    const Real length = static_cast<Real>(knots[piece + 1]) - begin;
    const Real u = (static_cast<Real>(t) - begin) / length;
    const auto degree = static_cast<int>(own.cols()) - 1;
    values.assign(static_cast<std::size_t>(own.rows()), 0.0);
    for (Eigen::Index i = 0; i < own.rows() && order <= degree; ++i) {
      std::vector<Real> b;
      for (Eigen::Index k = 0; k <= degree; ++k) b.push_back(own(i, k));
      for (int o = 0; o < order; ++o) {
        for (std::size_t k = 0; k + 1 < b.size(); ++k)
          b[k] = (b[k + 1] - b[k]) * static_cast<Real>(b.size() - 1) / length;
        b.pop_back();
      }
      const auto d = static_cast<int>(b.size()) - 1;
      // Powers of 1 - u come from the last term on, by Horner's scheme.
      Real sum = 0;
      Real power = 1;
      for (int k = 0; k <= d; ++k) {
        sum = sum * (1 - u) + choose(d, k) * power * b[static_cast<std::size_t>(k)];
        power *= u;
      }
      values[static_cast<std::size_t>(i)] = static_cast<double>(sum);
    }
    if (order == 0 && degree == 1)
      for (const Eigen::Index first : orientations) slerp(own, first, u, values);
  };
  return truth;
}

Truth truthOf(int degree, std::vector<double> knots, Eigen::MatrixXd controlPoints) {
  Truth truth;
  std::vector<std::size_t> spans;
  for (auto i = static_cast<std::size_t>(degree);
       i < static_cast<std::size_t>(controlPoints.cols()); ++i) {
    if (!(knots[i] < knots[i + 1])) continue;
    if (spans.empty()) truth.knots.push_back(knots[i]);
    truth.knots.push_back(knots[i + 1]);
    spans.push_back(i);
  }
  truth.at = [degree, knots = std::move(knots), controlPoints = std::move(controlPoints),
              spans = std::move(spans)](std::size_t piece, double t, int order,
                                        std::vector<double>& values) {
    values.assign(static_cast<std::size_t>(controlPoints.rows()), 0.0);
    if (order > degree) return;
    const std::size_t span = spans[piece];
    const auto d = static_cast<std::size_t>(degree - order);
    const std::vector<Real> shares = basis(knots, span, d, t);
    for (Eigen::Index i = 0; i < controlPoints.rows(); ++i) {
      std::vector<Real> points;
      const std::size_t first = span - static_cast<std::size_t>(degree);
      for (std::size_t k = 0; k <= static_cast<std::size_t>(degree); ++k)
        points.push_back(controlPoints(i, static_cast<Eigen::Index>(first + k)));
      for (int o = 0; o < order; ++o) {
        const auto left = static_cast<std::size_t>(degree - o);
        for (std::size_t k = 0; k < left; ++k) {
          const Real width = static_cast<Real>(knots[span + k + 1]) -
                             static_cast<Real>(knots[span + k + 1 - left]);
          points[k] = static_cast<Real>(left) * (points[k + 1] - points[k]) / width;
        }
        points.pop_back();
      }
      Real sum = 0;
      for (std::size_t k = 0; k <= d; ++k) sum += shares[k] * points[k];
      values[static_cast<std::size_t>(i)] = static_cast<double>(sum);
    }
  };
  return truth;
}

}  // namespace trajectories
