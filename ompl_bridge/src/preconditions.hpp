// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateSpace.h>

#include <memory>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"

namespace swept::detail {

/// Names of a group's variables, in its order.
std::vector<std::string> variablesOf(const Robot& robot, const Group& group);

/// CForest's paths have a space that forwards everything to the one that it was given, and is of
/// another type: this gives that one, and any other space itself.
const ompl::base::StateSpace& unwrapped(const ompl::base::StateSpace& space);

/// States are cast to the layout of makeStateSpace, so another space would be read as garbage; and
/// the certified motion is the interpolation of its spaces. Throws std::invalid_argument unless
/// `space` has that layout, has the same variables if makeStateSpace built it, and consists of
/// OMPL's own spaces or makeStateSpace's: not of spaces derived from them, nor of Dubins', Reeds
/// and Shepp's, or constrained ones. Of a space of CForest's the one behind it counts.
void requireSpaceOf(const Checker& checker, const ompl::base::StateSpace& space);

/// The checker itself. Throws std::invalid_argument for null or as above.
std::shared_ptr<const Checker> requireChecker(std::shared_ptr<const Checker> checker,
                                              const ompl::base::StateSpace& space);

}  // namespace swept::detail
