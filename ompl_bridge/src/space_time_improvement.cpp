// SPDX-License-Identifier: BSD-3-Clause
#include "space_time_improvement.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <utility>

#include "swept/core/verdict.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/schedule.hpp"

namespace swept::detail {

namespace {

/// s of arrival that a s of motion at full speed is worth.
constexpr double kLengthWeight = 0.1;
/// s of arrival that a s of changing the velocity is worth.
constexpr double kChangeWeight = 0.1;

using Knots = std::vector<TimedKnot>;

class Improvement {
 public:
  Improvement(const ScheduleChecker& checker, const OwnSpace& space, Knots knots,
              const ImprovementLimits& limits, unsigned seed)
      : checker_(checker),
        bounds_(space.bounds),
        limits_(limits),
        workspace_(checker.checker()),
        random_(seed),
        knots_(std::move(knots)) {
    // What is executed has other pieces than the edges of the search.
    const std::optional<PiecewisePolynomial> curve = blended(knots_, limits.begin, bounds_);
    if (curve && isProven(*curve)) cost_ = costOf(knots_, *curve);
  }

  Knots run(const std::function<bool()>& stop) {
    for (int i = 0; i < limits_.attempts && knots_.size() > 1 && !stop(); ++i) {
      switch (random_() % 4) {
        case 0:
          tryWith(withoutSome());
          break;
        case 1:
          tryWith(withShortcut());
          break;
        case 2:
          tryWith(earlierFrom(1 + index(knots_.size() - 1)));
          break;
        default:
          tryWith(earlierFrom(0));
          break;
      }
    }
    return std::move(knots_);
  }

 private:
  double uniform() { return static_cast<double>(random_()) * 0x1p-32; }
  std::size_t index(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(uniform() * static_cast<double>(count)));
  }

  /// Of what a controller makes of a curve.
  bool isProven(const PiecewisePolynomial& curve) {
    const auto trajectory = controllerTrajectory(curve, checker_.variables());
    return trajectory &&
           checker_.certify(controllerCurve(*trajectory), workspace_, MotionQuery::VerdictOnly)
                   .verdict == Verdict::Free;
  }

  double costOf(const Knots& knots, const PiecewisePolynomial& curve) const {
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(knots.front().q.size());
    double length = 0.0, changes = 0.0;
    Eigen::VectorXd before = rest;
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      const Eigen::VectorXd way = knots[k + 1].q - knots[k].q;
      const Eigen::VectorXd after = way / (knots[k + 1].time - knots[k].time);
      length += (way.array().abs() / bounds_.velocity).maxCoeff();
      changes += bounds_.change(before, after);
      before = after;
    }
    changes += bounds_.change(before, rest);
    return curve.end() + kLengthWeight * length + kChangeWeight * changes;
  }

  void tryWith(Knots candidate) {
    if (candidate.back().time < limits_.restFrom) return;
    const std::optional<PiecewisePolynomial> curve = blended(candidate, limits_.begin, bounds_);
    if (!curve) return;
    const double cost = costOf(candidate, *curve);
    if (!(cost < cost_) || !isProven(*curve)) return;
    knots_ = std::move(candidate);
    cost_ = cost;
  }

  /// Without the knots between two.
  Knots withoutSome() {
    const std::size_t first = index(knots_.size());
    const std::size_t last = std::min(knots_.size() - 1, first + 2 + index(3));
    Knots candidate(knots_.begin(), knots_.begin() + static_cast<std::ptrdiff_t>(first) + 1);
    candidate.insert(candidate.end(), knots_.begin() + static_cast<std::ptrdiff_t>(last),
                     knots_.end());
    if (first == last) candidate.pop_back();
    return candidate;
  }

  /// Straight from one time to another, which may become earlier, with all after it.
  Knots withShortcut() {
    const double begin = knots_.front().time, length = knots_.back().time - begin;
    double from = begin + uniform() * length, to = begin + uniform() * length;
    if (from > to) std::swap(from, to);
    const double gain = random_() % 2 == 0 ? 0.0 : uniform() * (to - from);
    Knots candidate;
    for (const TimedKnot& knot : knots_)
      if (knot.time < from) candidate.push_back(knot);
    candidate.push_back({positionAt(knots_, from), from});
    candidate.push_back({positionAt(knots_, to), to - gain});
    for (const TimedKnot& knot : knots_)
      if (knot.time > to) candidate.push_back({knot.q, knot.time - gain});
    return candidate;
  }

  /// All from one knot on earlier; from the first one on, or all faster.
  Knots earlierFrom(std::size_t first) {
    Knots candidate = knots_;
    if (first == 0 && random_() % 2 == 0) {
      const double scale = 1.0 - 0.5 * uniform() * uniform();
      for (TimedKnot& knot : candidate)
        knot.time = limits_.begin + scale * (knot.time - limits_.begin);
      return candidate;
    }
    const double before = first == 0 ? limits_.begin : knots_[first - 1].time;
    const double gain = uniform() * (knots_[first].time - before);
    for (std::size_t k = first; k < candidate.size(); ++k) candidate[k].time -= gain;
    return candidate;
  }

  const ScheduleChecker& checker_;
  const RateBounds& bounds_;
  const ImprovementLimits limits_;
  Workspace workspace_;
  std::mt19937 random_;
  Knots knots_;
  double cost_ = std::numeric_limits<double>::infinity();  ///< s; not proven: infinity
};

}  // namespace

std::vector<TimedKnot> improved(const ScheduleChecker& checker, const OwnSpace& space,
                                std::vector<TimedKnot> knots, const ImprovementLimits& limits,
                                unsigned seed, const std::function<bool()>& stop) {
  return Improvement(checker, space, std::move(knots), limits, seed).run(stop);
}

}  // namespace swept::detail
