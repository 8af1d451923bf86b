// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "acm/link_chain.hpp"

namespace swept::detail {

/// Bounds how much nearer two points can come, within a box of joint values, than in its middle.
///
/// Lemma. Let the joints between two bodies A and B be numbered from A to B, joint j within e_j of
/// the middle of its range (rad or m). Fix a point a of A and b of B, and let the middle mean all
/// joints in the middle of their ranges, where w_j is the axis of joint j, o_j a point on it.
/// 1. One joint. Let joint j alone leave the middle, by t, and carry a point x along. Where it
///    turns, with p the part of x - o_j across w_j and r_j = |p|, x moves by
///      d_j = sin(t) w_j x p - (1 - cos t) p,
///    no farther than c_j r_j, c_j = min(e_j, 2): an arc is no shorter than its chord, a chord no
///    longer than the diameter. Where it slides, d_j = t w_j; let r_j be 1 there, and c_j = e_j.
/// 2. One direction. Let C be a body of the chain and n a unit vector in the middle. In C's frame
///    |ab| >= n . (b - a), in which b depends on the joints after C only and a on those before. Let
///    x be either, and 1, ..., m the joints from C towards it. With the first j of them at their
///    values and the others in the middle, joint j has just moved x by Q_j d_j: Q_j is the product
///    of the turns of the joints before it about their axes in the middle. So all of them move n .
///    x by the sum of
///      (Q_j d_j) . n = d_j . n + d_j . (Q_j^T n - n), and
///      |Q_j^T n - n| <= sum over k < j that turn of c_k |w_k x n| =: f_j,
///    for turns leave lengths as they are, so that each of them counts for what it does to n alone.
///    Each summand is no more than c_j r_j either. The approach is what n . b falls and n . a
///    rises, so of the part of d_j along p only one sign counts.
/// 3. Any direction. As n is any, |ab| changes by at most the sum of c_j r_j(a) over the joints
///    before C and of c_j r_j(b) over those after it.
/// All r_j are those in the middle, however large the box: this is why each point has one side of
/// the chain (with the lesser of r_j(a) and r_j(b) at each joint, they would have to grow by what
/// the joints on both sides do). Which C is best is chosen for each pair of points; any holds. For
/// all points of balls around a and b, r_j and |n . p| grow by the ball's radius, and
/// |n . (w_j x p)| by |n x w_j| times it. A joint that occurs twice in a mechanism (mimics) counts
/// as several that are free: that bounds more than can happen.
/// Roundings: sums of positive terms in doubles, raised by 1e-9 of them; poses in the middle are
/// off by what the caller adds to the distance to be kept.
class ChainBounds {
 public:
  /// `chain` must outlive this.
  explicit ChainBounds(const LinkChain& chain);

  /// Sets the box; `place` is its middle, and must outlive the queries.
  void setBox(const JointBox& box, const LinkChain::Place& place);

  struct Ball {
    Eigen::Vector3d center;  ///< m, base frame
    double radius;           ///< m; of what is meant besides the centre
  };
  /// m. Approach of any point of `a` and any of `b`; in any direction.
  double approach(const Ball& a, const Ball& b);
  /// m. Bound on the decrease, within the box, of a separation measured along the unit vector n in
  /// the middle: for all pairs of points of the two balls. For radii 0 and n from a to b, of |ab|.
  double approachAlong(const Eigen::Vector3d& n, const Ball& a, const Ball& b);
  /// m; contribution of each variable to the last answer.
  std::span<const double> shares() const { return shares_; }

  /// Work of all answers so far, counted in additions, a few ns each: up to the square of the
  /// number of joints for each answer.
  std::int64_t work() const { return work_; }

 private:
  /// The effect of one joint on the points of a ball; m.
  struct Effect {
    double any;       ///< c_j r_j
    double directed;  ///< of n . d_j, as far as it brings the two together
  };
  double reach(std::size_t j, const Ball& ball) const;
  Effect effect(std::size_t j, const Eigen::Vector3d& n, const Ball& ball, double sign) const;
  /// With this many joints before C; m. Gives up beyond `most`.
  double sum(std::size_t before, double most);

  const LinkChain& chain_;
  const LinkChain::Place* place_ = nullptr;
  std::vector<double> half_, chord_;       ///< e_j, c_j
  std::vector<double> tilt_;               ///< c_j |w_j x n|; 0 where j slides
  std::vector<Effect> effectA_, effectB_;  ///< of each joint
  std::vector<double> cost_, bestCost_;    ///< m, of each joint
  std::vector<double> shares_;
  std::int64_t work_ = 0;
};

}  // namespace swept::detail
