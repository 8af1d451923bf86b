// SPDX-License-Identifier: BSD-3-Clause
#include "io/request_constraints.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "robot/joint_types.hpp"
#include "swept/core/tolerances.hpp"
#include "text/numbers.hpp"

namespace swept::detail {
namespace {

constexpr std::array<const char*, 4> kKinds{"joint_constraints", "position_constraints",
                                            "orientation_constraints", "visibility_constraints"};

double sizeAt(const YamlPlace& place) {
  if (!place.present()) return 0.0;
  const double value = place.number();
  if (!(value >= 0.0)) place.fail("is " + place.text() + "; allowed is from 0");
  return value;
}

/// Not used, but a number.
void readWeight(const YamlPlace& place) {
  if (place.present()) place.number();
}

class ConstraintReader {
 public:
  ConstraintReader(const Robot& robot, const SceneFrames& frames,
                   const std::vector<AttachedBody>& attached)
      : robot_(robot), frames_(frames), attached_(attached) {}

  TaskConstraint read(const YamlPlace& place) const {
    TaskConstraint task;
    for (const YamlPlace& own : place.at(kKinds[0]).elements()) task.joints.push_back(joint(own));
    for (const YamlPlace& own : place.at(kKinds[1]).elements())
      task.positions.push_back(position(own));
    for (const YamlPlace& own : place.at(kKinds[2]).elements())
      task.orientations.push_back(orientation(own));
    if (const auto views = place.at(kKinds[3]).elements(); !views.empty())
      views[0].fail("is not supported: no proof is known of what a sensor sees along a motion");
    return task;
  }

 private:
  JointConstraint joint(const YamlPlace& place) const {
    place.allowOnly({"joint_name", "position", "tolerance_above", "tolerance_below", "weight"});
    readWeight(place.at("weight"));
    const YamlPlace name = place.at("joint_name");
    JointConstraint own{.joint = name.text(),
                        .position = place.at("position").number(),
                        .above = sizeAt(place.at("tolerance_above")),
                        .below = sizeAt(place.at("tolerance_below"))};
    std::optional<int> variable = robot_.findVariable(own.joint);
    if (const auto found = robot_.findJoint(own.joint)) {
      const Joint& joint = robot_.joints()[static_cast<std::size_t>(*found)];
      if (joint.type == JointType::Fixed) name.fail("is '" + own.joint + "', which does not move");
      if (slidesFreely(joint.type))
        name.fail("is '" + own.joint + "', which has several values; allowed is one, such as '" +
                  own.joint + (joint.type == JointType::Planar ? "/x'" : "/trans_x'"));
      variable = joint.mimic ? std::nullopt : std::optional(joint.firstVariable);
    } else if (!variable) {
      name.fail("is '" + own.joint + "', which is no joint of robot '" + robot_.name() + "'");
    }
    if (!variable) return own;
    const Variable& limits = robot_.variables()[static_cast<std::size_t>(*variable)];
    const Joint& joint = robot_.joints()[static_cast<std::size_t>(limits.joint)];
    const auto quaternion = quaternionPlace(joint.type);
    if (quaternion && *variable - joint.firstVariable >= *quaternion)
      name.fail("is '" + own.joint +
                "', a component of a quaternion; allowed are angles and "
                "lengths");
    if (!limits.cyclic && (own.position + own.above < limits.lower - tolerance::kLimit ||
                           own.position - own.below > limits.upper + tolerance::kLimit))
      place.at("position")
          .fail("is " + place.at("position").text() + " with tolerances " +
                formatNumber(own.below) + " below and " + formatNumber(own.above) +
                " above, of which nothing is within the joint's limits " +
                formatNumber(limits.lower) + " to " + formatNumber(limits.upper));
    return own;
  }

  std::string linkOf(const YamlPlace& place) const {
    const std::string link = place.text();
    if (!robot_.findLink(link))
      place.fail("is '" + link + "', which is no link of robot '" + robot_.name() + "'");
    return link;
  }

  /// Links go before all frames but the model frame, and move with the robot.
  ConstraintFrame frameOf(const YamlPlace& header) const {
    const std::string name = frameName(header);
    if (name == robot_.modelFrame()) return {};
    const bool moves = robot_.findLink(name).has_value() ||
                       std::ranges::find(attached_, name, &AttachedBody::name) != attached_.end();
    if (moves) return {.body = name};
    return {.body_from_frame = frames_.model_from(header)};
  }

  PositionConstraint position(const YamlPlace& place) const {
    place.allowOnly({"header", "link_name", "target_point_offset", "constraint_region", "weight"});
    readWeight(place.at("weight"));
    PositionConstraint own{.frame = {.body = linkOf(place.at("link_name"))},
                           .reference = frameOf(place.at("header")),
                           .regions = {}};
    if (const YamlPlace offset = place.at("target_point_offset"); offset.present())
      own.frame.body_from_frame.translation() = offset.vector();
    const YamlPlace region = place.at("constraint_region");
    region.allowOnly({"primitives", "primitive_poses", "meshes", "mesh_poses"});
    if (const auto meshes = region.at("meshes").elements(); !meshes.empty())
      meshes[0].fail("is not supported; a region is a primitive");
    const std::vector<YamlPlace> primitives = region.at("primitives").elements();
    const std::vector<YamlPlace> poses = region.at("primitive_poses").elements();
    if (primitives.empty()) region.fail("has no primitive: no point is in it");
    if (primitives.size() != poses.size())
      region.fail("has " + std::to_string(primitives.size()) + " primitives and " +
                  std::to_string(poses.size()) + " primitive_poses");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      own.regions.push_back(primitive(primitives[i]));
      own.regions.back().reference_from_region = poses[i].pose("position", "orientation");
    }
    return own;
  }

  /// A type by name, or by its code in shape_msgs/SolidPrimitive.
  static ConstraintRegion primitive(const YamlPlace& place) {
    place.allowOnly({"type", "dimensions", "polygon"});
    const YamlPlace type = place.at("type");
    const std::string name = type.text();
    const std::vector<YamlPlace> sizes = place.at("dimensions").elements();
    const auto require = [&](std::size_t count, const char* what) {
      if (sizes.size() == count) return;
      place.at("dimensions")
          .fail("has " + std::to_string(sizes.size()) + " numbers; allowed are " + what);
    };
    ConstraintRegion region;
    if (name == "box" || name == "BOX" || name == "1") {
      require(3, "three: x, y and z");
      region.size = {sizeAt(sizes[0]), sizeAt(sizes[1]), sizeAt(sizes[2])};
    } else if (name == "sphere" || name == "SPHERE" || name == "2") {
      require(1, "one: the radius");
      region.type = ConstraintRegion::Type::Sphere;
      region.size.x() = sizeAt(sizes[0]);
    } else if (name == "cylinder" || name == "CYLINDER" || name == "3") {
      require(2, "two: height and radius");
      region.type = ConstraintRegion::Type::Cylinder;
      region.size.head<2>() << sizeAt(sizes[1]), sizeAt(sizes[0]);
    } else {
      type.fail("is '" + name + "'; a region is a box (1), a sphere (2) or a cylinder (3)");
    }
    return region;
  }

  OrientationConstraint orientation(const YamlPlace& place) const {
    place.allowOnly({"header", "orientation", "link_name", "absolute_x_axis_tolerance",
                     "absolute_y_axis_tolerance", "absolute_z_axis_tolerance", "parameterization",
                     "weight"});
    readWeight(place.at("weight"));
    OrientationConstraint own{.frame = {.body = linkOf(place.at("link_name"))},
                              .reference = frameOf(place.at("header"))};
    if (const YamlPlace given = place.at("orientation"); given.present())
      own.orientation = Eigen::Quaterniond(given.rotation());
    own.tolerance = {sizeAt(place.at("absolute_x_axis_tolerance")),
                     sizeAt(place.at("absolute_y_axis_tolerance")),
                     sizeAt(place.at("absolute_z_axis_tolerance"))};
    const YamlPlace kind = place.at("parameterization");
    if (kind.present()) {
      const int code = kind.integer();
      if (code != 0 && code != 1)
        kind.fail("is " + kind.text() + "; allowed are 0 (Euler angles) and 1 (a rotation vector)");
      if (code == 1) own.parameterization = OrientationConstraint::Parameterization::RotationVector;
    }
    return own;
  }

  const Robot& robot_;
  const SceneFrames& frames_;
  const std::vector<AttachedBody>& attached_;
};

}  // namespace

void allowConstraints(const YamlPlace& place) {
  place.allowOnly({"name", kKinds[0], kKinds[1], kKinds[2], kKinds[3]});
}

bool constrainsAnything(const YamlPlace& place) {
  return std::ranges::any_of(kKinds,
                             [&](const char* kind) { return !place.at(kind).elements().empty(); });
}

TaskConstraint readConstraints(const YamlPlace& place, const Robot& robot,
                               const SceneFrames& frames,
                               const std::vector<AttachedBody>& attached) {
  if (!place.present()) return {};
  allowConstraints(place);
  return ConstraintReader(robot, frames, attached).read(place);
}

}  // namespace swept::detail
