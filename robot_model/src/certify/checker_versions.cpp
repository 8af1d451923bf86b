// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "certify/waypoint_segments.hpp"
#include "certify/workspace_data.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

namespace {

[[noreturn]] void failUnknown(const std::string& what, std::string_view name) {
  throw std::invalid_argument("Checker: there is no " + what + " '" + std::string(name) + "'");
}

/// Empty where no pose is known.
std::optional<Eigen::Isometry3d> poseOf(const detail::CheckerModel& model,
                                        const detail::CollisionBody& collisionBody,
                                        std::span<const double> q) {
  const detail::KinematicModel& kinematics = model.kinematics;
  std::vector<double> whole(model.world->obstacles().empty() ? 0 : kinematics.fullDimension);
  const std::span<const double> at = detail::fullConfiguration(model, q, whole);
  std::vector<detail::JointMotion> motion(kinematics.bodies.size());
  std::vector<detail::BodyState> states(kinematics.bodies.size());
  if (!detail::compileMotion(kinematics, at, at, motion)) return std::nullopt;
  for (std::size_t i = 1; i < states.size(); ++i)
    detail::evaluateBody(kinematics, motion, 0.0, static_cast<int>(i), states);
  return states[collisionBody.body].world_from_body * collisionBody.body_from_frame;
}

}  // namespace

Checker Checker::version(std::shared_ptr<const World> world, CheckerOptions options) const {
  return Checker(detail::compileChecker(model_->robot, model_->group, std::move(world),
                                        std::move(options), model_.get()));
}

Checker Checker::withWorld(std::shared_ptr<const World> next) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return withWorld(std::move(next)); });
  }
  if (!next) throw std::invalid_argument("Checker: the world must not be null");
  CheckerOptions changed = options();
  // A link may have the name of a world body. Rules that name both still apply.
  const auto isNamed = [&](std::string_view name) {
    return robot().findLink(name).has_value() || next->find(name) != nullptr ||
           next->findObstacle(name) != nullptr;
  };
  const auto forget = [&](const auto& bodies) {
    for (const auto& body : bodies)
      if (!isNamed(body.name)) changed.rules = changed.rules.without(body.name);
  };
  if (!changed.rules.empty()) {
    forget(world().bodies());
    forget(world().obstacles());
  }
  return version(std::move(next), std::move(changed));
}

Checker Checker::withBody(WorldBody body) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return withBody(std::move(body)); });
  }
  World next = world();
  next.add(std::move(body));
  return withWorld(std::make_shared<const World>(std::move(next)));
}

Checker Checker::withBody(std::string name, Shape shape,
                          const Eigen::Isometry3d& world_from_shape) const {
  World next = world();
  next.add(std::move(name), std::move(shape), world_from_shape);
  return withWorld(std::make_shared<const World>(std::move(next)));
}

Checker Checker::withReplaced(WorldBody body) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return withReplaced(std::move(body)); });
  }
  World next = world();
  next.replace(std::move(body));
  return withWorld(std::make_shared<const World>(std::move(next)));
}

Checker Checker::withReplaced(std::string name, Shape shape,
                              const Eigen::Isometry3d& world_from_shape) const {
  World next = world();
  next.replace(std::move(name), std::move(shape), world_from_shape);
  return withWorld(std::make_shared<const World>(std::move(next)));
}

Checker Checker::withObstacle(MovingObstacle obstacle) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return withObstacle(std::move(obstacle)); });
  }
  World next = world();
  next.add(std::move(obstacle));
  return withWorld(std::make_shared<const World>(std::move(next)));
}

Checker Checker::withoutBody(std::string_view name) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, name] { return withoutBody(name); });
  }
  World next = world();
  if (!next.remove(name)) failUnknown("body of the world", name);
  return withWorld(std::make_shared<const World>(std::move(next)));
}

Checker Checker::withAttached(AttachedBody body) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return withAttached(std::move(body)); });
  }
  CheckerOptions changed = options();
  changed.attached.push_back(std::move(body));
  return version(model_->world, std::move(changed));
}

Checker Checker::withAttached(std::string name, std::string link, Shape shape,
                              const Eigen::Isometry3d& link_from_shape,
                              std::vector<std::string> touchLinks) const {
  AttachedBody body{std::move(name), std::move(link), {}, std::move(touchLinks)};
  body.parts.push_back({std::move(shape), link_from_shape});
  return withAttached(std::move(body));
}

Checker Checker::withoutAttached(std::string_view name) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, name] { return withoutAttached(name); });
  }
  CheckerOptions changed = options();
  const auto named = [name](const AttachedBody& body) { return body.name == name; };
  if (std::erase_if(changed.attached, named) == 0) failUnknown("attached body", name);
  changed.rules = changed.rules.without(name);
  return version(model_->world, std::move(changed));
}

Checker Checker::withRules(CollisionRules rules) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return withRules(std::move(rules)); });
  }
  CheckerOptions changed = options();
  changed.rules = std::move(rules);
  return version(model_->world, std::move(changed));
}

/// What is proven once for all values within the limits depends on the tube.
Checker Checker::withTracking(TrackingTolerance tracking) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return withTracking(std::move(tracking)); });
  }
  CheckerOptions changed = options();
  changed.tracking = std::move(tracking);
  return Checker(
      detail::compileChecker(model_->robot, model_->group, model_->world, std::move(changed)));
}

Checker Checker::withConstraints(TaskConstraint constraints) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return withConstraints(std::move(constraints)); });
  }
  CheckerOptions changed = options();
  changed.constraints = std::move(constraints);
  return version(model_->world, std::move(changed));
}

WorldBody Checker::detachedBody(std::string_view attached, ConfigurationView q) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, attached, q] { return detachedBody(attached, q); });
  }
  requireSize(q);
  const auto body = std::ranges::find(options().attached, attached, &AttachedBody::name);
  if (body == options().attached.end()) failUnknown("attached body", attached);
  const auto collisionBody =
      std::ranges::find(model_->collisionBodies, attached, &detail::CollisionBody::name);
  const std::optional<Eigen::Isometry3d> world_from_frame = poseOf(*model_, *collisionBody, q);
  if (!world_from_frame) {
    throw std::invalid_argument("Checker: no pose of '" + std::string(attached) +
                                "' is known in a configuration that is not finite");
  }
  WorldBody result{.name = body->name, .parts = {}};
  for (const AttachedBody::Part& part : body->parts)
    result.parts.push_back({part.shape, *world_from_frame * part.link_from_shape});
  return result;
}

}  // namespace swept
