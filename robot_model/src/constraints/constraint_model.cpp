// SPDX-License-Identifier: BSD-3-Clause
#include "constraints/constraint_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "kinematics/rigid_transform.hpp"
#include "model/pair_model.hpp"
#include "robot/joint_types.hpp"
#include "swept/core/axis_frame.hpp"
#include "swept/core/tolerances.hpp"
#include "swept/robot_model/did_you_mean.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("Checker: constraint " + what);
}

/// Not negative, and a number. Infinity is one: it limits nothing.
void requireSize(double value, const std::string& what, const char* unit) {
  if (value >= 0.0) return;
  refuse(what + " " + formatNumber(value) + unit + ", which must be a number that is not negative");
}

Vector3d unitOf(const Vector3d& direction, const std::string& what) {
  const double length = direction.norm();
  if (!(length > 1e-9) || !std::isfinite(length)) refuse(what + " has no direction");
  return direction / length;
}

/// A frame in a moving body.
struct PlacedFrame {
  int body = 0;
  Isometry3d body_from_frame;
  double transforms = 0.0;  ///< multiplied into it
  double detour = 0.0;      ///< m, of these and of its own
};

class ConstraintCompiler {
 public:
  explicit ConstraintCompiler(const PairModel& model)
      : model_(model), kinematics_(model.kinematics), turning_(model.kinematics) {
    for (MovingBody& body : turning_.bodies) body.parent_from_joint.translation().setZero();
  }

  ConstraintModel run() {
    const TaskConstraint& task = model_.options.constraints;
    if (task.size() > kMostConstraints)
      throw std::invalid_argument("Checker: " + std::to_string(task.size()) +
                                  " constraints are more than " + std::to_string(kMostConstraints));
    using Kind = ConstraintViolation::Kind;
    const auto addAll = [this](Kind kind, const auto& list, const auto& compile) {
      for (std::size_t i = 0; i < list.size(); ++i)
        found_.constraints.push_back({kind, i, compile(list[i])});
    };
    addAll(Kind::Joint, task.joints, [this](const auto& own) { return jointRange(own); });
    addAll(Kind::Position, task.positions, [this](const auto& own) { return regions(own); });
    for (std::size_t i = 0; i < task.orientations.size(); ++i)
      addOrientation(task.orientations[i], i);
    addAll(Kind::Axis, task.axes, [this](const auto& own) { return tilt(own); });
    for (const ConstrainedLink& link : found_.links)
      for (const auto* path : {&link.toolPath, &link.referencePath})
        for (const int body : *path) need(body);
    return std::move(found_);
  }

 private:
  void need(int body) {
    found_.bodies = std::max(found_.bodies, static_cast<std::size_t>(body) + 1);
  }

  PlacedFrame placed(const ConstraintFrame& frame, const std::string& of) const {
    if (!isRigid(frame.body_from_frame)) refuse(of + " has a frame that is no rotation and place");
    PlacedFrame result;
    const Isometry3d own = orthonormalized(frame.body_from_frame);
    result.body_from_frame = own;
    result.transforms = 1.0;
    result.detour = own.translation().norm();
    if (frame.body.empty()) return result;
    const auto link = static_cast<std::size_t>(linkOf(frame.body, of));
    const FixedJointChain& chain = kinematics_.fixedChainOfLink[link];
    result.body = kinematics_.bodyOfLink[link];
    result.body_from_frame = kinematics_.body_from_link[link] * own;
    result.transforms += chain.transforms;
    result.detour +=
        std::max(chain.farthest, kinematics_.body_from_link[link].translation().norm());
    return result;
  }

  int linkOf(const std::string& body, const std::string& of) const {
    if (const auto link = model_.robot->findLink(body)) return *link;
    const auto& attached = model_.options.attached;
    const auto carried = std::ranges::find(attached, body, &AttachedBody::name);
    // compileBodies() has looked the link up.
    if (carried != attached.end()) return *model_.robot->findLink(carried->link);
    std::vector<std::string> known;
    for (const Link& link : model_.robot->links()) known.push_back(link.name);
    for (const AttachedBody& other : attached) known.push_back(other.name);
    refuse(of + " names '" + body + "', which is no link and no attached body" +
           didYouMean(body, known));
  }

  std::vector<int> pathTo(int body) const {
    std::vector<int> path;
    for (int i = body; i > 0; i = kinematics_.bodies[static_cast<std::size_t>(i)].parent)
      path.push_back(i);
    std::ranges::reverse(path);
    return path;
  }

  std::size_t linkBetween(const PlacedFrame& tool, const PlacedFrame& reference) {
    for (std::size_t i = 0; i < found_.links.size(); ++i) {
      ConstrainedLink& link = found_.links[i];
      if (link.tool != tool.body || link.reference != reference.body) continue;
      link.transforms = std::max(link.transforms, transformsOf(tool, reference, link));
      return i;
    }
    ConstrainedLink link{.tool = tool.body, .reference = reference.body};
    link.toolPath = pathTo(tool.body);
    link.referencePath = pathTo(reference.body);
    const auto [a, b] = std::ranges::mismatch(link.toolPath, link.referencePath);
    link.first = static_cast<std::size_t>(a - link.toolPath.begin());
    link.toolPath.erase(link.toolPath.begin(), a);
    link.referencePath.erase(link.referencePath.begin(), b);
    link.transforms = transformsOf(tool, reference, link);
    found_.links.push_back(std::move(link));
    return found_.links.size() - 1;
  }

  double transformsOf(const PlacedFrame& tool, const PlacedFrame& reference,
                      const ConstrainedLink& link) const {
    double transforms = tool.transforms + reference.transforms;
    for (const auto* path : {&link.toolPath, &link.referencePath})
      for (const int body : *path)
        transforms +=
            1.0 + kinematics_.bodies[static_cast<std::size_t>(body)].fixedChain.transforms;
    return transforms;
  }

  SeenVector point(const PlacedFrame& tool, const PlacedFrame& reference) {
    SeenVector seen;
    seen.link = linkBetween(tool, reference);
    seen.slot = found_.vectors++;
    seen.local = tool.body_from_frame.translation();
    seen.observer_from_frame = reference.body_from_frame;
    seen.carrier = leverArms(kinematics_, tool.body, seen.local, 0.0);
    seen.observer =
        leverArms(kinematics_, reference.body, reference.body_from_frame.translation(), 0.0);
    seen.magnitude =
        seen.carrier.spanAtRest + seen.observer.spanAtRest + tool.detour + reference.detour;
    return seen;
  }

  /// `direction`: in the frame that carries it; `axes`: of the observer's frame.
  SeenVector direction(const PlacedFrame& tool, const PlacedFrame& reference, bool fromTool,
                       const Vector3d& direction, const Matrix3d& axes) {
    const PlacedFrame& carrier = fromTool ? tool : reference;
    const PlacedFrame& observer = fromTool ? reference : tool;
    SeenVector seen;
    seen.link = linkBetween(tool, reference);
    seen.slot = found_.vectors++;
    seen.fromTool = fromTool;
    seen.isDirection = true;
    seen.local = carrier.body_from_frame.linear() * direction;
    seen.observer_from_frame.linear() = observer.body_from_frame.linear() * axes;
    seen.carrier.path = pathTo(carrier.body);
    // Without translations a direction is placed as a point is.
    seen.directionArms = armsAtRest(turning_, carrier.body, seen.local, 0.0);
    return seen;
  }

  JointRange jointRange(const JointConstraint& own) {
    const std::string of = "of joint '" + own.joint + "'";
    requireSize(own.above, of + " has tolerance above", "");
    requireSize(own.below, of + " has tolerance below", "");
    if (!std::isfinite(own.position)) refuse(of + " has a position that is not finite");
    JointRange range{.position = own.position, .above = own.above, .below = own.below};
    const Robot& robot = *model_.robot;
    std::optional<int> joint = robot.findJoint(own.joint);
    int place = 0;
    if (joint) {
      const JointType type = robot.joints()[static_cast<std::size_t>(*joint)].type;
      if (type == JointType::Fixed) refuse(of + " is about a joint that does not move");
      if (slidesFreely(type))
        refuse(of + " is about a joint of several values; name one of them, such as '" + own.joint +
               (type == JointType::Planar ? "/x'" : "/trans_x'"));
    } else if (const auto variable = robot.findVariable(own.joint)) {
      joint = robot.variables()[static_cast<std::size_t>(*variable)].joint;
      place = *variable - robot.joints()[static_cast<std::size_t>(*joint)].firstVariable;
    } else {
      std::vector<std::string> known;
      for (const Joint& other : robot.joints()) known.push_back(other.name);
      for (const Variable& other : robot.variables()) known.push_back(other.name);
      refuse(of + ": robot '" + robot.name() + "' has no such joint" +
             didYouMean(own.joint, known));
    }
    const Joint& found = robot.joints()[static_cast<std::size_t>(*joint)];
    if (found.type == JointType::Floating && place >= 3)
      refuse(of + " is about a component of a quaternion, which is no angle");
    range.value = static_cast<std::uint8_t>(place);
    const Joint& master =
        found.mimic ? robot.joints()[static_cast<std::size_t>(found.mimic->master)] : found;
    const int variable = master.firstVariable + place;
    range.cyclic =
        found.type == JointType::Continuous || (found.type == JointType::Planar && place == 2);
    if (!range.cyclic && !found.mimic) {
      const Variable& limits = robot.variables()[static_cast<std::size_t>(variable)];
      if (own.position + own.above < limits.lower - tolerance::kLimit ||
          own.position - own.below > limits.upper + tolerance::kLimit)
        refuse(of + " allows " + formatNumber(own.position - own.below) + " to " +
               formatNumber(own.position + own.above) + ", of which nothing is within its limits");
    }
    const auto body = std::ranges::find(kinematics_.bodies, *joint, &MovingBody::joint);
    if (body != kinematics_.bodies.end()) {
      range.body = static_cast<int>(body - kinematics_.bodies.begin());
      need(range.body);
      return range;
    }
    const Eigen::VectorXd held = model_.options.reference.value_or(robot.defaultState());
    range.held = held[variable];
    if (found.mimic) range.held = found.mimic->multiplier * range.held + found.mimic->offset;
    return range;
  }

  Regions regions(const PositionConstraint& own) {
    const std::string of = "of the position of '" + own.frame.body + "'";
    if (own.regions.empty()) refuse(of + " has no region");
    Regions result{.point = point(placed(own.frame, of), placed(own.reference, of)),
                   .regions = own.regions};
    for (ConstraintRegion& region : result.regions) {
      if (!isRigid(region.reference_from_region))
        refuse(of + " has a region with a pose that is no rotation and place");
      region.reference_from_region = orthonormalized(region.reference_from_region);
      for (const double size : region.size) requireSize(size, of + " has a region of size", " m");
    }
    return result;
  }

  void addOrientation(const OrientationConstraint& own, std::size_t index) {
    const std::string of = "of the orientation of '" + own.frame.body + "'";
    for (const double angle : own.tolerance) requireSize(angle, of + " has tolerance", " rad");
    if (!hasDirection(own.orientation.coeffs().data()))
      refuse(of + " has a quaternion without direction");
    const PlacedFrame tool = placed(own.frame, of);
    const PlacedFrame reference = placed(own.reference, of);
    const Matrix3d desired = own.orientation.normalized().toRotationMatrix();
    CompiledConstraint& added = found_.constraints.emplace_back();
    added.kind = ConstraintViolation::Kind::Orientation;
    added.index = index;
    if (own.parameterization == OrientationConstraint::Parameterization::RotationVector) {
      added.what =
          RotationVectorTolerances{.link = linkBetween(tool, reference),
                                   .tool_from_frame = tool.body_from_frame.linear(),
                                   .reference_from_frame = reference.body_from_frame.linear(),
                                   .desired = desired,
                                   .tolerance = own.tolerance};
      return;
    }
    added.what = EulerTolerances{
        .z = direction(tool, reference, true, Vector3d::UnitZ(), desired),
        .x = direction(tool, reference, false, desired.col(0), Matrix3d::Identity()),
        .tolerance = own.tolerance,
        .sine = own.tolerance.array().min(std::numbers::pi).sin(),
        .cosine = own.tolerance.array().min(std::numbers::pi).cos()};
  }

  Tilt tilt(const AxisConstraint& own) {
    const std::string of = "of an axis of '" + own.frame.body + "'";
    requireSize(own.angle, of + " has angle", " rad");
    const Vector3d axis = unitOf(own.axis, of + ": the axis");
    const Vector3d towards = unitOf(own.direction, of + ": the direction");
    return {.axis = direction(placed(own.frame, of), placed(own.reference, of), true, axis,
                              axisFrame(towards)),
            .angle = own.angle,
            .sine = std::sin(std::min(own.angle, std::numbers::pi)),
            .cosine = std::cos(std::min(own.angle, std::numbers::pi))};
  }

  const PairModel& model_;
  const KinematicModel& kinematics_;
  KinematicModel turning_;  ///< without translations
  ConstraintModel found_;
};

}  // namespace

ConstraintModel compileConstraints(const PairModel& model) {
  if (model.options.constraints.empty()) return {};
  return ConstraintCompiler(model).run();
}

}  // namespace swept::detail
