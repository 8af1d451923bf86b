// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "random.hpp"

namespace forgeries {

using Json = nlohmann::ordered_json;

/// What somebody changes who wants doubles to cancel, to overflow or to underflow.
enum class Field : std::uint8_t {
  Offset,      ///< a joint's multiplier and offset take each other back
  Value,       ///< both states are moved by a large number, and offset or origin back
  Origin,      ///< a joint's origin is moved, and what follows is moved back
  Shape,       ///< a shape's pose is moved, its coordinates back
  Wall,        ///< a plane's pose is moved, its offset back
  Body,        ///< all of a link's bodies are moved, its joint back
  Axis,        ///< directions as far from length 1 as is allowed
  Rotation,    ///< rotations as far from orthonormal as is allowed
  Turn,        ///< angles of many turns, half turns, or a long way
  Quaternion,  ///< lengths, signs and opposite orientations
  Size,        ///< radii, extents and lengths of other scales
  Rule,        ///< margin and paddings
  Extreme,     ///< any number of the model or the states, at the ends of what doubles can be
  Limit,       ///< limits
  Time,        ///< times of a trajectory: long, short, and of large numbers
  Rate,        ///< velocities and accelerations of a trajectory that take each other back
  Tube,        ///< what joints may be off, and limits near by
};
constexpr std::size_t kFields = 17;
constexpr std::array<std::string_view, kFields> kFieldNames = {
    "offset",     "value", "origin", "shape",   "wall",  "body", "axis", "rotation", "turn",
    "quaternion", "size",  "rule",   "extreme", "limit", "time", "rate", "tube"};

/// False where the path has nothing of the kind.
bool mutate(Json& path, Field field, Random& random);

}  // namespace forgeries
