// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <utility>

#include "io/scene.hpp"
#include "kinematics/motion_model.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

World readSceneUrdf(const std::filesystem::path& scene, const LoadOptions& options) {
  const std::shared_ptr<const Robot> robot = Robot::load(scene, {}, options);
  // A group that moves nothing: every link is fixed in the model frame.
  const KinematicModel still = compileKinematics(*robot, Group{}, robot->defaultState());
  World world;
  for (std::size_t i = 0; i < robot->links().size(); ++i) {
    const Link& link = robot->links()[i];
    if (link.collision.empty()) continue;
    WorldBody body{.name = link.name, .parts = {}};
    for (const CollisionGeometry& part : link.collision)
      body.parts.push_back({part.shape, still.body_from_link[i] * part.link_from_shape});
    world.add(std::move(body));
  }
  return world;
}

}  // namespace swept::detail
