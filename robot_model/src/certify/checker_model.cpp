// SPDX-License-Identifier: BSD-3-Clause
#include "certify/checker_model.hpp"

#include <algorithm>
#include <map>

#include "swept/core/distance.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

using LinkPair = std::pair<int, int>;

LinkPair ordered(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

/// m, from the shape's origin to an unbounded shape's boundary.
double planeOffset(const Shape& shape) {
  if (const auto* plane = std::get_if<Plane>(&shape)) return std::abs(plane->offset);
  if (const auto* halfSpace = std::get_if<HalfSpace>(&shape)) return std::abs(halfSpace->offset);
  return 0.0;
}

class Compiler {
 public:
  Compiler(std::shared_ptr<const Robot> robot, const Group& group,
           std::shared_ptr<const World> world, const CheckerOptions& options) {
    model_.group = group;
    model_.options = options;
    if (!model_.options.reference) model_.options.reference = robot->defaultState();
    model_.kinematics = compileKinematics(*robot, group, *model_.options.reference);
    model_.robot = std::move(robot);
    model_.world = std::move(world);
  }

  std::shared_ptr<const CheckerModel> compile(const CheckerModel* like) {
    collectRobot();
    collectWorld();
    pairWithWorld();
    pairLinks();
    model_.lanes = compileLanes(model_, like != nullptr ? &like->lanes : nullptr);
    return std::make_shared<const CheckerModel>(std::move(model_));
  }

 private:
  void collectRobot() {
    for (std::size_t i = 0; i < model_.robot->links().size(); ++i) {
      for (const CollisionGeometry& piece : model_.robot->links()[i].collision) {
        RobotGeometry geometry;
        geometry.link = static_cast<int>(i);
        geometry.body = model_.kinematics.bodyOfLink[i];
        geometry.shape = piece.shape;
        geometry.body_from_shape = model_.kinematics.body_from_link[i] * piece.link_from_shape;
        const BoundingSphere ball = boundingSphere(piece.shape);
        geometry.center = geometry.body_from_shape * ball.center;
        geometry.radius = ball.radius;
        geometry.cover = piece.cover;
        geometry.levers = leverArms(model_.kinematics, geometry.body, geometry.center, ball.radius);
        model_.robotGeometry.push_back(std::move(geometry));
      }
    }
  }

  void collectWorld() {
    for (std::size_t i = 0; i < model_.world->bodies().size(); ++i) {
      for (const WorldBody::Part& part : model_.world->bodies()[i].parts) {
        WorldGeometry geometry;
        geometry.body = static_cast<int>(i);
        geometry.shape = part.shape;
        geometry.world_from_shape = part.world_from_shape;
        const Aabb box = boundingBox(part.shape);
        const bool bounded = (box.upper - box.lower).allFinite();
        const Vector3d middle =
            bounded ? Vector3d(0.5 * (box.lower + box.upper)) : Vector3d::Zero();
        Isometry3d world_from_box = part.world_from_shape;
        world_from_box.translation() = part.world_from_shape * middle;
        geometry.box_from_world = world_from_box.inverse();
        geometry.halfExtents = box.upper - middle;
        geometry.magnitude = world_from_box.translation().norm() +
                             (bounded ? geometry.halfExtents.norm() : planeOffset(part.shape));
        model_.worldGeometry.push_back(std::move(geometry));
      }
    }
  }

  /// Rounding of the relative pose of two geometries, in metres at their points: proportional to
  /// the coordinates and to the number of joints that were multiplied.
  double rounding(double magnitudes, std::size_t joints) const {
    return tolerance::kRoundingPerJoint * magnitudes * static_cast<double>(joints + 2);
  }

  int travelSlot(int geometry, int reference) {
    const LeverArms& levers = model_.robotGeometry[geometry].levers;
    std::size_t first = 0;
    while (first < levers.path.size() && reference != 0 && levers.path[first] != reference) ++first;
    if (reference != 0) ++first;  // the joints after the reference body
    const auto known = slots_.find({geometry, first});
    if (known != slots_.end()) return known->second;
    const int slot = static_cast<int>(model_.travels.size());
    model_.travels.push_back({geometry, first});
    slots_.emplace(std::pair{geometry, first}, slot);
    return slot;
  }

  std::string linkName(int link) const { return model_.robot->links()[link].name; }
  std::string worldName(int body) const { return model_.world->bodies()[body].name; }

  /// Farthest any point of the geometry gets from its first moving joint, if that is bounded.
  bool outOfReach(const RobotGeometry& robot, const WorldGeometry& world) const {
    for (const int i : robot.levers.path) {
      const JointType type = model_.kinematics.bodies[i].type;
      if (type == JointType::Planar || type == JointType::Floating) return false;
    }
    const MovingBody& base = model_.kinematics.bodies[robot.levers.path.front()];
    const Vector3d center = world.box_from_world * base.parent_from_joint.translation();
    const Vector3d outside = (center.cwiseAbs() - world.halfExtents).cwiseMax(Vector3d::Zero());
    const double slack = rounding(robot.levers.reach + world.magnitude, robot.levers.path.size());
    return outside.norm() > robot.levers.reachFromBase + model_.options.margin + slack;
  }

  void pairWithWorld() {
    // Grouped by link and body, so that each pair of bodies is listed once.
    std::map<std::pair<int, int>, bool> reachable;
    std::map<std::pair<int, int>, bool> standing;
    for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i) {
      const RobotGeometry& robot = model_.robotGeometry[i];
      for (std::size_t j = 0; j < model_.worldGeometry.size(); ++j) {
        const WorldGeometry& world = model_.worldGeometry[j];
        if (robot.body == 0) {
          bool& touching = standing.try_emplace({robot.link, world.body}, false).first->second;
          touching = touching || touch(robot.shape, world.shape,
                                       robot.body_from_shape.inverse() * world.world_from_shape);
          continue;
        }
        const bool far = outOfReach(robot, world);
        bool& some = reachable.try_emplace({robot.link, world.body}, false).first->second;
        some = some || !far;
        if (far) continue;
        GeometryPair pair;
        pair.a = static_cast<int>(i);
        pair.b = static_cast<int>(j);
        pair.travelA = travelSlot(pair.a, 0);
        pair.rounding = rounding(robot.levers.reach + world.magnitude, robot.levers.path.size());
        model_.pairs.push_back(pair);
      }
    }
    for (const auto& [key, some] : reachable) {
      Checker::Pair pair{linkName(key.first), worldName(key.second), false, ""};
      if (!some) pair.reason = "out of reach";
      (some ? model_.checkedPairs : model_.skippedPairs).push_back(std::move(pair));
    }
    for (const auto& [key, touching] : standing) {
      Checker::Pair pair{linkName(key.first), worldName(key.second), false,
                         "not moved by the group"};
      if (touching) model_.standingContacts.push_back(pair);
      model_.skippedPairs.push_back(std::move(pair));
    }
  }

  static bool touch(const Shape& a, const Shape& b, const Isometry3d& a_from_b) {
    return collide(a, b, a_from_b) != Contact::Separate;
  }

  int lastCommonAncestor(int a, int b) const {
    while (a != b) {
      // Parents have smaller indices than their children.
      if (a > b) {
        a = model_.kinematics.bodies[a].parent;
      } else {
        b = model_.kinematics.bodies[b].parent;
      }
    }
    return a;
  }

  void pairLinks() {
    std::map<LinkPair, std::string> disabled;
    for (const Joint& joint : model_.robot->joints()) {
      if (joint.parentLink < 0) continue;
      disabled.emplace(ordered(joint.parentLink, joint.childLink), "adjacent: joint " + joint.name);
    }
    for (const DisabledPair& pair : model_.robot->disabledPairs()) {
      disabled.emplace(ordered(pair.linkA, pair.linkB), "SRDF: " + pair.reason);
    }
    std::map<LinkPair, Checker::Pair> listed;
    std::map<LinkPair, bool> touching;
    const int count = static_cast<int>(model_.robotGeometry.size());
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j) {
        const RobotGeometry& a = model_.robotGeometry[i];
        const RobotGeometry& b = model_.robotGeometry[j];
        if (a.link == b.link) continue;
        const LinkPair links = ordered(a.link, b.link);
        Checker::Pair pair{linkName(links.first), linkName(links.second), true, ""};
        const auto off = disabled.find(links);
        if (off != disabled.end()) {
          pair.reason = off->second;
        } else if (a.body == b.body) {
          pair.reason = "rigid: the group does not change their relative pose";
          bool& some = touching[links];
          some = some || touch(a.shape, b.shape, a.body_from_shape.inverse() * b.body_from_shape);
        } else {
          addSelfPair(i, j);
        }
        listed.emplace(links, std::move(pair));
      }
    }
    for (const auto& [links, pair] : listed) {
      if (touching[links]) model_.standingContacts.push_back(pair);
      (pair.reason.empty() ? model_.checkedPairs : model_.skippedPairs).push_back(pair);
    }
  }

  void addSelfPair(int i, int j) {
    const RobotGeometry& a = model_.robotGeometry[i];
    const RobotGeometry& b = model_.robotGeometry[j];
    GeometryPair pair;
    pair.self = true;
    pair.a = i;
    pair.b = j;
    pair.reference = lastCommonAncestor(a.body, b.body);
    pair.travelA = travelSlot(i, pair.reference);
    pair.travelB = travelSlot(j, pair.reference);
    pair.rounding =
        rounding(a.levers.reach + b.levers.reach, a.levers.path.size() + b.levers.path.size());
    model_.pairs.push_back(pair);
  }

  CheckerModel model_;
  std::map<std::pair<int, std::size_t>, int> slots_;
};

}  // namespace

std::string CheckerModel::nameOfA(const GeometryPair& pair) const {
  return robot->links()[robotGeometry[pair.a].link].name;
}

std::string CheckerModel::nameOfB(const GeometryPair& pair) const {
  return pair.self ? robot->links()[robotGeometry[pair.b].link].name
                   : world->bodies()[worldGeometry[pair.b].body].name;
}

std::shared_ptr<const CheckerModel> compileChecker(std::shared_ptr<const Robot> robot,
                                                   const Group& group,
                                                   std::shared_ptr<const World> world,
                                                   const CheckerOptions& options,
                                                   const CheckerModel* like) {
  return Compiler(std::move(robot), group, std::move(world), options).compile(like);
}

WorkspaceData::WorkspaceData(const CheckerModel& model)
    : motion(model.kinematics.bodies.size()),
      states(model.kinematics.bodies.size()),
      stateStamps(model.kinematics.bodies.size(), -1),
      placed(model.robotGeometry.size()),
      travels(model.travels.size()),
      travelStamps(model.travels.size(), -1),
      hints(model.pairs.size(), Eigen::Vector3d::Zero()),
      hintStamps(model.pairs.size(), -1),
      lanes(model.lanes) {}

}  // namespace swept::detail
