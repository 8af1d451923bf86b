// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

/// What a task asks of a robot besides keeping clear of bodies: see Checker::withConstraints().
namespace swept {

/// A frame that is fixed in a link or an attached body. The frame of an attached body is that of
/// the link that carries it.
struct ConstraintFrame {
  std::string body = {};  ///< a link or an attached body; empty: the robot's model frame
  Eigen::Isometry3d body_from_frame = Eigen::Isometry3d::Identity();  ///< its pose in that body
};

/// moveit_msgs/JointConstraint: a value is in [position - below, position + above]. The difference
/// to `position` is the signed shorter one where the value is cyclic. As of limits,
/// tolerance::kLimit more counts as within.
struct JointConstraint {
  /// A joint of one value, which may follow another one, or a variable (`base/x`).
  std::string joint;
  double position = 0.0;  ///< rad or m
  double above = 0.0;     ///< rad or m, not negative
  double below = 0.0;     ///< rad or m, not negative
};

/// Where a point may be: a primitive of moveit_msgs/PositionConstraint. A size may be infinite.
struct ConstraintRegion {
  /// The shape, of which `size` has the sizes.
  enum class Type : std::uint8_t { Box, Sphere, Cylinder };
  Type type = Type::Box;  ///< see there
  /// m. Of a box the full sides; of a sphere its radius, 0, 0; of a cylinder, about z, its radius
  /// and length, 0.
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  Eigen::Isometry3d reference_from_region = Eigen::Isometry3d::Identity();  ///< pose of its centre
};

/// moveit_msgs/PositionConstraint: the origin of `frame` is in one of the regions. MoveIt's
/// target_point_offset is the origin of a frame in the link.
struct PositionConstraint {
  ConstraintFrame frame;                  ///< whose origin it is about
  ConstraintFrame reference = {};         ///< of the regions
  std::vector<ConstraintRegion> regions;  ///< one at least
};

/// moveit_msgs/OrientationConstraint: `frame` is turned from `orientation` by no more than the
/// tolerances. With R = inverse(orientation) * (rotation from `reference` to `frame`):
struct OrientationConstraint {
  /// What the tolerances are of.
  enum class Parameterization : std::uint8_t {
    /// R = Rx(a) Ry(b) Rz(c), |b| <= pi/2, and |a|, |b|, |c| are within x, y, z. Where |b| = pi/2,
    /// no single a and c exist: unless neither is limited, nothing is proven there.
    EulerAngles,
    /// The rotation vector of R, given in the axes of `reference`, is within x, y, z.
    RotationVector,
  };
  ConstraintFrame frame;           ///< whose orientation it is about
  ConstraintFrame reference = {};  ///< from which it is seen
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< in `reference`; unit length
  Eigen::Vector3d tolerance = Eigen::Vector3d::Zero();  ///< rad, not negative; pi and more: any
  Parameterization parameterization = Parameterization::EulerAngles;  ///< see there
};

/// An axis of `frame` is within an angle of a direction of `reference`. Not one of MoveIt's: its
/// tolerances about x and y allow a pyramid of directions, this a cone.
struct AxisConstraint {
  ConstraintFrame frame;                                 ///< whose axis it is about
  ConstraintFrame reference = {};                        ///< from which it is seen
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();       ///< in `frame`, not zero
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< in `reference`, not zero
  double angle = 0.0;                                    ///< rad, not negative; pi and more: any
};

/// All of these hold at once. Weights of MoveIt's messages have no place here: a constraint that is
/// in here holds. 64 constraints at most.
struct TaskConstraint {
  ///@{
  /// What has to hold, by kind.
  std::vector<JointConstraint> joints = {};
  std::vector<PositionConstraint> positions = {};
  std::vector<OrientationConstraint> orientations = {};
  std::vector<AxisConstraint> axes = {};
  ///@}

  ///@{
  /// Of all kinds together.
  bool empty() const { return size() == 0; }
  std::size_t size() const {
    return joints.size() + positions.size() + orientations.size() + axes.size();
  }
  ///@}
  /// Adds those of another one behind these.
  void add(const TaskConstraint& other);

  ///@{
  /// `angle` in rad, `link` a link or an attached body, poses in the model frame.
  ///
  /// An axis of the link points up, along z of the model frame.
  static TaskConstraint upright(const std::string& link, double angle,
                                const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ());
  /// What points up in a link at this pose keeps pointing up: the link neither pitches nor rolls,
  /// but may turn about the vertical.
  static TaskConstraint level(const std::string& link, const Eigen::Isometry3d& model_from_link,
                              double angle);
  /// The point of a link is in a box with full sides `size` (m).
  static TaskConstraint inside(const std::string& link, const Eigen::Vector3d& size,
                               const Eigen::Isometry3d& model_from_box,
                               const Eigen::Vector3d& point = Eigen::Vector3d::Zero());
  /// The point of a link is within `tolerance` (m) of a line through `origin`.
  static TaskConstraint onLine(const std::string& link, const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction, double tolerance,
                               const Eigen::Vector3d& point = Eigen::Vector3d::Zero());
  /// The point of a link is within `tolerance` (m) of a plane through `origin`.
  static TaskConstraint onPlane(const std::string& link, const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& normal, double tolerance,
                                const Eigen::Vector3d& point = Eigen::Vector3d::Zero());
  ///@}
};

/// A constraint does not hold at an instant, proven with all rounding.
struct ConstraintViolation {
  /// Lists of TaskConstraint.
  enum class Kind : std::uint8_t { Joint, Position, Orientation, Axis };
  double t = 0.0;           ///< in [0, 1]; 0 for a state
  Kind kind = Kind::Joint;  ///< in which list of TaskConstraint the constraint is
  std::size_t index = 0;    ///< into that list
  /// rad or m. By how much: the most of its angles or its value beyond the tolerance, or the
  /// distance from the nearest region.
  double excess = 0.0;
};

/// `orientation of 'hand' is 0.0213 rad beyond its tolerance`: the violation in words, without t.
std::string describe(const ConstraintViolation& violation, const TaskConstraint& constraint);

}  // namespace swept
