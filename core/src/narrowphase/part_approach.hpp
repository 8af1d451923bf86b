// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "bvh/wide_bvh.hpp"
#include "swept/core/separation.hpp"

namespace swept::detail {

/// How the motion of one part of a body, all of it within a box, differs from that of the centre of
/// the body's ball. In a's frame, over half an interval.
struct PartMotion {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();  ///< m, of the box's centre
  /// m. The box's half axes rotated by the spin: the ends of axis j add n . spread[j].
  std::array<Eigen::Vector3d, 3> spread{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                        Eigen::Vector3d::Zero()};
  double most = 0.0;      ///< m, no sum of +-spread[j] is longer
  double rounding = 0.0;  ///< m, of all of these
  ///@{
  /// m. The box's centre from the centre of the ball, and its half axes. Only if there are errors
  /// (ApproachBound::errors); else not set.
  Eigen::Vector3d offset;
  std::array<Eigen::Vector3d, 3> axes;
  ///@}
};

/// How far two parts can approach along a direction during the interval of an ApproachBound.
///
/// Lemma: a part's point at the middle m is p = c + sum t_j e_j with |t_j| <= 1, c the centre of
/// its box and e_j its half axes. Its velocity is v(p) = v(c) + sum t_j w x e_j, hence of two parts
///   |n . (v_B(p_B) - v_A(p_A))| <= |n . (v_B(c_B) - v_A(c_A))| + sum_j |n . (w_A x e_j)|
///                                  + sum_j |n . (w_B x f_j)|,
/// and what ApproachBound says of curvature holds for the points of the parts as for all others. An
/// error's displacement is e(p) = e(c) + sum t_j w x e_j in the same way, and adds what it has
/// along n; n . (w x e_j) = e_j . (n x w). The ball that grows a core does not turn: only points of
/// the core count.
class PartApproach {
 public:
  PartApproach(const ApproachBound& whole, const PartMotion& a, const PartMotion& b)
      : whole_(whole), a_(a), b_(b), linear_(whole.linear + (b.linear - a.linear)) {
    fixed_ = whole.curvature + a.rounding + b.rounding +
             tolerance::kSupportRounding * whole.linear.cwiseAbs().sum();
    double moved = linear_.norm() + a.most + b.most;
    if (!whole.errors.empty()) [[unlikely]]
      moved += errorsMost();
    most_ = whole.required + std::min(whole.travel, moved * (1.0 + 1e-14) + fixed_);
  }

  /// m. A separation of more than this along the unit vector n at m holds for the whole interval.
  double along(const Eigen::Vector3d& n) const {
    return whole_.required + std::min(whole_.travel, std::abs(n.dot(linear_)) + spreadAlong(n));
  }
  /// m. Upper bound on how much a separation along n at m shrinks until the interval's end, and has
  /// shrunk since its beginning: the parts do not approach both before and after.
  struct Loss {
    double before;
    double after;
  };
  Loss lossAlong(const Eigen::Vector3d& n) const {
    const double receding = n.dot(linear_), spread = spreadAlong(n);
    // For an unbounded body that turns, neither is finite, and only the travel counts.
    const auto lost = [&](double approach) {
      return approach <= 0.0 ? 0.0 : std::min(whole_.travel, approach);
    };
    return {lost(receding + spread), lost(spread - receding)};
  }
  /// m, >= along(n) for every n.
  double most() const { return most_; }

 private:
  double spreadAlong(const Eigen::Vector3d& n) const {
    double sum = fixed_;
    for (const Eigen::Vector3d& k : a_.spread) sum += std::abs(n.dot(k));
    for (const Eigen::Vector3d& k : b_.spread) sum += std::abs(n.dot(k));
    if (!whole_.errors.empty()) [[unlikely]]
      sum += errorsAlong(n);
    return sum;
  }

  ///@{
  /// m. What the errors add to spreadAlong(), to `fixed_`, and to the sum that `most_` is made of.
  /// Not inlined: most bodies have none.
  double errorsAlong(const Eigen::Vector3d& n) const;
  double errorsMost();
  ///@}

  const ApproachBound& whole_;
  const PartMotion& a_;
  const PartMotion& b_;
  Eigen::Vector3d linear_;  ///< m
  double fixed_ = 0.0;      ///< m
  double most_ = 0.0;       ///< m
};

/// The motions of the parts of two bodies.
class PartMotions {
 public:
  PartMotions(const ApproachBound& whole, const Eigen::Isometry3d& a_from_b)
      : whole_(whole),
        a_from_b_(a_from_b),
        spinInB_(a_from_b.linear().transpose() * whole.spinB),
        turnsA_(!whole.spinA.isZero(0.0)),
        turnsB_(!whole.spinB.isZero(0.0)),
        offset_(a_from_b.translation().cwiseAbs().sum()) {
    for (const ApproachError& error : whole.errors) {
      errorsA_ += error.spinA.cwiseAbs().sum();
      errorsB_ += error.spinB.cwiseAbs().sum();
    }
  }

  /// `box` in the side's own frame.
  PartMotion of(bool ofA, const OrientedBox& box) const;
  /// Bound for the whole body, by its ball.
  PartMotion ofBall(bool ofA) const;

 private:
  [[gnu::noinline]] void place(bool ofA, const OrientedBox& box, PartMotion& part) const;

  const ApproachBound& whole_;
  const Eigen::Isometry3d& a_from_b_;
  Eigen::Vector3d spinInB_;  ///< rad, b's frame
  bool turnsA_;
  bool turnsB_;
  double offset_;         ///< m
  double errorsA_ = 0.0;  ///< rad, sums of the errors' components
  double errorsB_ = 0.0;  ///< rad
};

}  // namespace swept::detail
