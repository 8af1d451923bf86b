// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_tree.hpp"

#include "output/robot_json.hpp"
#include "swept/core/axis_frame.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

/// x, y, z, w.
Json quaternionJson(const Eigen::Matrix3d& turn) {
  const Eigen::Quaterniond quaternion(turn);
  return toJson(std::span<const double>(quaternion.coeffs().data(), 4));
}

Json jointJson(const Robot& robot, const Joint& joint) {
  const Joint& source = joint.mimic ? robot.joints()[joint.mimic->master] : joint;
  Json json = {{"name", joint.name}, {"type", toString(joint.type)}};
  json["parent"] = joint.parentLink < 0 ? Json(nullptr) : Json(joint.parentLink);
  json["child"] = joint.childLink;
  json["position"] = toJson(Eigen::Vector3d(joint.parent_from_joint.translation()));
  json["turn"] = quaternionJson(joint.parent_from_joint.linear());
  json["axis"] = toJson(joint.axis);
  // What x and y of a planar joint are along.
  if (joint.type == JointType::Planar) json["plane"] = quaternionJson(axisFrame(joint.axis));
  json["variable"] = source.firstVariable < 0 ? Json(nullptr) : Json(source.firstVariable);
  json["mimic"] = nullptr;
  if (joint.mimic)
    json["mimic"] = {{"joint", source.name},
                     {"multiplier", joint.mimic->multiplier},
                     {"offset", joint.mimic->offset}};
  return json;
}

}  // namespace

Json treeJson(const Robot& robot, const Group& group,
              const std::optional<Eigen::VectorXd>& reference) {
  const Eigen::VectorXd values = reference.value_or(robot.defaultState());
  Json json = {{"links", Json::array()}, {"joints", Json::array()}, {"variables", Json::array()}};
  for (const Link& link : robot.links()) json["links"].push_back(link.name);
  for (const Joint& joint : robot.joints()) json["joints"].push_back(jointJson(robot, joint));
  for (const Variable& variable : robot.variables()) {
    Json entry = variableJson(variable);
    entry["unit"] = unitOf(robot, variable);
    json["variables"].push_back(std::move(entry));
  }
  json["group"] = group.variables;
  json["reference"] = toJson(std::span<const double>(values.data(), std::size_t(values.size())));
  return json;
}

}  // namespace swept
