// SPDX-License-Identifier: BSD-3-Clause
#include "constraints/constraint_task.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "kinematics/lever_arms.hpp"
#include "kinematics/rigid_transform.hpp"
#include "robot/joint_types.hpp"
#include "swept/core/axis_frame.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;

constexpr double kHalfTurn = std::numbers::pi;

class TaskCompiler {
 public:
  explicit TaskCompiler(const Checker& checker)
      : checker_(checker),
        robot_(checker.robot()),
        held_(checker.options().reference.value_or(checker.robot().defaultState())) {
    task_.kinematics = compileKinematics(robot_, checker.group(), held_);
    task_.freedom = degreesOfFreedom(robot_, checker.group());
    for (const int index : checker.group().variables)
      task_.variables.push_back(robot_.variables()[index].name);
  }

  ConstraintTask run() {
    const TaskConstraint& given = checker_.options().constraints;
    for (const JointConstraint& own : given.joints) addJoint(own);
    for (const PositionConstraint& own : given.positions) addRegions(own);
    for (const OrientationConstraint& own : given.orientations) addAngles(own);
    for (const AxisConstraint& own : given.axes) addTilt(own);
    task_.bodies.assign(needed_.begin(), needed_.end());
    if (longest_ > 0.0 && std::isfinite(longest_)) task_.scale = longest_;
    return std::move(task_);
  }

 private:
  void add(ConstraintPart part) {
    if (part.rows == 0) return;
    part.firstRow = task_.rows;
    task_.rows += part.rows;
    task_.parts.push_back(std::move(part));
  }

  std::pair<int, Isometry3d> placed(const ConstraintFrame& frame) const {
    const Isometry3d own = orthonormalized(frame.body_from_frame);
    if (frame.body.empty()) return {0, own};
    std::optional<int> link = robot_.findLink(frame.body);
    if (!link) {
      const auto& attached = checker_.options().attached;
      link = robot_.findLink(std::ranges::find(attached, frame.body, &AttachedBody::name)->link);
    }
    const auto index = static_cast<std::size_t>(*link);
    return {task_.kinematics.bodyOfLink[index], task_.kinematics.body_from_link[index] * own};
  }

  std::vector<int> pathOf(int body) const {
    std::vector<int> path;
    for (int i = body; i > 0; i = task_.kinematics.bodies[static_cast<std::size_t>(i)].parent)
      path.push_back(i);
    std::ranges::reverse(path);
    return path;
  }

  FramePair pairOf(const ConstraintFrame& frame, const ConstraintFrame& reference) {
    FramePair pair;
    std::tie(pair.tool, pair.tool_from_frame) = placed(frame);
    std::tie(pair.reference, pair.reference_from_frame) = placed(reference);
    pair.toolPath = pathOf(pair.tool);
    pair.referencePath = pathOf(pair.reference);
    for (const auto* path : {&pair.toolPath, &pair.referencePath})
      needed_.insert(path->begin(), path->end());
    const auto [a, b] = std::ranges::mismatch(pair.toolPath, pair.referencePath);
    pair.toolPath.erase(pair.toolPath.begin(), a);
    pair.referencePath.erase(pair.referencePath.begin(), b);
    return pair;
  }

  void addJoint(const JointConstraint& own) {
    JointPart part{.position = own.position,
                   .middle = 0.5 * (own.above - own.below),
                   .tolerance = 0.5 * (own.above + own.below)};
    std::optional<int> joint = robot_.findJoint(own.joint);
    int place = 0;
    if (!joint) {
      const int variable = *robot_.findVariable(own.joint);
      joint = robot_.variables()[static_cast<std::size_t>(variable)].joint;
      place = variable - robot_.joints()[static_cast<std::size_t>(*joint)].firstVariable;
    }
    const Joint& found = robot_.joints()[static_cast<std::size_t>(*joint)];
    part.slides = isLength(found.type, place);
    part.cyclic =
        found.type == JointType::Continuous || (found.type == JointType::Planar && place == 2);
    const auto& bodies = task_.kinematics.bodies;
    const auto body = std::ranges::find(bodies, *joint, &MovingBody::joint);
    if (body != bodies.end()) {
      part.variable = body->variable + place;
      part.degree = task_.freedom.degreeOf[static_cast<std::size_t>(part.variable)];
      part.multiplier = body->multiplier;
      part.offset = body->offset;
    } else {
      const Joint& source =
          found.mimic ? robot_.joints()[static_cast<std::size_t>(found.mimic->master)] : found;
      part.offset = held_[source.firstVariable + place];
      if (found.mimic) part.offset = found.mimic->multiplier * part.offset + found.mimic->offset;
    }
    // A tolerance that a cyclic value cannot leave limits nothing.
    const bool isLimited =
        std::isfinite(part.tolerance) && !(part.cyclic && part.tolerance >= kHalfTurn);
    add({.what = part, .rows = isLimited ? 1 : 0});
  }

  void addRegions(const PositionConstraint& own) {
    RegionsPart part{.frames = pairOf(own.frame, own.reference), .regions = own.regions};
    for (ConstraintRegion& region : part.regions)
      region.reference_from_region = orthonormalized(region.reference_from_region);
    for (const auto& [body, place] :
         {std::pair{part.frames.tool, part.frames.tool_from_frame},
          std::pair{part.frames.reference, part.frames.reference_from_frame}}) {
      const LeverArms levers = leverArms(task_.kinematics, body, place.translation(), 0.0);
      for (const double arm : levers.arms) longest_ = std::max(longest_, arm);
    }
    add({.what = std::move(part), .rows = 3});
  }

  void addAngles(const OrientationConstraint& own) {
    AnglesPart part{.frames = pairOf(own.frame, own.reference),
                    .parameterization = own.parameterization,
                    .desired = own.orientation.normalized().toRotationMatrix(),
                    .limited = {},
                    .tolerance = own.tolerance};
    for (int i = 0; i < 3; ++i)
      if (own.tolerance[i] < kHalfTurn) part.limited.push_back(i);
    const int rows = static_cast<int>(part.limited.size());
    add({.what = std::move(part), .rows = rows});
  }

  void addTilt(const AxisConstraint& own) {
    TiltPart part{.frames = pairOf(own.frame, own.reference),
                  .axis = own.axis.normalized(),
                  .tolerance = own.angle};
    part.frames.reference_from_frame.linear() *= axisFrame(own.direction);
    add({.what = std::move(part), .rows = own.angle < kHalfTurn ? 2 : 0});
  }

  const Checker& checker_;
  const Robot& robot_;
  const Eigen::VectorXd held_;
  ConstraintTask task_;
  std::set<int> needed_;
  double longest_ = 0.0;  ///< m, of all lever arms
};

}  // namespace

ConstraintTask compileTask(const Checker& checker) {
  return TaskCompiler(checker).run();
}

}  // namespace swept::detail
