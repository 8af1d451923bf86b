// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "simd/compile/simd_model.hpp"
#include "simd/tables/pair_separation_table.hpp"
#include "simd/tables/table_motion.hpp"

namespace swept::detail {

/// The ball inside a link that a node of its cover stores.
PairSeparationTable::InnerBall innerBall(const SimdNode& node);

/// The largest ball around `center` (m, frame of SimdNode::center) that is proven to lie in the
/// solid of a piece of the robot's geometry; a radius of 0 if there is none.
PairSeparationTable::InnerBall innerBallAround(const PairModel& model, const SimdModel& simd,
                                               int geometry, const Eigen::Vector3d& center);

/// Whether two pieces of geometry are apart for all values of the joints around a middle.
///
/// Each pair of their points is in some pair of balls of their covers. It is apart if these balls
/// are apart by more than their centres approach each other, or if the geometries in the middle are
/// apart by more than points of these balls travel; see TableMotion.
class PairProof {
 public:
  using Place = TableMotion::Place;
  using Levers = TableMotion::Levers;
  struct Balls {
    std::int32_t a;  ///< of SimdModel::nodes
    std::int32_t b;
  };
  /// The exact result for the middle.
  struct Compared {
    bool tried = false;
    bool touching = false;
    double gap = 0.0;                                 ///< m, proven, less the slack
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< m, lane frame of A; common, if touching
  };

  PairProof(const PairModel& model, const SimdModel& simd, const SimdBodyPair& bodies,
            const TableMotion& motion);

  /// Sets the pair of the following queries.
  void choose(const PairSeparationTable::Geometries& pair);
  bool apartByBalls(const Place& place);
  /// Also uses the exact geometry, which is worth its time only if the covers fail by little: where
  /// they stopped last. `single`: a contact matters too.
  Compared compareWhereStopped(const Place& place, bool single);
  /// The distance of the exact geometry, between contact and what is enough for points that travel
  /// this far (m).
  Compared compare(const Place& place, double contact, double travel);
  bool apartWithin(const Place& place, double gap);
  /// For points of the geometries that balls do not prove apart: all others are apart, and these
  /// come no nearer to each other than the geometries are in the middle, minus their travel.
  Levers closeLevers(const Place& place);

  /// Known balls inside the two links that meet in the middle.
  bool meet() const { return meeting_ > 0.0; }
  /// For all values of the joints.
  bool alwaysMeet() const { return certain_; }
  const PairSeparationTable::InnerBall& meetingOfA() const { return meetingOfA_; }
  const PairSeparationTable::InnerBall& meetingOfB() const { return meetingOfB_; }
  /// Those that overlap most, among the covers' balls and those found in the solids.
  void findMeeting(const Place& place, const Compared& found);

  double margin() const { return margin_; }  ///< m, of the pair
  double slack() const { return slack_; }    ///< m, for the margin and for roundings
  /// Remaining work: distances of balls, or equally long steps, are subtracted from it; some 30 ns
  /// each.
  int work = 0;

 private:
  /// Two balls at their middle poses.
  struct Look {
    const SimdNode& a;
    const SimdNode& b;
    Eigen::Vector3d atA;  ///< m, a's frame; the centres
    Eigen::Vector3d inB;  ///< m, b's frame
    Eigen::Vector3d atB;  ///< m, a's frame
    double between;       ///< m
  };
  Look lookAt(const Place& place, const Balls& balls) const;
  /// The pairs that such a pair is split into.
  struct Split {
    Balls balls;
    bool ofA;
    std::int32_t first;
    std::int32_t count;  ///< 0: neither ball has children
    Balls child(std::int32_t i) const {
      return ofA ? Balls{first + i, balls.b} : Balls{balls.a, first + i};
    }
  };
  Split split(const Balls& balls) const;

  Balls roots() const;
  double widest(std::int32_t node, bool ofA) const;
  bool apart(const Place& place, const Balls& balls);
  bool staysWithinGap(const Place& place, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      float radiusA, float radiusB) const;
  bool noteMeeting(const Place& place, const PairSeparationTable::InnerBall& a,
                   const PairSeparationTable::InnerBall& b);
  void noteLastMeeting(const Place& place);
  void findAround(const Place& place, const Eigen::Vector3d& point, const Eigen::Vector3d& middleA,
                  const Eigen::Vector3d& middleB);
  void findLevers(const Place& place, const Balls& balls);

  const PairModel& model_;
  const SimdModel& simd_;
  const TableMotion& motion_;
  double margin_ = 0.0;
  double slack_ = 0.0;
  Levers whole_{};  ///< of all centres of balls of the bodies
  int geometryA_ = -1;
  int geometryB_ = -1;
  Balls stopped_{-1, -1};
  double gap_ = 0.0;      ///< m, see apart
  double meeting_ = 0.0;  ///< m, largest overlap of balls inside the links in the middle
  bool certain_ = false;
  PairSeparationTable::InnerBall meetingOfA_, meetingOfB_;  ///< lately
  Levers close_{};
  int looks_ = 0;
  Eigen::Vector3d guess_ = Eigen::Vector3d::Zero();
};

}  // namespace swept::detail
