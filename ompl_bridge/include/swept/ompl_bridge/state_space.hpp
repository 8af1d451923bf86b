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

/// What the space of a group is to have besides what the robot says.
struct StateSpaceOptions {
  /// Limits of variables by name, lower and upper (rad or m): within the robot's own. One that is
  /// beyond those by at most tolerance::kLimit is taken to them, with a warning to OMPL's console.
  /// Where the robot has none, they replace the default below. Not for continuous joints and
  /// orientations.
  std::map<std::string, std::pair<double, double>> limits = {};
  /// Factors (> 0) of joints, by name, in the distance between states; of the others 1.
  std::map<std::string, double> weights = {};
};

/// State space of a group: joints with limits become RealVector dimensions, continuous joints
/// SO(2), planar joints SE(2), floating joints SE(3). A group of joints with limits only is one
/// RealVectorStateSpace; any other is a compound in which consecutive limited joints share a
/// RealVector. Its `interpolate` is the motion that Checker::certifyMotion certifies.
///
/// The space has the group's name, a dimension its variable's, a subspace its joint's
/// (`first..last` where joints share one). Unbounded prismatic, planar or floating translations
/// need bounds: they are +-10 m unless the options have others (limitsAround() makes some).
/// longestValidSegmentFraction is OMPL's 1 %: it plays no part in validity, only in how densely
/// paths are interpolated for show. `satisfiesBounds` takes a limited joint's value for inside that
/// is at most tolerance::kLimit beyond its bounds, as Checker::withinLimits does; `enforceBounds`
/// and samples are within the bounds themselves.
///
/// The default projection, for planners that keep grids, is the position of the group's tip (its
/// first two values where the group has none that it moves).
///
/// Throws std::invalid_argument for a group without variables, a name in the options that is not of
/// the group or has no limits, limits that are not within the robot's, and a weight that is not a
/// positive number.
ompl::base::StateSpacePtr makeStateSpace(const Robot& robot, const Group& group,
                                         const StateSpaceOptions& options = {});

/// Limits, for StateSpaceOptions, of the unbounded translations whose default limits leave out one
/// of the configurations: they reach 10 m beyond it. Throws std::invalid_argument for a
/// configuration of another size than the group's.
std::map<std::string, std::pair<double, double>> limitsAround(
    const Robot& robot, const Group& group, const ConfigurationList& configurations);

/// Copies between a state of makeStateSpace(robot, group) and the group's configuration.
/// Both throw std::invalid_argument unless q has `dimension()` values.
class StateConversion {
 public:
  /// For states of makeStateSpace(robot, group), whatever its options.
  StateConversion(const Robot& robot, const Group& group);
  /// Values of a configuration.
  int dimension() const { return dimension_; }
  /// Fills `q` with the values as they are: rad, m, components of quaternions.
  void toConfiguration(const ompl::base::State* state, ConfigurationSpan q) const;
  /// Puts angles of cyclic variables into [-pi, pi) and scales quaternions to unit length, as OMPL
  /// wants them, and takes what is at most tolerance::kLimit beyond a limit of the robot to it
  /// (limitNear()). A zero or non-finite quaternion is copied as it is; such a state is never
  /// valid.
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
