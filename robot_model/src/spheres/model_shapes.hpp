// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "io/json_value.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/shape_model.hpp"

/// Shapes of models in files.
namespace swept::detail {

/// Throws std::invalid_argument for a shape that no file of a model has.
[[noreturn]] void refuseShape();

///@{
/// `type`, sizes and `pose`, as shapeModelJson() writes them; and [x, y, z, radius]. Reading throws
/// InputError.
Json shapeJson(const PosedShape& posed);
Json sphereJson(const EnclosingSphere& sphere);
PosedShape shapeOf(const JsonValue& value);
EnclosingSphere sphereOf(const JsonValue& value);
///@}

/// The figures of the report of this name, if there is one.
void addFigures(Json& entry, const std::string& name, const std::vector<LinkSphereReport>& reports);

/// A cylinder and the spheres at its ends, as they are written for a capsule, become one. The ends
/// that are written are off by rounding, so the capsule is that much thinner.
std::vector<PosedShape> withCapsules(const std::vector<PosedShape>& parts);

}  // namespace swept::detail
