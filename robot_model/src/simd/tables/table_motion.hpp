// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "simd/compile/simd_model.hpp"
#include "simd/tables/pair_separation_table.hpp"

namespace swept::detail {

struct PairModel;

/// How two bodies move relative to each other while the one or two joints between them turn.
///
/// Lemma. Of two joints, let the first be the one next to body A along the chain from A to B, and C
/// the body between the two. In C's frame a point a of A turns about the first axis only, a point b
/// of B about the second only, and both axes stand still. Let the joints be within h1 and h2 of the
/// middle of their range, r1 the distance of a from the first axis (the same for all values of the
/// joints), r2 that of b from the second. Then
///   | |ab| - |ab| in the middle | <= h1 r1 + h2 r2,
/// since an arc is no shorter than its chord. Further, let n be the direction of b - a in the
/// middle. |ab| >= n . (b - a), in which either angle has a term of its own,
///   n . (o + R(angle) r), with first derivative m = n . (w x r), w the axis' direction,
/// and second derivative at most the distance of the point from the axis. So
///   |ab| >= |ab| in the middle - sum over both of min(h r, h |m| + h^2 r / 2).
/// With a single joint C may be either body, whichever gives less; m is the same for both points,
/// as they are on one line along n.
/// Roundings are those of doubles: the sums are raised by 1e-9 of them and the slack of a table,
/// 1e-5 of the robot's reach, is far more than what poses are off.
class TableMotion {
 public:
  /// Nothing if the relative pose depends on other than one or two joints that turn. Of two joints
  /// a table has so many times fewer cells along each as `coarseness` says.
  static std::optional<TableMotion> between(const PairModel& model, const SimdModel& simd,
                                            const SimdBodyPair& bodies, int coarseness = 1);

  /// m. Per joint, what the lemma's h is to be multiplied with.
  using Levers = std::array<double, 2>;

  struct Line {
    Eigen::Vector3d point;
    Eigen::Vector3d direction;

    /// m, of a point.
    double distance(const Eigen::Vector3d& from) const {
      return direction.cross(from - point).norm();
    }
  };
  /// Joints within `half` of a middle.
  struct Place {
    Eigen::Isometry3d bodies;      ///< A's frame from B's, as the kinematics has them
    Eigen::Isometry3d a_from_b;    ///< between the frames that the balls are in
    std::array<double, 2> half{};  ///< rad
    Line axisB;                    ///< of the joint next to B, in A's frame
  };
  /// Joint values from, and up to, a number of parts of cells.
  struct Parts {
    std::array<int, 2> begin{0, 0};
    std::array<int, 2> end{1, 1};
  };
  Place placeOf(const Parts& parts) const;
  /// m; bound on the travel from the middle of the parts to all values in a single one, (i, j).
  double travelTo(const Parts& parts, int i, int j, const Levers& levers) const;

  int joints() const { return static_cast<int>(path_.size()); }
  const std::array<PairSeparationTable::Axis, PairSeparationTable::kMostJoints>& axes() const {
    return axes_;
  }
  /// Cells along a joint after which all is as it was before; all of them if there is no such.
  int turn(int k) const { return turn_[k]; }

  static double travel(const Place& place, const Levers& levers) {
    return (place.half[0] * levers[0] + place.half[1] * levers[1]) * (1.0 + 1e-9);
  }
  /// Of points, in the frames that the balls are in; `growth`: and of all so far from them.
  Levers levers(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double growthA = 0.0,
                double growthB = 0.0) const {
    return combine(axisA_.distance(a) + growthA, axisB_.distance(b) + growthB);
  }
  /// From bounds on the distances of points of either body from the axis next to it.
  Levers combine(double ofA, double ofB) const {
    Levers result{};
    if (path_.size() == 1) {
      result[0] = ofA < ofB ? ofA : ofB;
    } else {
      result[jointA_] = ofA;
      result[jointB_] = ofB;
    }
    return result;
  }
  double leverOfA(const Eigen::Vector3d& a) const { return axisA_.distance(a); }
  double leverOfB(const Eigen::Vector3d& b) const { return axisB_.distance(b); }
  /// m; how much nearer to each other than in the middle two points can come, `a` and `b` where
  /// they are in the middle in A's frame, `distance` apart.
  double approach(const Place& place, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  double distance, const Levers& levers) const;

 private:
  TableMotion(const PairModel& model, const SimdModel& simd, const SimdBodyPair& bodies)
      : model_(model), simd_(simd), bodies_(bodies) {}

  void collect(int body, int reference, std::vector<int>& path) const;
  bool setAxes(int coarseness);
  Line axisIn(int body, int joint) const;
  Eigen::Isometry3d pose(const std::vector<int>& path, const double* values) const;

  const PairModel& model_;
  const SimdModel& simd_;
  const SimdBodyPair& bodies_;
  std::vector<int> pathA_, pathB_;  ///< bodies, from the reference's child on
  std::vector<int> path_;           ///< both, in the table's order
  int jointA_ = 0;                  ///< index into path_, of the joint next to A
  int jointB_ = 0;
  Line axisA_, axisB_;  ///< of these joints, in A's and in B's frame
  std::array<PairSeparationTable::Axis, PairSeparationTable::kMostJoints> axes_;
  std::array<int, 2> turn_{1, 1};
  std::array<double, 2> low_{};  ///< rad
  std::array<double, 2> step_{1.0, 1.0};
};

}  // namespace swept::detail
