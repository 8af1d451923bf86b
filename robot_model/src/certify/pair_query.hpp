// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "certify/workspace_data.hpp"
#include "kinematics/joint_path.hpp"
#include "swept/core/hull_separation.hpp"
#include "swept/core/segment_query.hpp"

namespace swept::detail {

/// The result for one pair around one t.
struct PairAnswer {
  Separation status = Separation::Unproven;
  bool culled = false;  ///< bounding volumes were enough
  double travel =
      0.0;  ///< m, bound on the approach within the interval, without margin and rounding
  /// Model frame, from a to b: the best direction found. Zero: none.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, model frame; under Contact
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, model frame; under Contact
};

/// Exact distance of a pair at the current t, as an interval, kinematic rounding included.
struct PairDistance {
  double lower = 0.0;                                      ///< m
  double upper = std::numeric_limits<double>::infinity();  ///< m
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();        ///< m, model frame
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();        ///< m, model frame
  /// Model frame, from a to b: the direction along which `lower` is proven, zero if there is none.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// What prove() is about.
enum class Tube : std::uint8_t {
  Whole,  ///< all configurations that PairModel::tube allows
  None,   ///< only the motion itself
};

/// Part of a cloud: what is within `radius` (m) of the path (the model frame).
struct CloudPatch {
  std::uint32_t pair = 0;  ///< of a link and the cloud
  LineSegment path;
  double radius = 0.0;
};

/// The pairs of a model at one t of the motion held by a workspace.
class PairQuery {
 public:
  PairQuery(const CheckerModel& model, WorkspaceData& workspace, Tube tube = Tube::Whole)
      : model_(model),
        workspace_(workspace),
        tolerance_(model.options.tolerance),
        inTube_(tube == Tube::Whole && !model.tube.empty()) {}

  /// m. The target of prove() on intervals: a pair that keeps more than its margin and this is
  /// proven once intervals are short enough. The options' tolerance at first.
  void setTolerance(double tolerance) { tolerance_ = tolerance; }
  double tolerance() const { return tolerance_; }

  /// Takes a path, which must outlive the query. False: no bound holds for it.
  bool start(const JointPath& path);
  /// The same for a motion that stays at a configuration. Moves there.
  bool startAt(std::span<const double> q);
  /// Moves to t. Later calls are about [t - half, t + half], or t alone.
  void moveTo(double t, double half);

  /// Whether the pair stays apart by more than the margin on [t - half, t + half], or is within the
  /// margin at t. `half` in units of t: that of moveTo().
  PairAnswer prove(std::uint32_t pair, double half);
  /// For a pair that prove() left open: a configuration of the tube at t in which it is within the
  /// margin. Climbs a few steps from where the tube lets the two come nearest along the direction
  /// between them; finds nothing without a tube.
  std::optional<Witness> tubeContact(std::uint32_t pair, const PairAnswer& answer);
  /// Whether the link keeps the pair's margin from that part of the cloud on [t - half, t + half].
  /// False: not proven. Divides the interval where a ball of the cloud passes near the link, and
  /// the cloud's hierarchy where its nodes are larger than what the motion is curved. Moves to
  /// another t.
  bool staysApartFrom(const CloudPatch& patch, double t, double half);
  /// Distance at t. Stops early when it is proven to exceed `enough` (m).
  PairDistance measure(const GeometryPair& pair, double enough, double accuracy);
  /// The same, negative where they overlap; see signedDistance().
  SignedClearance measureSigned(const GeometryPair& pair, double accuracy);
  /// Whether the pair stays farther apart than `distance` (m) on [t - half, t + half]. False: not
  /// proven. `guess`: a direction to try first, model frame, from a to b.
  bool staysBeyond(const GeometryPair& pair, double half, double distance,
                   const Eigen::Vector3d& guess, double accuracy);
  /// m per unit of t, model frame: velocity of a point of b relative to a point of a. Both points
  /// in m, model frame, at t.
  Eigen::Vector3d velocity(const GeometryPair& pair, const Eigen::Vector3d& pointA,
                           const Eigen::Vector3d& pointB);
  /// m, model frame: a point given in the frame of the first geometry's body.
  Eigen::Vector3d placed(std::uint32_t pair, const Eigen::Vector3d& point) {
    return state(model_.robotGeometry[model_.pair(pair).a].body).world_from_body * point;
  }
  /// Pose of a geometry's shape in the model frame.
  const Eigen::Isometry3d& pose(int geometry);
  /// m. Bound on the pair's approach during `half`.
  double travel(const GeometryPair& pair, double half);
  /// m. Lower bound from bounding volumes alone, kinematic rounding included.
  double coarseDistance(const GeometryPair& pair);
  /// m. The same over [t - half, t + half], along the direction between the bounding volumes. NaN
  /// without a bound on the motion.
  double coarseBound(const GeometryPair& pair, double half);
  /// m. Lower bounds on the pair's distance at t, and on [t - half, t + half]: between the hulls,
  /// along `towards` (model frame, from a to b), or, if that is zero, along the direction between
  /// the bounding volumes.
  HullSeparation hullBound(const GeometryPair& pair, double half, const Eigen::Vector3d& towards);

  /// m, model frame: holds the geometry, grown by the largest margin and rounding of all pairs, on
  /// [t - half, t + half].
  Aabb ballBox(int geometry, double half);
  /// m, model frame: holds the pair's geometry of the robot, grown by the pair's rounding, on
  /// [t - half, t + half].
  Aabb ballBox(const GeometryPair& pair, double half);
  /// m. Bound on the rounding of every pair's relative pose, for any point, in this motion.
  double largestRounding() const;

  Witness witness(std::uint32_t pair, double t, const PairAnswer& answer) const;

 private:
  const BodyState& state(int body);
  /// m, over the current motion; valid until asked for another geometry.
  std::span<const double> arms(const RobotGeometry& geometry);
  const PointMotionBound& bound(int travel);
  const PointMotionBound& nestedBound(const MotionBoundSlot& slot);
  Eigen::Vector3d& hint(std::uint32_t pair);
  const Eigen::Vector3d& center(int geometry);
  double rounding(const GeometryPair& pair) const;
  Aabb boxAround(int geometry, double reach);
  /// The result of comparing containing balls and boxes.
  enum class Coarse : std::uint8_t { Open, Apart, TooFast };
  /// Sets `towards` to the unit direction of the comparison, from the first to the second.
  Coarse compareBounds(const GeometryPair& pair, const ApproachBound& bound,
                       const ApproachBound& alone, const Eigen::Vector3d& relativeVelocity,
                       Eigen::Vector3d& towards);
  /// m. Gap of the containing balls (and the world geometry's box), without rounding; negative: by
  /// how much they overlap. `direction` from the first to the second, of any length.
  double gapOfBounds(const GeometryPair& pair, Eigen::Vector3d& direction);
  Eigen::Vector3d relativeVelocity(const GeometryPair& pair);
  /// Without directions, which relativeMotion() adds. `separation` in m.
  ApproachBound approach(const GeometryPair& pair, double half, double separation);
  void relativeMotion(const GeometryPair& pair, double half, const Eigen::Isometry3d& world_from_a,
                      const Eigen::Vector3d& velocity, ApproachBound& bound);
  ///@{
  /// Of a tube: see pair_tube.cpp.
  void widenRanges();
  void boundTubeMotion(double half);
  PointMotionBound tubeBound(int travel);
  const ApproachBound& withTube(const GeometryPair& pair, const ApproachBound& motion);
  double addErrors(int geometry, int motionBound, double sign);
  void takeTube(const Eigen::Isometry3d& world_from_a, const ApproachBound& tube,
                ApproachBound& bound);
  void addGradient(int geometry, int motionBound, const Eigen::Vector3d& push,
                   std::span<double> gradient);
  ///@}
  bool passes(const GeometryPair& pair, const PointCloud& cloud, const LineSegment& near,
              double radius, double t, double half, std::size_t first, int halvings, int& tests);
  const Shape& shapeOfB(const GeometryPair& pair) const;
  Eigen::Isometry3d poseOfB(const GeometryPair& pair);

  const CheckerModel& model_;
  WorkspaceData& workspace_;
  double tolerance_;
  const bool inTube_;
  const JointPath* path_ = nullptr;    ///< null where no joint's rate changes
  const JointPath* source_ = nullptr;  ///< the path; null at a single configuration
  std::span<const double> state_;      ///< that
};

}  // namespace swept::detail
