// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "continuous/relative_motion.hpp"
#include "narrowphase/gjk.hpp"
#include "narrowphase/piece_motions.hpp"
#include "narrowphase/piece_pair.hpp"
#include "swept/core/continuous/continuous_collide.hpp"

namespace swept::detail {

/// Two pieces, given by their places in the hierarchies, not yet proven apart.
struct OpenPair {
  int placeA = -1;
  int placeB = -1;
  /// From a to b, a's frame: the best direction known, if not zero.
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();
};

/// Examines pairs of pieces during one interval of a motion. Each pair is proven apart for the
/// whole interval, divided, or put on the list with which shorter intervals start (the front list
/// of Pan, Chitta, Manocha 2012, section IV, here passed from an interval to its parts).
///
/// A pair is divided as long as its pieces are large compared to their approach. After that, a
/// shorter interval proves more than smaller pieces do. Bounds are directional and use each node's
/// own motion (as in C2A: Tang, Kim, Manocha 2009).
class SliceDescent {
 public:
  struct Goal {
    double margin;    ///< m
    double accuracy;  ///< m, of distances
    /// m. Pairs that approach by less than this are divided in any case, because no shorter
    /// interval follows.
    double divideBelow;
  };
  /// Refers to all arguments. Appends to `open`.
  SliceDescent(const Side& a, const Side& b, const MotionSlice& slice, const Goal& goal,
               std::vector<OpenPair>& open, ContinuousEffort& effort);

  void look(const OpenPair& pair);

  /// The parts of half the interval, before its middle and after, for which pairs are apart.
  struct Proven {
    double before = 1.0;
    double after = 1.0;
  };

  /// Two points (m, a's frame) at most the margin apart at the middle. Pairs that come after them
  /// go on the list untested; the pair in contact is the first one added.
  struct Contact {
    Eigen::Vector3d pointA;
    Eigen::Vector3d pointB;
  };
  const std::optional<Contact>& contact() const { return contact_; }
  /// The part proven for all pairs.
  const Proven& proven() const { return proven_; }
  /// m. Upper bound on the approach of all pairs left open, within half the interval.
  double approach() const { return approach_; }
  /// The pair whose proof ends first after the middle, if it is a pair of leaves.
  const std::optional<OpenPair>& nearest() const { return nearest_; }

 private:
  struct Part {
    Piece piece;
    PartMotion motion;
  };
  Part part(bool ofA, const Piece& piece) const { return {piece, motions_.of(ofA, piece)}; }
  /// What is known about a pair before it is examined closely.
  struct Known {
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< from a to b, a's frame; or zero
    Proven proven{0.0, 0.0};
  };
  /// `gap`: m, along the unit vector n at the middle.
  Proven provenBy(double gap, const Eigen::Vector3d& n, const PartApproach& approach) const;
  bool areHullsApart(const PartApproach& approach, Known& known);
  bool isTooFast(const Part& a, const Part& b, const PartApproach& approach) const;
  void descend(const Part& a, const Part& b, const Known& known);
  void descendInto(const PiecePair::Split& split, const Part& other, double beyond,
                   const Eigen::Vector3d& guess);
  bool isApart(const BoxGap& gap, const PartApproach& approach, Known& known) const;
  void testLeaves(const Part& a, const Part& b, const PartApproach& approach,
                  const Eigen::Vector3d& guess);
  void markUnresolved(const Part& a, const Part& b, const Known& known, double approach);

  const Side& a_;
  const Side& b_;
  const MotionSlice& slice_;
  const Goal goal_;
  const PieceMotions motions_;
  const PiecePair pieces_;
  std::vector<OpenPair>& open_;
  std::size_t begin_;
  ContinuousEffort& effort_;
  std::optional<Contact> contact_;
  Proven proven_;
  double approach_ = 0.0;
  std::optional<OpenPair> nearest_;
};

}  // namespace swept::detail
