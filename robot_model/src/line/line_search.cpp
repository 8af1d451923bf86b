// SPDX-License-Identifier: BSD-3-Clause
#include "line/line_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "kinematics/rotation_vector.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;

// The first chord: 0.05 m or 0.2 rad of the tool.
constexpr double kFirstLength = 0.05;  // m
constexpr double kFirstTurn = 0.2;     // rad
/// Chords are made to deviate by this share of what is allowed: with more, proofs take many
/// intervals, with less there are more chords.
constexpr double kAim = 0.7;
constexpr double kGrowth = 3.0;
constexpr double kShrinkLeast = 0.1;
constexpr double kShrinkMost = 0.7;
// Inverse kinematics from a way point nearby.
constexpr double kSolvedTo = 1e-6;  // m, rad
constexpr int kMostSteps = 30;
constexpr double kDamping = 1e-6;

}  // namespace

StraightMotion::StraightMotion(const Isometry3d& from, const Isometry3d& to)
    : begin(from.translation()),
      way(to.translation() - from.translation()),
      orientation(from.linear()),
      turn(rotationVectorOf(to.linear() * from.linear().transpose())) {}

LinePiece StraightMotion::piece(double from, double to) const {
  const LinePiece whole{
      .begin = begin, .end = begin + way, .orientation = orientation, .turn = turn};
  return {.begin = begin + from * way,
          .end = begin + to * way,
          .orientation = whole.orientationAt(from),
          .turn = (to - from) * turn};
}

Isometry3d StraightMotion::at(double share) const {
  const LinePiece begun = piece(share, share);
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = begun.orientation;
  pose.translation() = begun.begin;
  return pose;
}

LineSearch::LineSearch(const LineModel& model, const StraightMotion& line,
                       const ToolLineOptions& options, Workspace& workspace, ToolLine& path)
    : model_(model),
      line_(line),
      options_(options),
      workspace_(workspace),
      path_(path),
      solverWorkspace_(model.solver),
      allowed_{options.position, options.angle} {
  constexpr double kShareOfAllowed = 0.01;
  const double infinity = std::numeric_limits<double>::infinity();
  solverOptions_ = {
      .positionTolerance = std::min(kSolvedTo, kShareOfAllowed * options.position),
      .orientationTolerance = options.angle >= std::numbers::pi
                                  ? infinity
                                  : std::min(kSolvedTo, kShareOfAllowed * options.angle),
      .maxIterations = kMostSteps,
      .firstDamping = kDamping};
  const double size = std::max(path.length, path.turn);
  leastStep_ = size > options.leastStep ? options.leastStep / size : 1.0;
  candidate_.resize(path.wayPoints.front().size());
  seed_.resize(candidate_.size());
}

void LineSearch::run() {
  follow();
  for (const Deviation& own : deviations_) {
    path_.position = std::max(path_.position, own.position);
    path_.angle = std::max(path_.angle, own.angle);
  }
  path_.share = last();
}

void LineSearch::follow() {
  double step = 1.0;
  if (path_.length > 0.0) step = std::min(step, kFirstLength / path_.length);
  if (path_.turn > 0.0) step = std::min(step, kFirstTurn / path_.turn);
  while (last() < 1.0) {
    if (static_cast<int>(path_.wayPoints.size()) >= options_.maxWayPoints ||
        options_.stop.stop_requested()) {
      path_.stop = ToolLineStop{.reason = ToolLineStop::Reason::Undecided, .share = last()};
      return;
    }
    step = stepFrom(step);
    const double target = step >= 1.0 - last() ? 1.0 : last() + step;
    const Outcome outcome = attempt(target);
    const double share = std::max(proof_.middle.shareOf(allowed_), 1e-6);
    switch (outcome) {
      case Outcome::Added:
        step *= std::clamp(std::sqrt(kAim / share), kShrinkMost, kGrowth);
        continue;
      case Outcome::NotFree:
        endBefore(certificate_, target);
        return;
      case Outcome::NotSolved:
        if (last() >= blocked_ || blocked_ > 1.0) blockedSince_ = path_.wayPoints.size() - 1;
        blocked_ = target;
        break;
      case Outcome::NotStraight:
        break;
    }
    if (step <= leastStep_) {
      const bool solved = outcome == Outcome::NotStraight;
      const bool anyOrientation = options_.angle >= std::numbers::pi;
      path_.stop = solved ? whyNotStraight(model_, lastWayPoint(), anyOrientation)
                          : whyNotSolved(model_, line_.at(target), candidate_, anyOrientation);
      path_.stop->share = last();
      takeJointStep(solved, step);
      joinEnd();
      return;
    }
    const double shorter = outcome == Outcome::NotSolved
                               ? 0.5
                               : std::clamp(std::sqrt(kAim / share), kShrinkLeast, kShrinkMost);
    step = std::max(shorter * step, leastStep_);
  }
}

/// The rest in equal parts, and no farther than half the way to where no solution was found.
double LineSearch::stepFrom(double wished) const {
  const double rest = 1.0 - last();
  if (last() < blocked_ && blocked_ <= 1.0)
    wished = std::min(wished, std::max(leastStep_, 0.5 * (blocked_ - last())));
  return rest / std::ceil(rest / wished);
}

void LineSearch::predict(double target) {
  const std::vector<double>& from = path_.wayPoints.back();
  const std::size_t count = path_.shares.size();
  if (candidateShare_ > last()) {
    const double part = (target - last()) / (candidateShare_ - last());
    interpolateMotion(model_.kinematics, from, candidate_, part, seed_);
  } else if (count > 1) {
    const double before = path_.shares[count - 2];
    const double beyond = (target - before) / (last() - before);
    interpolateMotion(model_.kinematics, path_.wayPoints[count - 2], from, beyond, seed_);
  } else {
    seed_ = from;
  }
}

LineSearch::Outcome LineSearch::attempt(double target) {
  predict(target);
  candidate_ = seed_;
  ++path_.solved;
  proof_ = {};
  if (!model_.solver.solve(line_.at(target), candidate_, solverOptions_, solverWorkspace_)) {
    candidateShare_ = -1.0;
    return Outcome::NotSolved;
  }
  candidateShare_ = target;
  proof_ = proveDeviation(model_.kinematics, model_.tool, line_.piece(last(), target),
                          lastWayPoint(), candidate_, allowed_, scratch_);
  if (!proof_.holds) return Outcome::NotStraight;
  certificate_ = model_.checker->certifyMotion(lastWayPoint(), candidate_, workspace_);
  if (certificate_.verdict != Verdict::Free) return Outcome::NotFree;
  path_.wayPoints.push_back(candidate_);
  path_.shares.push_back(target);
  deviations_.push_back(proof_.most);
  return Outcome::Added;
}

void LineSearch::endBefore(const MotionCertificate& found, double target) {
  const double begin = last();
  const double step = target - begin;
  const double free = found.freeUntil;
  const double contact = found.witness ? found.witness->t
                         : found.violation && found.verdict == Verdict::Violation
                             ? found.violation->t
                             : found.undecidedAt;
  ToolLineStop stop{.share = begin + contact * step};
  if (found.verdict == Verdict::Violation) {
    stop.reason = ToolLineStop::Reason::Violation;
    stop.violation = found.violation;
    stop.violation->t = stop.share;
  } else if (found.verdict == Verdict::Collision) {
    stop.reason = ToolLineStop::Reason::Contact;
    stop.contact = found.witness;
    stop.contact->t = stop.share;
  }
  // Of what is free on the chord, the tool is on the line again at the end: another chord.
  for (const double part : {1.0, 0.99, 0.95, 0.8, 0.5}) {
    if (part * free * step < leastStep_) break;
    if (attempt(begin + part * free * step) == Outcome::Added) break;
  }
  path_.stop = std::move(stop);
}

/// What was not solved for was approached by chords that are ever shorter: one in their place.
void LineSearch::joinEnd() {
  std::vector<std::vector<double>>& wayPoints = path_.wayPoints;
  const std::size_t end = wayPoints.size() - 1;
  for (std::size_t i = blockedSince_; i + 1 < end; ++i) {
    const DeviationProof straight = proveDeviation(
        model_.kinematics, model_.tool, line_.piece(path_.shares[i], path_.shares[end]),
        wayPoints[i], wayPoints[end], allowed_, scratch_);
    if (!straight.holds) continue;
    if (model_.checker->certifyMotion(wayPoints[i], wayPoints[end], workspace_).verdict !=
        Verdict::Free)
      continue;
    const auto drop = [&](auto& list, std::size_t from) {
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(from),
                 list.begin() + static_cast<std::ptrdiff_t>(from + end - 1 - i));
    };
    drop(wayPoints, i + 1);
    drop(path_.shares, i + 1);
    drop(deviations_, i + 1);
    deviations_.back() = straight.most;
    return;
  }
}

/// Of the chord that was not straight, or of the last one.
void LineSearch::takeJointStep(bool solved, double step) {
  const ToolLineStop::Reason reason = path_.stop->reason;
  if (reason != ToolLineStop::Reason::Singularity && reason != ToolLineStop::Reason::Jump) return;
  const std::size_t count = path_.shares.size();
  const double unit = path_.length > 0.0 ? path_.length : path_.turn;
  if (solved) {
    path_.stop->jointStep =
        largestChange(model_.kinematics, lastWayPoint(), candidate_) / (step * unit);
  } else if (count > 1) {
    path_.stop->jointStep =
        largestChange(model_.kinematics, path_.wayPoints[count - 2], lastWayPoint()) /
        ((last() - path_.shares[count - 2]) * unit);
  }
}

}  // namespace swept::detail
