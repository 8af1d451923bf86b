// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateSpace.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

namespace detail {
enum class SubspaceKind : std::uint8_t { RealVector, SO2, SE2, SE3 };
}

/// Options of a group's space, in addition to the robot's data.
struct StateSpaceOptions {
  /// Lower and upper limits of variables by name (rad or m), within the robot's own. A limit beyond
  /// those by at most tolerance::kLimit is moved to them, with a warning to OMPL's console. If the
  /// robot has none, they replace the default below. Not for continuous joints and orientations.
  std::map<std::string, std::pair<double, double>> limits = {};
  /// Factors (> 0) of joints, by name, in the distance between states; 1 for the others.
  std::map<std::string, double> weights = {};
};

/// State space of a group: joints with limits become RealVector dimensions, continuous joints
/// SO(2), planar joints SE(2), floating joints SE(3). A group of joints with limits only is one
/// RealVectorStateSpace; any other is a compound in which consecutive limited joints share a
/// RealVector. Its `interpolate` is the motion that Checker::certifyMotion certifies.
///
/// The space is named after the group, a dimension after its variable, a subspace after its joint
/// (`first..last` if joints share one). Unbounded prismatic, planar or floating translations need
/// bounds: they are +-10 m unless the options have others (limitsAround() makes some).
/// longestValidSegmentFraction is OMPL's 1 %. It does not affect validity, only how densely paths
/// are interpolated for display. `satisfiesBounds` accepts a limited joint's value at most
/// tolerance::kLimit beyond its bounds, as Checker::withinLimits does; `enforceBounds` and samples
/// are within the bounds themselves.
///
/// The default projection, for planners that keep grids, is the position of the group's tip (its
/// first two values if it moves no tip).
///
/// Throws std::invalid_argument for a group without variables, a name in the options that is not of
/// the group or has no limits, limits that are not within the robot's, and a weight that is not a
/// positive number.
ompl::base::StateSpacePtr makeStateSpace(const Robot& robot, const Group& group,
                                         const StateSpaceOptions& options = {});

/// Limits for StateSpaceOptions that contain the configurations. They replace the default limits of
/// unbounded translations that leave out one of the configurations, and reach 10 m beyond it.
/// Throws std::invalid_argument for a configuration of another size than the group's.
std::map<std::string, std::pair<double, double>> limitsAround(
    const Robot& robot, const Group& group, const ConfigurationList& configurations);

/// Copies between a state of makeStateSpace(robot, group) and the group's configuration. Both
/// functions throw std::invalid_argument unless q has `dimension()` values.
class StateConversion {
 public:
  /// For states of makeStateSpace(robot, group), whatever its options.
  StateConversion(const Robot& robot, const Group& group);
  /// Number of values in a configuration.
  int dimension() const { return dimension_; }
  /// Fills `q` with the state's values, unchanged: rad, m, components of quaternions.
  void toConfiguration(const ompl::base::State* state, ConfigurationSpan q) const;
  /// Fills `state` with the values of `q`. Wraps angles of cyclic variables to [-pi, pi) and scales
  /// quaternions to unit length, as OMPL requires. Moves values at most tolerance::kLimit beyond a
  /// limit of the robot to it (limitNear()). A zero or non-finite quaternion is copied as it is;
  /// such a state is never valid.
  void toState(ConfigurationView q, ompl::base::State* state) const;

 private:
  struct Block {
    detail::SubspaceKind kind;
    int first;  ///< into the configuration
    int size;   ///< numbers in the configuration
  };
  std::vector<Block> blocks_;        ///< one per subspace, in order
  std::vector<Variable> variables_;  ///< one per value of a configuration
  bool compound_ = false;
  int dimension_ = 0;
};

}  // namespace swept
