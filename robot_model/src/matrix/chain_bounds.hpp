// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "matrix/link_chain.hpp"

namespace swept::detail {

/// How much nearer to each other than in the middle of a box of joint values two points can come.
///
/// Lemma. Let the joints between two bodies A and B be numbered from A to B, joint j within e_j of
/// the middle of its range (rad or m). Fix a point a of A and b of B, and let the middle mean all
/// joints in the middle of their ranges.
/// 1. Reach. When a joint turns by at most e, a point at distance r from its axis moves by at most
///    c r, c = min(e, 2): an arc is no shorter than its chord, a chord no longer than the diameter;
///    when it slides, by at most e. The distance of b from axis j depends on the joints after j
///    alone, so by moving these one after the other, it is within the box at most
///      r_j(b) = (in the middle) + sum over k > j of (c_k r_k(b), or e_k where k slides).
///    Likewise r_j(a), with the joints before j.
/// 2. Any direction. Moving joint j alone carries all on B's side of it relative to A's side, so
///    |ab| changes by at most s_j = c_j min(r_j(a), r_j(b)), or e_j where j slides.
/// 3. One direction. Let n = (b - a) / |ab| in the middle, and C a body of the chain. In C's frame
///    |ab| >= n . (b - a), in which b depends on the joints after C only and a on those before. For
///    x = b, let D be some of the joints after C. While these move and the others keep the middle,
///    Taylor's theorem bounds the change of n . x by
///      sum over D of (e_j |m_j| + e_j^2 r_j(x) / 2 + e_j sum over k in D, k > j, of e_k r_k(x)),
///    since dx/dq_j = w_j x (x - o_j) =: m_j along n, and d2x/dq_j dq_k = w_j x (w_k x (x - o_k))
///    is no longer than r_k(x). Where j slides, m_j = n . w_j and there is no second derivative
///    with respect to j and those after it; where k slides, r_k is replaced by 1. The joints that
///    are not in D move afterwards, for s_j each. a likewise.
/// Which C is best, and which joints are in D, is chosen anew for each pair of points; whatever is
/// chosen holds. For all points of balls around a and b, r_j grows by the ball's radius, and |m_j|
/// for a given n by |n x w_j| times it. A joint that occurs twice in a mechanism (mimics) counts as
/// several that are free: that bounds more than can happen.
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
  /// m. Decrease within the box of a separation that is measured along the unit vector n in the
  /// middle: of all pairs of points of the two balls. For radii 0 and n from a to b, of |ab|.
  double approachAlong(const Eigen::Vector3d& n, const Ball& a, const Ball& b);
  /// m; what each variable had in the last answer.
  std::span<const double> shares() const { return shares_; }

 private:
  void findReaches(const Ball& a, const Ball& b);
  /// What the joints from one end of the chain up to each joint cost, that one next to C.
  void sum(const Eigen::Vector3d& n, const Ball& ball, bool fromA);

  const LinkChain& chain_;
  const LinkChain::Place* place_ = nullptr;
  std::vector<double> half_, chord_;     ///< e_j, c_j (e_j where j slides)
  std::vector<double> reachA_, reachB_;  ///< r_j(a), r_j(b); 1 where j slides
  std::vector<double> free_;             ///< s_j
  std::vector<double> costA_, costB_;    ///< of each joint
  std::vector<double> totalA_, totalB_;  ///< of the first joints; of the last ones
  std::vector<double> shares_;
};

}  // namespace swept::detail
