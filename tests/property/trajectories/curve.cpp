// SPDX-License-Identifier: BSD-3-Clause
#include "curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "pivot.hpp"

namespace trajectories {

namespace {

using swept::JointType;
using State = std::vector<double>;

constexpr double kFastest = 4.0;  // rad/s or m/s
/// Of the range of a value that slides, at either end: it stays out of this.
constexpr double kRim = 0.03;

/// Makes one curve around a configuration.
class Maker {
 public:
  Maker(const Stage& stage, const State& pivot, double seconds, Random& random)
      : stage_(stage), random_(random), pivot_(pivot) {
    const auto pieces =
        static_cast<std::size_t>(std::floor(random_.decades(0.0, std::log10(41.0))));
    const double scale = random_.decades(-3.0, 1.0);
    const bool alike = random_.chance(0.6);
    for (std::size_t i = 0; i < pieces; ++i)
      lengths_.push_back(std::clamp(
          alike ? scale * random_.decades(-0.4, 0.4) : random_.decades(-3.0, 1.0), 1e-3, 10.0));
    const double all = std::accumulate(lengths_.begin(), lengths_.end(), 0.0);
    if (all > seconds)
      for (double& length : lengths_) length = std::max(1e-3, length * seconds / all);
    swing_ = random_.decades(-2.5, -0.1);
    held_ = random_.chance(0.2);
    walk();
  }

  RandomCurve ofPoints(Kind kind) {
    swept::JointTrajectory trajectory;
    const swept::Group& group = stage_.checker.group();
    for (const int variable : group.variables)
      trajectory.variables.push_back(
          stage_.checker.robot().variables()[static_cast<std::size_t>(variable)].name);
    const bool started = random_.chance(0.3);
    double time = started               ? lengths_.front()
                  : random_.chance(0.3) ? random_.uniform(0.0, 3.0)
                                        : 0.0;
    for (std::size_t i = started ? 1 : 0; i < states_.size(); ++i) {
      swept::TrajectoryPoint point;
      point.time = time;
      point.positions = states_[i];
      const bool rates = kind == Kind::Mixed ? random_.chance(0.8) : kind != Kind::Linear;
      const bool both = kind == Kind::Mixed ? random_.chance(0.7) : kind == Kind::Quintic;
      const double before = i > 0 ? lengths_[i - 1] : 0.0;
      const double longest = std::max(before, i < lengths_.size() ? lengths_[i] : 0.0);
      for (std::size_t k = 0; k < stage_.values(); ++k) {
        const double room = roomOf(i, k);
        const double rate = std::min(kFastest, room / longest) * random_.uniform(-1.0, 1.0);
        if (rates) point.velocities.push_back(rate);
        if (both)
          point.accelerations.push_back(3.0 * room / (longest * longest) *
                                        random_.uniform(-1.0, 1.0));
      }
      trajectory.points.push_back(std::move(point));
      if (i < lengths_.size()) time += lengths_[i];
    }
    const State start = started ? states_.front() : State{};
    return {kind, swept::controllerCurve(trajectory, start), truthOf(trajectory, start)};
  }

  RandomCurve ofPieces() {
    std::vector<double> knots{random_.chance(0.5) ? 0.0 : random_.uniform(-3.0, 3.0)};
    std::vector<Eigen::MatrixXd> coefficients;
    const int common = random_.chance(0.5) ? 1 + random_.below(7) : 0;
    const bool smooth = random_.chance(0.7);
    for (std::size_t i = 0; i < lengths_.size(); ++i) {
      int degree = common > 0 ? common : 1 + random_.below(7);
      if (floats() && !held_) degree = 1;
      const double length = lengths_[i];
      Eigen::MatrixXd piece(static_cast<Eigen::Index>(stage_.values()), degree + 1);
      for (std::size_t k = 0; k < stage_.values(); ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        const double step = std::min(swing_, kFastest * length / degree);
        for (int c = 0; c <= degree; ++c) {
          const double share = static_cast<double>(c) / degree;
          const double line = states_[i][k] + share * (states_[i + 1][k] - states_[i][k]);
          const bool end = c == 0 || c == degree;
          piece(row, c) = end ? line : kept(k, line + step * random_.uniform(-0.7, 0.7));
        }
        piece(row, degree) = states_[i + 1][k];
        if (isOrientation(k)) piece.row(row).setConstant(states_[i][k]);
        if (isOrientation(k) && degree == 1) piece(row, 1) = states_[i + 1][k];
        // The rate at its begin is that at the end of the piece before.
        if (!smooth || i == 0 || degree < 2 || isOrientation(k)) continue;
        const Eigen::MatrixXd& last = coefficients.back();
        const Eigen::Index lastDegree = last.cols() - 1;
        const double rate = static_cast<double>(lastDegree) *
                            (last(row, lastDegree) - last(row, lastDegree - 1)) / lengths_[i - 1];
        const double to = piece(row, 0) + rate * length / degree;
        if (std::abs(to - piece(row, 0)) < 3.0 * swing_ && to == kept(k, to)) piece(row, 1) = to;
      }
      coefficients.push_back(std::move(piece));
      knots.push_back(knots.back() + length);
    }
    // Of the same lengths as the knots are apart.
    Truth truth = truthOf(knots, coefficients, orientations());
    return {Kind::Pieces, {std::move(knots), std::move(coefficients)}, std::move(truth)};
  }

  RandomCurve ofSpline() {
    const int degree = 1 + random_.below(7);
    const auto points = static_cast<std::size_t>(degree) + lengths_.size();
    Eigen::MatrixXd control(static_cast<Eigen::Index>(stage_.values()),
                            static_cast<Eigen::Index>(points));
    for (std::size_t i = 0; i < points; ++i) {
      const State& from = states_[std::min(i, states_.size() - 1)];
      for (std::size_t k = 0; k < stage_.values(); ++k)
        control(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
            isOrientation(k) ? states_.front()[k]
                             : kept(k, from[k] + 0.1 * swing_ * random_.uniform(-1.0, 1.0));
    }
    const bool clamped = random_.chance(0.6);
    std::vector<double> knots{random_.chance(0.5) ? 0.0 : random_.uniform(-3.0, 3.0)};
    const std::size_t count = points + static_cast<std::size_t>(degree) + 1;
    while (knots.size() < count) {
      const bool inside = knots.size() > static_cast<std::size_t>(degree) && knots.size() <= points;
      const double step = lengths_[knots.size() % lengths_.size()];
      const bool repeats =
          inside ? degree > 2 && lengths_.size() > 1 && knots.size() % 5 == 0 : clamped;
      knots.push_back(knots.back() + (repeats ? 0.0 : step));
    }
    Truth truth = truthOf(degree, knots, control);
    return {Kind::Spline, swept::PiecewisePolynomial::bSpline(degree, knots, control),
            std::move(truth)};
  }

  bool floats() const {
    return std::ranges::any_of(
        stage_.joints, [](const StageJoint& joint) { return joint.type == JointType::Floating; });
  }

 private:
  bool isOrientation(std::size_t k) const { return stage_.variables[k].orientation; }

  std::vector<Eigen::Index> orientations() const {
    std::vector<Eigen::Index> firsts;
    for (const StageJoint& joint : stage_.joints)
      if (joint.type == JointType::Floating)
        firsts.push_back(static_cast<Eigen::Index>(joint.first) + 3);
    return firsts;
  }

  /// Within the limits of a value that slides; others may pass theirs a little.
  double kept(std::size_t k, double value) const {
    const StageVariable& variable = stage_.variables[k];
    if (variable.slides) {
      const double rim = kRim * (variable.upper - variable.lower);
      return std::clamp(value, variable.lower + rim, variable.upper - rim);
    }
    return std::clamp(value, variable.lower - 0.1, variable.upper + 0.1);
  }

  /// rad or m. How far a value may go beside a point of the walk.
  double roomOf(std::size_t i, std::size_t k) const {
    const StageVariable& variable = stage_.variables[k];
    if (!variable.slides) return swing_;
    return 0.9 * std::min({swing_, states_[i][k] - variable.lower, variable.upper - states_[i][k]});
  }

  /// From the pivot, somewhere on the way, to both ends.
  void walk() {
    const std::size_t points = lengths_.size() + 1;
    states_.assign(points, pivot_);
    const auto pivot = static_cast<std::size_t>(random_.below(points));
    for (std::size_t i = pivot + 1; i < points; ++i)
      step(states_[i - 1], lengths_[i - 1], states_[i]);
    for (std::size_t i = pivot; i-- > 0;) step(states_[i + 1], lengths_[i], states_[i]);
  }

  void step(const State& from, double length, State& to) {
    const double most = std::min(swing_, 0.6 * kFastest * length);
    for (std::size_t k = 0; k < stage_.values(); ++k) {
      const double scale =
          stage_.variables[k].slides
              ? std::min(most, 0.3 * (stage_.variables[k].upper - stage_.variables[k].lower))
              : most;
      to[k] = from[k];
      if (isOrientation(k) && held_) continue;
      to[k] = kept(k, from[k] + scale * random_.uniform(-1.0, 1.0));
    }
    for (const StageJoint& joint : stage_.joints)
      if (joint.type == JointType::Floating && !held_)
        Eigen::Map<Eigen::Vector4d>(to.data() + joint.first + 3).normalize();
  }

  const Stage& stage_;
  Random& random_;
  const State& pivot_;
  std::vector<double> lengths_;  ///< s
  double swing_ = 0.0;           ///< rad or m
  bool held_ = false;            ///< orientations do not change
  std::vector<State> states_;
};

}  // namespace

RandomCurve makeCurve(const Stage& stage, swept::Workspace& workspace,
                      swept::Workspace& plainWorkspace, Random& random, double seconds) {
  const State pivot = makePivot(stage, workspace, plainWorkspace, random);
  Maker maker(stage, pivot, seconds, random);
  // Controllers know no floating joints.
  const auto kind = static_cast<Kind>(maker.floats() ? 4 + random.below(2) : random.below(6));
  switch (kind) {
    case Kind::Linear:
    case Kind::Cubic:
    case Kind::Quintic:
    case Kind::Mixed:
      return maker.ofPoints(kind);
    case Kind::Pieces:
      return maker.ofPieces();
    case Kind::Spline:
      break;
  }
  return maker.ofSpline();
}

}  // namespace trajectories
