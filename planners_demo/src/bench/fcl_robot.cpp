// SPDX-License-Identifier: BSD-3-Clause
#include "bench/fcl_robot.hpp"

#include <algorithm>

#include "swept/core/axis_frame.hpp"

namespace swept {
namespace {

/// One object against the world's tree.
struct WorldQuery {
  const fcl::CollisionRequestd* request;
  const WorldBody* bodies;
  const std::vector<bool>* checkedBodies;
  fcl::CollisionResultd result;
  bool hit = false;
};

/// Null for an object of the robot.
const WorldBody* bodyOf(const fcl::CollisionObjectd& object) {
  return static_cast<const WorldBody*>(object.getUserData());
}

}  // namespace

FclRobot::FclRobot(const Checker& checker) : checker_(checker) {
  const Robot& robot = checker.robot();
  values_ = checker.options().reference.value_or(robot.defaultState());
  moving_.assign(robot.links().size(), false);
  model_from_link_.assign(robot.links().size(), Eigen::Isometry3d::Identity());
  for (std::size_t j = 0; j < robot.joints().size(); ++j) {
    const Joint& joint = robot.joints()[j];
    const int master = joint.mimic ? joint.mimic->master : static_cast<int>(j);
    const bool driven =
        std::ranges::find(checker.group().joints, master) != checker.group().joints.end();
    if (driven || (joint.parentLink >= 0 && moving_[joint.parentLink])) {
      moving_[joint.childLink] = true;
      movingJoints_.push_back(j);
    }
    placeLink(j);
  }
  addLinkObjects();
  addWorld();
  addPairs();
  placeObjects(true);
}

void FclRobot::addLinkObjects() {
  const auto& links = checker_.robot().links();
  const std::vector<bool> none(checker_.world().bodies().size(), false);
  for (std::size_t i = 0; i < links.size(); ++i) {
    for (const CollisionGeometry& part : links[i].collision) {
      auto object = std::make_unique<fcl::CollisionObjectd>(fclGeometry(part.shape, links[i].name));
      object->setUserData(nullptr);  // FCL leaves it undefined
      objects_.push_back({.link = static_cast<int>(i),
                          .link_from_shape = part.link_from_shape,
                          .object = std::move(object),
                          .checkedBodies = none});
    }
  }
}

void FclRobot::addWorld() {
  const auto& bodies = checker_.world().bodies();
  std::vector<fcl::CollisionObjectd*> all;
  for (const WorldBody& body : bodies) {
    for (const WorldBody::Part& part : body.parts) {
      worldObjects_.push_back(std::make_unique<fcl::CollisionObjectd>(
          fclGeometry(part.shape, body.name), fcl::Transform3d(part.world_from_shape)));
      worldObjects_.back()->setUserData(const_cast<WorldBody*>(&body));  // only read
      worldObjects_.back()->computeAABB();
      all.push_back(worldObjects_.back().get());
    }
  }
  world_.registerObjects(all);
  world_.setup();
}

void FclRobot::addPairs() {
  const Robot& robot = checker_.robot();
  const auto& bodies = checker_.world().bodies();
  for (const Checker::Pair& pair : checker_.checkedPairs()) {
    const int linkA = robot.findLink(pair.bodyA).value();
    if (pair.selfPair) {
      const int linkB = robot.findLink(pair.bodyB).value();
      for (std::size_t a = 0; a < objects_.size(); ++a)
        for (std::size_t b = 0; b < objects_.size(); ++b)
          if (objects_[a].link == linkA && objects_[b].link == linkB) selfPairs_.emplace_back(a, b);
      continue;
    }
    const auto body = std::ranges::find(bodies, pair.bodyB, &WorldBody::name);
    for (LinkObject& object : objects_)
      if (object.link == linkA)
        object.checkedBodies[static_cast<std::size_t>(body - bodies.begin())] = true;
  }
}

Eigen::Isometry3d FclRobot::jointMotion(const Joint& joint) const {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (joint.type == JointType::Fixed) return motion;
  const Joint& source = joint.mimic ? checker_.robot().joints()[joint.mimic->master] : joint;
  const double* values = values_.data() + source.firstVariable;
  const double value =
      joint.mimic ? joint.mimic->multiplier * values[0] + joint.mimic->offset : values[0];
  switch (joint.type) {
    case JointType::Revolute:
    case JointType::Continuous:
      motion.linear() = Eigen::AngleAxisd(value, joint.axis).toRotationMatrix();
      break;
    case JointType::Prismatic:
      motion.translation() = value * joint.axis;
      break;
    case JointType::Planar: {
      motion.translation() = axisFrame(joint.axis) * Eigen::Vector3d(values[0], values[1], 0.0);
      motion.linear() = Eigen::AngleAxisd(values[2], joint.axis).toRotationMatrix();
      break;
    }
    case JointType::Floating:
      motion.translation() = Eigen::Vector3d(values[0], values[1], values[2]);
      motion.linear() = Eigen::Quaterniond(values[6], values[3], values[4], values[5])
                            .normalized()
                            .toRotationMatrix();
      break;
    case JointType::Fixed:
      break;
  }
  return motion;
}

void FclRobot::placeLink(std::size_t j) {
  const Joint& joint = checker_.robot().joints()[j];
  const Eigen::Isometry3d parent_from_child = joint.parent_from_joint * jointMotion(joint);
  model_from_link_[joint.childLink] = joint.parentLink < 0
                                          ? parent_from_child
                                          : model_from_link_[joint.parentLink] * parent_from_child;
}

void FclRobot::placeObjects(bool all) {
  for (LinkObject& object : objects_) {
    if (!all && !moving_[object.link]) continue;
    object.object->setTransform(model_from_link_[object.link] * object.link_from_shape);
    object.object->computeAABB();
  }
}

bool FclRobot::worldCallback(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  auto& query = *static_cast<WorldQuery*>(data);
  // The manager may hand over the two in either order; only the world's objects have a body.
  const WorldBody* body = bodyOf(*a) != nullptr ? bodyOf(*a) : bodyOf(*b);
  if (!(*query.checkedBodies)[static_cast<std::size_t>(body - query.bodies)]) return false;
  query.hit = fcl::collide(a, b, *query.request, query.result) > 0;
  return query.hit;
}

bool FclRobot::collides(std::span<const double> q) {
  const Group& group = checker_.group();
  for (std::size_t i = 0; i < q.size(); ++i) values_[group.variables[i]] = q[i];
  for (const std::size_t joint : movingJoints_) placeLink(joint);
  placeObjects(false);
  WorldQuery query{.request = &request_,
                   .bodies = checker_.world().bodies().data(),
                   .checkedBodies = nullptr,
                   .result = {}};
  for (LinkObject& object : objects_) {
    if (!moving_[object.link]) continue;
    query.checkedBodies = &object.checkedBodies;
    world_.collide(object.object.get(), &query, worldCallback);
    if (query.hit) return true;
  }
  for (const auto& [a, b] : selfPairs_) {
    fcl::CollisionObjectd& first = *objects_[a].object;
    fcl::CollisionObjectd& second = *objects_[b].object;
    if (!first.getAABB().overlap(second.getAABB())) continue;
    if (fcl::collide(&first, &second, request_, query.result) > 0) return true;
  }
  return false;
}

}  // namespace swept
