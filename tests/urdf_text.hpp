// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Elements of a URDF, for robots that are made up on the spot.
namespace swept::test {

/// `rest`: what else the joint has, such as limited().
inline std::string joint(const std::string& name, const std::string& type,
                         const std::string& parent, const std::string& child,
                         const std::string& rest) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + rest + "</joint>\n";
}

/// Axis and limits (rad or m).
inline std::string limited(const std::string& axis, double lower, double upper) {
  return "<axis xyz='" + axis + "'/><limit lower='" + std::to_string(lower) + "' upper='" +
         std::to_string(upper) + "' effort='1' velocity='1'/>";
}

}  // namespace swept::test
