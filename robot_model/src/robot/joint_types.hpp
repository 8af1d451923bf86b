// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "swept/robot_model/robot.hpp"

/// The properties of each joint type. Each function is a switch over all types, so a new type does
/// not compile until all of them are defined.
namespace swept::detail {

/// Number of values of a joint that mimics none.
constexpr int valueCount(JointType type) {
  switch (type) {
    case JointType::Fixed:
      return 0;
    case JointType::Revolute:
    case JointType::Continuous:
    case JointType::Prismatic:
      return 1;
    case JointType::Planar:
      return 3;
    case JointType::Floating:
      break;
  }
  return 7;
}

/// Index of the first of four values that are a quaternion: x, y, z, w.
constexpr std::optional<int> quaternionPlace(JointType type) {
  switch (type) {
    case JointType::Floating:
      return 3;
    case JointType::Fixed:
    case JointType::Revolute:
    case JointType::Continuous:
    case JointType::Prismatic:
    case JointType::Planar:
      break;
  }
  return std::nullopt;
}

/// Whether the value at this index is in metres.
constexpr bool isLength(JointType type, int place) {
  switch (type) {
    case JointType::Prismatic:
      return true;
    case JointType::Planar:
      return place < 2;
    case JointType::Floating:
      return place < 3;
    case JointType::Fixed:
    case JointType::Revolute:
    case JointType::Continuous:
      break;
  }
  return false;
}

/// Whether a URDF gives the axis that the joint moves along or about.
constexpr bool hasAxis(JointType type) {
  switch (type) {
    case JointType::Revolute:
    case JointType::Continuous:
    case JointType::Prismatic:
    case JointType::Planar:
      return true;
    case JointType::Fixed:
    case JointType::Floating:
      break;
  }
  return false;
}

/// Whether a URDF gives limits of the joint.
constexpr bool hasLimits(JointType type) {
  switch (type) {
    case JointType::Revolute:
    case JointType::Prismatic:
      return true;
    case JointType::Fixed:
    case JointType::Continuous:
    case JointType::Planar:
    case JointType::Floating:
      break;
  }
  return false;
}

/// Whether the joint only turns, about an axis that is fixed in the parent.
constexpr bool turns(JointType type) {
  switch (type) {
    case JointType::Revolute:
    case JointType::Continuous:
      return true;
    case JointType::Fixed:
    case JointType::Prismatic:
    case JointType::Planar:
    case JointType::Floating:
      break;
  }
  return false;
}

/// Whether the joint only slides, along an axis that is fixed in the parent, and within limits.
constexpr bool slidesWithinLimits(JointType type) {
  switch (type) {
    case JointType::Prismatic:
      return true;
    case JointType::Fixed:
    case JointType::Revolute:
    case JointType::Continuous:
    case JointType::Planar:
    case JointType::Floating:
      break;
  }
  return false;
}

/// Whether the joint lets a body slide without limits.
constexpr bool slidesFreely(JointType type) {
  switch (type) {
    case JointType::Planar:
    case JointType::Floating:
      return true;
    case JointType::Fixed:
    case JointType::Revolute:
    case JointType::Continuous:
    case JointType::Prismatic:
      break;
  }
  return false;
}

}  // namespace swept::detail
