// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "page/page_pieces.hpp"
#include "swept/robot_model/checker.hpp"

/// Curves in time, as a page shows them.
namespace swept {

/// The time (s) of a frame, or of the begin of a part, of `count`; that of frame `count` is the
/// end.
double timeAt(const PiecewisePolynomial& curve, int index, int count);

/// The group's values (rad, m) at a time (s), as the checker takes them: orientations follow slerp
/// along pieces of degree 1.
Eigen::VectorXd configurationAt(const Robot& robot, const Group& group,
                                const PiecewisePolynomial& curve, double time);

/// The curve between two times (s), with their own knots. Rounding of coefficients is all that it
/// differs by.
PiecewisePolynomial partOf(const Robot& robot, const Group& group, const PiecewisePolynomial& curve,
                           double begin, double end);

/// The equal parts of a curve, and what they say together.
struct CurvePieces {
  std::vector<PagePiece> pieces;
  TrajectoryClearance world, self;
};

/// Each part begins exactly where the one before it ends. `clock`: s, TrajectoryQuery::clock.
CurvePieces piecesOf(const Checker& checker, const PiecewisePolynomial& curve, double clock,
                     int count);

/// How many parts of each trajectory are certified by themselves, for this many trajectories.
int piecesPerTrajectory(std::size_t trajectories);

}  // namespace swept
