// SPDX-License-Identifier: BSD-3-Clause
#include "report/executed_part.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "output/quantile.hpp"
#include "report/executed_curves.hpp"
#include "swept/robot_model/limits.hpp"
#include "swept/robot_model/proven_trajectory.hpp"

namespace swept {
namespace {

/// rad or m. MoveIt's own, and smaller ones.
constexpr std::array kDeviations{0.1, 0.05, 0.01};

std::string whyNoCurves(const Robot& robot, const Group& group) {
  if (group.variables.size() == 1)
    return "Left out: group '" + group.name + "' has one variable, so no path has a corner.";
  for (const int index : group.variables) {
    const Variable& variable = robot.variables()[static_cast<std::size_t>(index)];
    if (isOrientation(robot, variable))
      return "Left out: the orientation of joint '" +
             robot.joints()[static_cast<std::size_t>(variable.joint)].name +
             "' turns by a slerp, which no polynomial follows.";
  }
  return {};
}

/// Those of the URDF. Where a limit is missing it is 1, as in MoveIt's time-optimal trajectory
/// generation. They decide how large proven blends are, and how long a trajectory takes.
RateLimits limitsOf(const Checker& checker) {
  RateLimits limits = RateLimits::of(checker.robot(), checker.group());
  for (std::vector<double>* rates : {&limits.velocity, &limits.acceleration})
    for (double& limit : *rates)
      if (std::isinf(limit)) limit = 1.0;
  return limits;
}

/// Whether no state along the curve, kStateStep apart, collides.
bool statesMiss(const Checker& checker, const PiecewisePolynomial& curve, Workspace& workspace) {
  constexpr int kFine = 20;  // looks for each state
  const double step = kStateStep / kFine;
  const auto looks = static_cast<int>(std::ceil(2.0 * curve.duration() / step));
  double passed = 0.0;
  Eigen::VectorXd last = curve.position(curve.begin());
  for (int i = 1; i <= looks; ++i) {
    const Eigen::VectorXd q = curve.position(curve.begin() + curve.duration() * i / looks);
    passed += (q - last).norm();
    last = q;
    if (passed < kStateStep && i < looks) continue;
    passed = 0.0;
    if (checker.checkState(q, workspace) == Verdict::Collision) return false;
  }
  return true;
}

/// What is executed of one path in one way.
struct ExecutedCurve {
  std::size_t checker;  ///< 0: the truth; else, one more than the tube's index
  PiecewisePolynomial curve;
};

/// In the order of the rows, without the proven blends.
std::vector<ExecutedCurve> curvesOf(const Eigen::MatrixXd& path) {
  std::vector<ExecutedCurve> curves{{.checker = 0, .curve = polyline(path)}};
  for (const double deviation : kDeviations)
    curves.push_back({.checker = 0, .curve = circularBlends(path, deviation)});
  curves.push_back({.checker = 0, .curve = cubicSpline(path)});
  for (std::size_t tube = 0; tube < kTubes.size(); ++tube)
    curves.push_back({.checker = tube + 1, .curve = polyline(path)});
  return curves;
}

void count(Verdict verdict, ExecutedRow& row) {
  ++(verdict == Verdict::Free        ? row.free
     : verdict == Verdict::Collision ? row.collisions
                                     : row.undecided);
}

struct Answer {
  Verdict verdict = Verdict::Undecided;
  double time = std::numeric_limits<double>::infinity();  ///< ns
};

/// Asks about all the curves of paths.
class CurveAsker {
 public:
  CurveAsker(const ReportCheckers& checkers, const std::vector<Eigen::MatrixXd>& paths)
      : truth_(*checkers.truth), limits_(limitsOf(truth_)) {
    checkers_.push_back(checkers.truth.get());
    for (const auto& tube : checkers.tubes) checkers_.push_back(tube.get());
    for (const Checker* checker : checkers_) workspaces_.emplace_back(*checker);
    for (const Eigen::MatrixXd& path : paths) {
      curves_.push_back(curvesOf(path));
      wayPoints_.emplace_back();
      for (const auto& point : path.colwise())
        wayPoints_.back().emplace_back(point.begin(), point.end());
    }
  }

  Verdict ask(std::size_t method, std::size_t path) {
    if (method == curves_[path].size())
      return provenTrajectory(truth_, wayPoints_[path], limits_).certificate.verdict;
    const auto& [checker, curve] = curves_[path][method];
    return checkers_[checker]
        ->certifyTrajectory(curve, workspaces_[checker], {.contact = MotionQuery::VerdictOnly})
        .verdict;
  }

  /// Whether states of a curve miss that it collides.
  bool isMissed(std::size_t method, std::size_t path) {
    return statesMiss(truth_, curves_[path][method].curve, workspaces_.front());
  }

 private:
  const Checker& truth_;
  RateLimits limits_;
  std::vector<const Checker*> checkers_;                     ///< see ExecutedCurve
  std::vector<Workspace> workspaces_;                        ///< of these
  std::vector<std::vector<ExecutedCurve>> curves_;           ///< of each path
  std::vector<std::vector<std::vector<double>>> wayPoints_;  ///< likewise
};

}  // namespace

ExecutedPart::ExecutedPart(const Robot& robot, const Group& group, int passes)
    : leftOut_(whyNoCurves(robot, group)), passes_(passes) {
  const auto add = [this](const char* curve, std::optional<double> setting, bool sampled) {
    ExecutedRow row;
    row.curve = curve;
    row.setting = setting;
    if (sampled) row.missed = 0;
    tallies_.push_back({.row = std::move(row), .times = {}});
  };
  add("polyline", {}, false);
  for (const double deviation : kDeviations) add("blends", deviation, true);
  add("spline", {}, true);
  for (const double tube : kTubes) add("tube", tube, false);
  add("proven blends", TimingOptions().blendDeviation, false);
}

void ExecutedPart::add(const ReportCheckers& checkers, const std::vector<Eigen::MatrixXd>& paths,
                       const Stopwatch& stopwatch, const ReportTick& tick) {
  paths_ += paths.size();
  for (const Eigen::MatrixXd& path : paths) corners_ += static_cast<std::size_t>(path.cols() - 2);
  CurveAsker asker(checkers, paths);
  std::vector<std::vector<Answer>> answers(tallies_.size(), std::vector<Answer>(paths.size()));
  const auto ask = [&](std::size_t method, std::size_t path) {
    Answer& answer = answers[method][path];
    const double taken = stopwatch.time([&] { answer.verdict = asker.ask(method, path); });
    answer.time = std::min(answer.time, taken);
  };
  inTurns(tallies_.size(), paths.size(), passes_, ask, tick);
  for (std::size_t method = 0; method < tallies_.size(); ++method) {
    Tally& tally = tallies_[method];
    for (std::size_t path = 0; path < paths.size(); ++path) {
      const Answer& answer = answers[method][path];
      count(answer.verdict, tally.row);
      tally.times.push_back(answer.time);
      if (tally.row.missed && answer.verdict == Verdict::Collision)
        *tally.row.missed += asker.isMissed(method, path) ? 1 : 0;
    }
  }
}

ExecutedPaths ExecutedPart::found() const {
  ExecutedPaths found{.paths = paths_, .corners = corners_, .leftOut = leftOut_, .rows = {}};
  if (!found.leftOut.empty()) return found;
  if (paths_ == 0) {
    found.leftOut =
        "Left out: between pairs of random free states, no path with a corner was found.";
    return found;
  }
  for (const Tally& tally : tallies_) {
    std::vector<double> times = tally.times;
    std::ranges::sort(times);
    ExecutedRow& row = found.rows.emplace_back(tally.row);
    row.mean = mean(times);
    row.median = quantile(times, 0.5);
    row.relativeTime = row.mean / found.rows.front().mean;
  }
  return found;
}

}  // namespace swept
