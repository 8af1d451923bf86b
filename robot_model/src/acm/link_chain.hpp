// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <vector>

#include "kinematics/motion_model.hpp"
#include "rounding/error_model.hpp"

namespace swept::detail {

/// A model in which all of the robot's variables move, whatever groups there are.
KinematicModel wholeKinematics(const Robot& robot);

/// A range of values for each variable of a chain.
struct JointBox {
  std::vector<double> lower;  ///< rad or m
  std::vector<double> upper;

  double middle(std::size_t k) const { return 0.5 * lower[k] + 0.5 * upper[k]; }
  /// Upper bound on the distance of all values from the middle, rounding included.
  double half(std::size_t k) const {
    const double m = middle(k);
    return std::max(upper[k] - m, m - lower[k]) * kHalfRangeOutward;
  }
};

/// One joint between two bodies.
struct ChainJoint {
  int body = 0;              ///< body that the joint moves
  bool slides = false;       ///< prismatic; else it turns
  std::size_t variable = 0;  ///< index into LinkChain::variables()
  double scale = 1.0;        ///< factor from the variable's movement to the joint's; not negative
};

/// The joints between two bodies, in order from the first to the second, and their axes.
class LinkChain {
 public:
  /// Poses and axes for one value of each variable, in the frame of the last body that carries
  /// both.
  struct Place {
    struct Axis {
      Eigen::Vector3d point;      ///< m
      Eigen::Vector3d direction;  ///< unit
    };
    Eigen::Isometry3d base_from_a;
    Eigen::Isometry3d base_from_b;
    std::vector<Axis> axes;  ///< one per joint
    // Scratch: the path's part of a motion that stands still.
    std::vector<double> q;
    std::vector<JointMotion> motion;
    std::vector<BodyState> states;
  };

  /// `model` has all of the robot's variables and must outlive this. `beyond`: rad, how much
  /// farther joints that turn go than their limits.
  LinkChain(const Robot& robot, const KinematicModel& model, int bodyA, int bodyB,
            double beyond = 0.0);

  /// Whether the box contains all relative poses within the limits, and joints() all joints between
  /// the two.
  bool bounded() const { return bounded_; }
  const std::vector<ChainJoint>& joints() const { return joints_; }
  const std::vector<int>& variables() const { return variables_; }  ///< of the robot
  /// All values that the variables can have, including tolerance::kLimit beyond their limits, and
  /// `beyond` if nothing slides with them.
  /// Variables that can do a whole turn have one turn.
  const JointBox& box() const { return box_; }
  /// The limits themselves; may be infinite.
  const JointBox& limits() const { return limits_; }
  /// m; upper bound on the distance of both paths from the base's origin, without the links
  /// themselves.
  double reach() const { return reach_; }

  /// Sets all variables to these values of a whole configuration.
  void startFrom(const Eigen::VectorXd& configuration, Place& place) const;
  /// Sets the chain's variables to these values. False: nothing can be computed.
  bool moveTo(std::span<const double> values, Place& place) const;

 private:
  void addPath(int from, bool reversed);
  void addVariable(const Robot& robot, ChainJoint& joint);
  void boundTurns();

  const KinematicModel& model_;
  int bodyA_, bodyB_;
  int base_ = 0;
  bool bounded_ = true;
  double reach_ = 0.0;
  std::vector<ChainJoint> joints_;
  std::vector<int> order_;  ///< bodies of the path, parents first
  std::vector<int> variables_;
  JointBox box_, limits_;
};

}  // namespace swept::detail
