// SPDX-License-Identifier: BSD-3-Clause
#include "output/robot_json.hpp"

namespace swept {

std::string_view toString(JointType type) {
  switch (type) {
    case JointType::Fixed:
      return "fixed";
    case JointType::Revolute:
      return "revolute";
    case JointType::Continuous:
      return "continuous";
    case JointType::Prismatic:
      return "prismatic";
    case JointType::Planar:
      return "planar";
    case JointType::Floating:
      return "floating";
  }
  return "unknown";
}

Json variableJson(const Variable& variable) {
  return {{"name", variable.name},
          {"lower", finiteOrNull(variable.lower)},
          {"upper", finiteOrNull(variable.upper)},
          {"cyclic", variable.cyclic}};
}

}  // namespace swept
