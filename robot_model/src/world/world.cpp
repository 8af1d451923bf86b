// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "kinematics/rigid_transform.hpp"
#include "robot/shape_cover.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "world/obstacle_pose.hpp"

namespace swept {

using detail::isRigid;
using detail::orthonormalized;

namespace {

WorldBody bodyOf(std::string name, Shape shape, const Eigen::Isometry3d& world_from_shape) {
  WorldBody body;
  body.name = std::move(name);
  body.parts.push_back({std::move(shape), world_from_shape});
  return body;
}

void makeRigid(WorldBody& body) {
  for (WorldBody::Part& part : body.parts) {
    if (!isRigid(part.world_from_shape)) {
      throw std::invalid_argument("World: a pose of body '" + body.name +
                                  "' is no finite rigid transform");
    }
    part.world_from_shape = orthonormalized(part.world_from_shape);
  }
}

/// Adds both or, if memory runs out, neither: a place without a body would be read.
template <typename Body, typename Places>
void append(Body body, std::vector<Body>& all, Places& places) {
  const auto place = places.emplace(body.name, all.size()).first;
  try {
    all.push_back(std::move(body));
  } catch (...) {
    places.erase(place);
    throw;
  }
}

/// Returns false if none has this name.
template <typename Body, typename Places>
bool removeNamed(std::string_view name, std::vector<Body>& all, Places& places) {
  const auto found = places.find(name);
  if (found == places.end()) return false;
  const std::size_t gone = found->second;
  places.erase(found);
  for (auto& [other, place] : places)
    if (place > gone) --place;
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(gone));
  return true;
}

}  // namespace

void World::requireFree(const std::string& name) const {
  if (find(name) != nullptr || findObstacle(name) != nullptr) {
    throw std::invalid_argument("World: a second body is named '" + name + "'");
  }
}

void World::add(WorldBody body) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return add(std::move(body)); });
  }
  requireFree(body.name);
  makeRigid(body);
  append(std::move(body), bodies_, placeOfBody_);
}

void World::add(std::string name, Shape shape, const Eigen::Isometry3d& world_from_shape) {
  add(bodyOf(std::move(name), std::move(shape), world_from_shape));
}

void World::add(MovingObstacle obstacle) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return add(std::move(obstacle)); });
  }
  requireFree(obstacle.name);
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument("World: obstacle '" + obstacle.name + "' " + what);
  };
  for (MovingObstacle::Part& part : obstacle.parts) {
    if (!isRigid(part.body_from_shape)) fail("has a part whose pose is no finite rigid transform");
    part.body_from_shape = orthonormalized(part.body_from_shape);
    if (!detail::isBounded(part.shape)) fail("has a plane or a half-space, which cannot move");
  }
  if (obstacle.waypoints.empty()) fail("has no waypoint");
  for (std::size_t i = 0; i < obstacle.waypoints.size(); ++i) {
    MovingObstacle::Waypoint& waypoint = obstacle.waypoints[i];
    const std::string which = "has a waypoint, number " + std::to_string(i + 1);
    if (!std::isfinite(waypoint.time)) fail(which + ", whose time is not finite");
    if (i > 0 && !(waypoint.time > obstacle.waypoints[i - 1].time))
      fail(which + ", that is not later than the one before");
    if (!isRigid(waypoint.world_from_body))
      fail(which + ", whose pose is no finite rigid transform");
    waypoint.world_from_body = orthonormalized(waypoint.world_from_body);
  }
  append(std::move(obstacle), obstacles_, placeOfObstacle_);
}

void World::replace(WorldBody body) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return replace(std::move(body)); });
  }
  const auto old = placeOfBody_.find(body.name);
  if (old == placeOfBody_.end())
    throw std::invalid_argument("World: there is no body '" + body.name + "' to replace");
  makeRigid(body);
  bodies_[old->second] = std::move(body);
}

void World::replace(std::string name, Shape shape, const Eigen::Isometry3d& world_from_shape) {
  replace(bodyOf(std::move(name), std::move(shape), world_from_shape));
}

bool World::remove(std::string_view name) {
  return removeNamed(name, bodies_, placeOfBody_) ||
         removeNamed(name, obstacles_, placeOfObstacle_);
}

const WorldBody* World::find(std::string_view name) const {
  const auto found = placeOfBody_.find(name);
  return found == placeOfBody_.end() ? nullptr : &bodies_[found->second];
}

const MovingObstacle* World::findObstacle(std::string_view name) const {
  const auto found = placeOfObstacle_.find(name);
  return found == placeOfObstacle_.end() ? nullptr : &obstacles_[found->second];
}

Eigen::Isometry3d MovingObstacle::poseAt(double time) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, time] { return poseAt(time); });
  }
  return detail::obstaclePose(*this, time).world_from_body;
}

namespace detail {

ObstaclePose obstaclePose(const MovingObstacle& obstacle, double time) {
  const auto& waypoints = obstacle.waypoints;
  const auto after = std::ranges::upper_bound(waypoints, time, {}, &MovingObstacle::Waypoint::time);
  if (after == waypoints.begin()) return {waypoints.front().world_from_body, 0.0};
  const MovingObstacle::Waypoint& first = *std::prev(after);
  if (after == waypoints.end() || time == first.time) return {first.world_from_body, 0.0};
  const double share = (time - first.time) / (after->time - first.time);
  const Eigen::Vector3d begin = first.world_from_body.translation();
  const Eigen::Vector3d end = after->world_from_body.translation();
  const Eigen::Quaterniond turn(first.world_from_body.linear());
  ObstaclePose pose;
  pose.world_from_body.translation() = begin + share * (end - begin);
  pose.world_from_body.linear() =
      turn.slerp(share, Eigen::Quaterniond(after->world_from_body.linear())).toRotationMatrix();
  pose.magnitude = std::max(begin.cwiseAbs().maxCoeff(), end.cwiseAbs().maxCoeff());
  return pose;
}

}  // namespace detail

}  // namespace swept
