// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "swept/robot_model/robot.hpp"

/// What the joints of each type have and do. Each function is a switch over all types, so that a new
/// type does not compile before all of this is said of it.
namespace swept::detail {

/// How many values a joint has that mimics none.
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

/// The place of the first of four values that are a quaternion: x, y, z, w.
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

/// The value at this place is in metres.
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

/// A URDF says along or about what the joint moves.
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

/// A URDF says how far the joint goes.
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

/// The joint only turns, about an axis that is fixed in the parent.
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

/// The joint only slides, along an axis that is fixed in the parent, and within limits.
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

/// The joint lets a body slide without limits.
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
