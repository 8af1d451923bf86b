// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "mesh_files.hpp"
#include "swept/core/shapes.hpp"
#include "swept/robot_model/robot.hpp"

/// The PR2's arms among 100 obstacles: Table V of Pan, Chitta, Manocha 2012.
namespace swept::benchmark {

struct Obstacle {
  Shape shape;
  Eigen::Isometry3d pose;
};

struct Arm {
  std::string name;
  std::vector<Shape> links;                           ///< one per collision shape
  std::vector<std::vector<Eigen::Isometry3d>> poses;  ///< [configuration][shape], world frame
};

struct ArmWorkload {
  nlohmann::json json;
  std::vector<Arm> arms;
  std::map<std::string, std::vector<Obstacle>> obstacles;  ///< by kind

  /// One '0' or '1' per configuration.
  std::string truth(const Arm& arm, const std::string& kind) const {
    return json.at("truth").at(arm.name).at(kind).get<std::string>();
  }
};

/// Meshes count as surfaces in this data.
inline Shape surfaceOf(const Shape& shape) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape);
  if (mesh == nullptr) return shape;
  return TriangleMesh::build(mesh->vertices(), mesh->triangles(), MeshInterior::Surface);
}

/// Poses of all links at the given joint values; joints without one are at 0.
inline std::vector<Eigen::Isometry3d> linkPoses(const Robot& robot,
                                                const std::map<std::string, double>& values) {
  const auto valueOf = [&](int joint) {
    const auto found = values.find(robot.joints()[static_cast<std::size_t>(joint)].name);
    return found == values.end() ? 0.0 : found->second;
  };
  std::vector<Eigen::Isometry3d> poses(robot.links().size(), Eigen::Isometry3d::Identity());
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const Joint& joint = robot.joints()[i];
    if (joint.parentLink < 0) continue;
    const double value =
        joint.mimic ? joint.mimic->multiplier * valueOf(joint.mimic->master) + joint.mimic->offset
                    : valueOf(static_cast<int>(i));
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    if (joint.type == JointType::Revolute || joint.type == JointType::Continuous)
      motion.linear() = Eigen::AngleAxisd(value, joint.axis).toRotationMatrix();
    if (joint.type == JointType::Prismatic) motion.translation() = value * joint.axis;
    poses[static_cast<std::size_t>(joint.childLink)] =
        poses[static_cast<std::size_t>(joint.parentLink)] * joint.parent_from_joint * motion;
  }
  return poses;
}

/// The links at and below `root`.
inline std::vector<int> linksBelow(const Robot& robot, const std::string& root) {
  std::vector<int> links{robot.findLink(root).value()};
  std::vector<bool> below(robot.links().size(), false);
  below[static_cast<std::size_t>(links.front())] = true;
  for (const Joint& joint : robot.joints()) {
    if (joint.parentLink < 0 || !below[static_cast<std::size_t>(joint.parentLink)]) continue;
    below[static_cast<std::size_t>(joint.childLink)] = true;
    links.push_back(joint.childLink);
  }
  return links;
}

inline Arm readArm(const Robot& robot, const std::string& name, const nlohmann::json& json,
                   const nlohmann::json& fixed) {
  Arm arm{name, {}, {}};
  const std::vector<int> links = linksBelow(robot, json.at("root_link").get<std::string>());
  for (const int link : links)
    for (const CollisionGeometry& piece : robot.links()[static_cast<std::size_t>(link)].collision)
      arm.links.push_back(surfaceOf(piece.shape));
  auto values = fixed.get<std::map<std::string, double>>();
  const auto joints = json.at("joints").get<std::vector<std::string>>();
  for (const nlohmann::json& configuration : json.at("configurations")) {
    for (std::size_t i = 0; i < joints.size(); ++i)
      values[joints[i]] = configuration.at(i).get<double>();
    const std::vector<Eigen::Isometry3d> poses = linkPoses(robot, values);
    std::vector<Eigen::Isometry3d>& pieces = arm.poses.emplace_back();
    for (const int link : links)
      for (const CollisionGeometry& piece : robot.links()[static_cast<std::size_t>(link)].collision)
        pieces.push_back(poses[static_cast<std::size_t>(link)] * piece.link_from_shape);
  }
  return arm;
}

inline Shape readObstacle(const nlohmann::json& item, const std::string& kind,
                          const std::vector<Soup>& templates) {
  if (kind == "box") {
    const auto size = item.at("size").get<std::vector<double>>();
    return makeBox({size.at(0), size.at(1), size.at(2)});
  }
  if (kind == "sphere") return makeSphere(item.at("radius").get<double>());
  if (kind == "cylinder")
    return makeCylinder(item.at("radius").get<double>(), item.at("length").get<double>());
  Soup soup = templates.at(item.at("template").get<std::size_t>());
  for (Eigen::Vector3d& v : soup.vertices) v *= item.at("scale").get<double>();
  return TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Surface);
}

inline ArmWorkload readArmWorkload(const std::filesystem::path& data) {
  ArmWorkload work;
  work.json = readJson(data / "seed_tables" / "pr2_arms.json");
  const std::filesystem::path urdf = data / work.json.at("robot").at("urdf").get<std::string>();
  LoadOptions options;
  options.packages = {{"moveit_resources_pr2_description/urdf", urdf.parent_path()}};
  const auto robot = Robot::load(urdf, {}, options);
  for (const auto& [name, arm] : work.json.at("arms").items())
    work.arms.push_back(readArm(*robot, name, arm, work.json.at("robot").at("fixed_joints")));
  std::vector<Soup> templates;
  for (const nlohmann::json& file : work.json.at("mesh_templates"))
    templates.push_back(readObj(data / file.get<std::string>()));
  for (const auto& [kind, list] : work.json.at("obstacles").items()) {
    std::vector<Obstacle>& obstacles = work.obstacles[kind];
    for (const nlohmann::json& item : list)
      obstacles.push_back({readObstacle(item, kind, templates), readPose(item.at("pose"))});
  }
  return work;
}

}  // namespace swept::benchmark
