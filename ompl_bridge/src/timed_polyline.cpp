// SPDX-License-Identifier: BSD-3-Clause
#include "timed_polyline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace swept::detail {

namespace {

constexpr double kPerSecond = 1e9;  // nanoseconds
/// s. On a shorter straight piece, the rounding of positions would change the velocity by more than
/// controllerTrajectory() takes for rounding.
constexpr double kLeastStraight = 1e-5;

/// s, the nearest number of whole nanoseconds.
double whole(double time) {
  return std::round(time * kPerSecond) / kPerSecond;
}

/// s, no less than the time.
double wholeAbove(double time) {
  return std::ceil(time * kPerSecond) / kPerSecond;
}

/// Builds a curve piece by piece.
class CurveBuilder {
 public:
  explicit CurveBuilder(double begin) : knots_{begin} {}

  void add(double until, Eigen::MatrixXd piece) {
    knots_.push_back(until);
    pieces_.push_back(std::move(piece));
  }
  double end() const { return knots_.back(); }
  bool empty() const { return pieces_.empty(); }
  PiecewisePolynomial curve() && { return {std::move(knots_), std::move(pieces_)}; }

 private:
  std::vector<double> knots_;
  std::vector<Eigen::MatrixXd> pieces_;
};

}  // namespace

double RateBounds::restToRest(const Eigen::VectorXd& way) const {
  const double byVelocity = (way.array().abs() / velocity).maxCoeff();
  const double byAcceleration = (way.array().abs() / acceleration).maxCoeff();
  if (byVelocity == 0.0) return 0.0;
  // The share of the way that is reached grows with this velocity and acceleration at most.
  return byVelocity * byVelocity > byAcceleration ? byVelocity + byAcceleration / byVelocity
                                                  : 2.0 * std::sqrt(byAcceleration);
}

std::vector<TimedKnot> restToRest(const TimedKnot& from, const TimedKnot& to,
                                  const RateBounds& bounds) {
  const Eigen::VectorXd way = to.q - from.q;
  const double duration = to.time - from.time;
  const double perAcceleration = (way.array().abs() / bounds.acceleration).maxCoeff();
  if (perAcceleration == 0.0) return {from};
  // It speeds up for a time r, so that the share of the way at constant speed is 1 = a r (d - r).
  const double root = std::sqrt(std::max(0.0, duration * duration - 4.0 * perAcceleration));
  const double half = 0.25 * (duration - root);
  return {{from.q, from.time + half}, {to.q, to.time - half}};
}

std::optional<PiecewisePolynomial> blended(std::span<const TimedKnot> knots, double begin,
                                           const RateBounds& bounds) {
  CurveBuilder curve(whole(begin));
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(knots.front().q.size());
  Eigen::VectorXd before = rest;
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const double time = whole(knots[k].time);
    const Eigen::VectorXd& q = knots[k].q;
    Eigen::VectorXd after = rest;
    if (k + 1 < knots.size()) {
      const double duration = whole(knots[k + 1].time) - time;
      if (!(duration > 0.0)) return std::nullopt;
      after = (knots[k + 1].q - q) / duration;
      if ((after.array().abs() > bounds.velocity).any()) return std::nullopt;
    }
    const double half = wholeAbove(0.5 * bounds.change(before, after));
    const double from = whole(time - half), to = whole(time + half);
    if (from != curve.end()) {
      if (!(from - curve.end() >= kLeastStraight)) return std::nullopt;
      Eigen::MatrixXd straight(q.size(), 2);
      straight << q + (curve.end() - time) * before, q - half * before;
      curve.add(from, std::move(straight));
    }
    if (half > 0.0) {
      Eigen::MatrixXd blend(q.size(), 3);
      blend << q - half * before, q, q + half * after;
      curve.add(to, std::move(blend));
    }
    before = after;
  }
  if (curve.empty()) return std::nullopt;
  return std::move(curve).curve();
}

Eigen::VectorXd positionAt(std::span<const TimedKnot> knots, double time) {
  const auto next = std::ranges::upper_bound(knots, time, {}, &TimedKnot::time);
  if (next == knots.begin()) return knots.front().q;
  if (next == knots.end()) return knots.back().q;
  const TimedKnot& last = *std::prev(next);
  return last.q + (time - last.time) / (next->time - last.time) * (next->q - last.q);
}

}  // namespace swept::detail
