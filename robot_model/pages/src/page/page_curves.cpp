// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_curves.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "trajectory/bernstein.hpp"

namespace swept {

namespace {

/// Of the duration. Parts do not begin this close to a knot, but at it.
constexpr double kNearKnot = 1e-9;

/// Where the orientation of a floating joint begins in a configuration of the group.
std::optional<Eigen::Index> orientationOf(const Robot& robot, const Group& group, int joint) {
  const Joint& moved = robot.joints()[static_cast<std::size_t>(joint)];
  if (moved.type != JointType::Floating) return std::nullopt;
  const auto found = std::ranges::find(group.variables, moved.firstVariable);
  return found - group.variables.begin() + 3;
}

/// A piece between two shares of it, if its degree is above 1.
Eigen::MatrixXd restricted(const Eigen::MatrixXd& piece, double begin, double end) {
  const auto count = static_cast<std::size_t>(piece.cols());
  Eigen::MatrixXd part(piece.rows(), piece.cols());
  for (Eigen::Index i = 0; i < piece.rows(); ++i) {
    detail::Bernstein whole{}, first{}, rest{};
    for (std::size_t k = 0; k < count; ++k) whole[k] = piece(i, static_cast<Eigen::Index>(k));
    const auto of = [count](detail::Bernstein& all) { return std::span(all).first(count); };
    if (end < 1.0) {
      detail::divide(of(whole), end, of(first), of(rest));
      whole = first;
    }
    if (begin > 0.0) {
      detail::divide(of(whole), begin / end, of(first), of(rest));
      whole = rest;
    }
    for (std::size_t k = 0; k < count; ++k) part(i, static_cast<Eigen::Index>(k)) = whole[k];
  }
  return part;
}

/// Where parts begin and end.
std::vector<double> partTimes(const PiecewisePolynomial& curve, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) {
    const double time = timeAt(curve, i, count);
    const auto nearest = std::ranges::min_element(
        curve.knots(), {}, [time](double knot) { return std::abs(knot - time); });
    const bool isKnot = std::abs(*nearest - time) <= kNearKnot * curve.duration();
    times.push_back(isKnot ? *nearest : time);
  }
  return times;
}

void takeLeast(const TrajectoryClearance& own, TrajectoryClearance& all) {
  const double lower = std::min(all.lower, own.lower);
  if (own.upper < all.upper) all = own;
  all.lower = lower;
}

}  // namespace

double timeAt(const PiecewisePolynomial& curve, int index, int count) {
  return index == count ? curve.end()
                        : curve.begin() + curve.duration() * (static_cast<double>(index) / count);
}

Eigen::VectorXd configurationAt(const Robot& robot, const Group& group,
                                const PiecewisePolynomial& curve, double time) {
  Eigen::VectorXd q = curve.position(time);
  const std::size_t piece = curve.pieceAt(time);
  if (curve.degree(piece) > 1) return q;
  const Eigen::MatrixXd& ends = curve.coefficients(piece);
  const double begin = curve.knots()[piece];
  const double share = std::clamp((time - begin) / (curve.knots()[piece + 1] - begin), 0.0, 1.0);
  for (const int joint : group.joints) {
    const auto at = orientationOf(robot, group, joint);
    if (!at) continue;
    const Eigen::Quaterniond first(Eigen::Vector4d(ends.col(0).segment<4>(*at)));
    const Eigen::Quaterniond second(Eigen::Vector4d(ends.col(1).segment<4>(*at)));
    q.segment<4>(*at) = first.normalized().slerp(share, second.normalized()).coeffs();
  }
  return q;
}

PiecewisePolynomial partOf(const Robot& robot, const Group& group, const PiecewisePolynomial& curve,
                           double begin, double end) {
  std::vector<double> knots{begin};
  std::vector<Eigen::MatrixXd> pieces;
  for (std::size_t i = curve.pieceAt(begin); i < curve.pieces() && curve.knots()[i] < end; ++i) {
    const double first = curve.knots()[i], last = curve.knots()[i + 1];
    const double from = std::max(begin, first), to = std::min(end, last);
    const Eigen::MatrixXd& whole = curve.coefficients(i);
    const auto shareOf = [&](double time) { return (time - first) / (last - first); };
    if (whole.cols() > 2 || (from == first && to == last)) {
      pieces.push_back(restricted(whole, shareOf(from), to == last ? 1.0 : shareOf(to)));
    } else {
      Eigen::MatrixXd& part = pieces.emplace_back(whole);
      if (from > first) part.col(0) = configurationAt(robot, group, curve, from);
      if (to < last) part.col(1) = configurationAt(robot, group, curve, to);
    }
    knots.push_back(to);
  }
  return {std::move(knots), std::move(pieces)};
}

CurvePieces piecesOf(const Checker& checker, const PiecewisePolynomial& curve, double clock,
                     int count) {
  Workspace workspace(checker);
  CurvePieces all;
  const std::vector<double> times = partTimes(curve, count);
  const TrajectoryQuery query{
      .contact = MotionQuery::VerdictOnly, .clock = clock, .clearances = true};
  for (std::size_t i = 1; i < times.size(); ++i) {
    const PiecewisePolynomial part =
        partOf(checker.robot(), checker.group(), curve, times[i - 1], times[i]);
    const TrajectoryCertificate found = checker.certifyTrajectory(part, workspace, query);
    takeLeast(*found.world, all.world);
    takeLeast(*found.self, all.self);
    PagePiece& piece = all.pieces.emplace_back();
    piece.verdict = found.verdict;
    piece.effort = found.effort;
    if (piece.verdict == Verdict::Collision) continue;
    piece.lowerWorld = found.world->lower;
    piece.lowerSelf = found.self->lower;
    piece.lower = std::min(piece.lowerWorld, piece.lowerSelf);
    piece.upper = std::min(found.world->upper, found.self->upper);
  }
  for (TrajectoryClearance* least : {&all.world, &all.self})
    least->piece = curve.pieceAt(least->time);
  return all;
}

int piecesPerTrajectory(std::size_t trajectories) {
  constexpr int kMost = 96, kLeast = 8, kInAll = 960;
  return std::clamp(kInAll / std::max(1, static_cast<int>(trajectories)), kLeast, kMost);
}

}  // namespace swept
