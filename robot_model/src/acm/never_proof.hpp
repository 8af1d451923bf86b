// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "acm/chain_bounds.hpp"
#include "acm/link_pieces.hpp"

namespace swept::detail {

/// Proves two links apart for all values of the joints between them, by branch and bound.
///
/// A box of joint values is examined in its middle. Each point of a link is in the ball of some
/// leaf of its cover. So two links are more than the margin apart in the whole box if each pair of
/// leaves, or of their ancestors, is: the distance of the centres exceeds the radii, the margin,
/// the rounding of poses and the approach bound of ChainBounds. What a box proved also holds in its
/// parts, so these inherit only the open pairs of balls, whose number falls as boxes get smaller.
/// If pairs are open, exact geometry gives planes between the hulls of the links' pieces in the
/// middle, and if leaves are open, the distance. A pair of balls whose points approach by less than
/// that, across the plane or in any direction, is proven apart as well. If pairs are left, the box
/// is halved across the variable that contributes most to the approach of the worst pair.
///
/// Boxes are processed depth first: the list of open pairs of balls is then a stack.
class NeverProof {
 public:
  enum class State : std::uint8_t {
    Open,     ///< the budget ran out
    Proven,   ///< never within the margin
    Contact,  ///< within the margin at nearest()
    Stuck,    ///< everything was examined, and some boxes were too small to be halved again
  };

  /// All must outlive this. `place` starts from the configuration that the other variables keep.
  NeverProof(const LinkPieces& a, const LinkPieces& b, const LinkChain& chain, double margin,
             LinkChain::Place& place);

  /// Continues until this much of the budget, or of the work, is spent in total.
  State run(std::int64_t budget, std::int64_t mostWork = std::numeric_limits<std::int64_t>::max());

  std::int64_t effort() const { return effort_; }
  /// Time, as ChainBounds::work() counts it. The effort does not measure it: a unit of effort takes
  /// longer the more joints there are.
  std::int64_t work() const;
  /// Upper bound on the work of a run within the budget, unless covers are so large that a single
  /// box goes far beyond it.
  static std::int64_t usualWork(std::int64_t budget, std::size_t joints);
  double share() const { return share_; }  ///< of the box, by volume, that is proven
  /// Values of the chain's variables in the middle of the box with the least exact distance.
  const std::vector<double>& nearest() const { return nearest_; }

 private:
  struct BallPair {
    int a;
    int b;
  };
  struct Box {
    JointBox values;
    std::size_t first;  ///< into the arena: pairs of balls not yet proven apart
    std::size_t count;
    double share;
  };
  /// The open pair of balls in a box that is farthest from being proven apart.
  struct Worst {
    double lack = 0.0;           ///< m
    double approach = 0.0;       ///< m
    std::vector<double> shares;  ///< m, of each variable in the approach
  };

  bool outOfWork() const { return work() >= mostWork_; }
  void look(const Box& box);
  void collectOpen(const Box& box);
  /// Adds what is open of the pair, or of its descendants, to the arena.
  void refine(BallPair pair);
  /// Whether the pair is proven apart in the box; both in m, without margin and rounding.
  bool isApart(const BallPair& pair, double& approach, double& gap);
  void askExact(const BallPair& leaves);
  /// Takes the open pairs out of the arena that planes or the exact distance prove.
  void dropFar();
  bool isFar(const BallPair& pair);
  /// Remembers the last answer of the bounds where it is the worst so far.
  void keepWorst(double approach, double gap);
  const PiecePlane& planeOf(const BallPair& pair);
  void split(const Box& box);
  ChainBounds::Ball ballA(int i, double radius) const;
  ChainBounds::Ball ballB(int i, double radius) const;

  const LinkPieces& a_;
  const LinkPieces& b_;
  const LinkChain& chain_;
  const double margin_;
  LinkChain::Place& place_;
  ChainBounds bounds_;
  double required_ = 0.0;  ///< m, margin, errors of the sources and rounding
  std::vector<Box> boxes_;
  std::vector<BallPair> arena_, work_;
  std::size_t firstOpen_ = 0;
  Worst worst_;
  bool asked_ = false;                             ///< exact geometry, in this box
  double exactDistance_ = 0.0;                     ///< m, lower bound, in the middle
  std::vector<std::optional<PiecePlane>> planes_;  ///< of two pieces, in this box
  std::int64_t effort_ = 0;
  std::int64_t moves_ = 0;  ///< of joints, to the middles of boxes
  std::int64_t mostWork_ = std::numeric_limits<std::int64_t>::max();
  double share_ = 0.0;
  bool stuck_ = false;
  bool contact_ = false;
  double nearestDistance_;
  std::vector<double> middle_, nearest_;
};

}  // namespace swept::detail
