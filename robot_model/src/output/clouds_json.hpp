// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <variant>

#include "output/text_output.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {

/// Calls `visit` with each body of the world that has a cloud, and the cloud.
template <typename Visit>
void forEachCloud(const World& world, const Visit& visit) {
  for (const WorldBody& body : world.bodies()) {
    const auto boxes = std::ranges::count_if(body.parts, [](const WorldBody::Part& part) {
      return std::holds_alternative<Box>(part.shape);
    });
    for (const WorldBody::Part& part : body.parts) {
      if (const auto* cloud = std::get_if<PointCloud>(&part.shape)) visit(body, *cloud, boxes);
    }
  }
}

/// What a proof in this world is a proof for, where it has clouds: a line per body; else empty.
std::string cloudsText(const World& world);

/// The bodies of a world that have clouds, with their balls.
Json cloudsJson(const World& world);

}  // namespace swept
