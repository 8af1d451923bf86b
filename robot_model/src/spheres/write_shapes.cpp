// SPDX-License-Identifier: BSD-3-Clause
#include <tinyxml2.h>

#include <cctype>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/xml.hpp"
#include "output/text_output.hpp"
#include "spheres/model_shapes.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/shape_model.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using XmlElement = tinyxml2::XMLElement;

std::string threeNumbers(const Vector3d& v) {
  return exactNumber(v.x()) + " " + exactNumber(v.y()) + " " + exactNumber(v.z());
}

/// Angles of Rz(yaw) Ry(pitch) Rx(roll).
Vector3d rollPitchYaw(const Eigen::Matrix3d& r) {
  const double level = std::hypot(r(0, 0), r(1, 0));
  const double pitch = std::atan2(-r(2, 0), level);
  if (level < 1e-9) return {std::atan2(-r(1, 2), r(1, 1)), pitch, 0.0};
  return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
}

/// The geometry of a new `<collision>`.
XmlElement& geometryIn(XmlElement& link, const Isometry3d& pose) {
  XmlElement* collision = link.InsertNewChildElement("collision");
  XmlElement* origin = collision->InsertNewChildElement("origin");
  origin->SetAttribute("xyz", threeNumbers(pose.translation()).c_str());
  origin->SetAttribute("rpy", threeNumbers(rollPitchYaw(pose.linear())).c_str());
  return *collision->InsertNewChildElement("geometry");
}

void addBall(XmlElement& link, const Vector3d& center, double radius) {
  geometryIn(link, Isometry3d(Eigen::Translation3d(center)))
      .InsertNewChildElement("sphere")
      ->SetAttribute("radius", exactNumber(radius).c_str());
}

void addRoundColumn(XmlElement& link, const Isometry3d& pose, double radius, double halfLength) {
  XmlElement* cylinder = geometryIn(link, pose).InsertNewChildElement("cylinder");
  cylinder->SetAttribute("radius", exactNumber(radius).c_str());
  cylinder->SetAttribute("length", exactNumber(2.0 * halfLength).c_str());
}

std::string objText(const ConvexHull& hull) {
  std::string text;
  for (const Vector3d& vertex : hull.vertices()) text += "v " + threeNumbers(vertex) + "\n";
  for (const Eigen::Vector3i& face : hull.faces())
    text += "f " + std::to_string(face[0] + 1) + " " + std::to_string(face[1] + 1) + " " +
            std::to_string(face[2] + 1) + "\n";
  return text;
}

/// A name of a C++ struct.
std::string structName(const std::string& name) {
  std::string result;
  for (const char c : name) result += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  if (result.empty() || std::isdigit(static_cast<unsigned char>(result.front())) != 0)
    result.insert(0, "robot_");
  return result;
}

}  // namespace

ShapedUrdf urdfWithShapes(const ShapeModel& model, const std::string& urdfText,
                          const std::string& name, const std::string& prefix) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return urdfWithShapes(model, urdfText, name, prefix); });
  const detail::InputSource source(name, {});
  detail::XmlFile xml(urdfText, source);
  ShapedUrdf shaped;
  for (XmlElement* link = xml.robot().FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    while (XmlElement* child = link->FirstChildElement("collision")) link->DeleteChild(child);
    const char* const own = link->Attribute("name");
    const LinkShapes* shapes = own == nullptr ? nullptr : model.find(own);
    if (shapes == nullptr) continue;
    for (const PosedShape& posed : shapes->shapes) {
      const Isometry3d& pose = posed.body_from_shape;
      if (const auto* sphere = std::get_if<Sphere>(&posed.shape)) {
        addBall(*link, pose.translation(), sphere->radius);
      } else if (const auto* box = std::get_if<Box>(&posed.shape)) {
        geometryIn(*link, pose)
            .InsertNewChildElement("box")
            ->SetAttribute("size", threeNumbers(2.0 * box->halfExtents).c_str());
      } else if (const auto* cylinder = std::get_if<Cylinder>(&posed.shape)) {
        addRoundColumn(*link, pose, cylinder->radius, cylinder->halfLength);
      } else if (const auto* capsule = std::get_if<Capsule>(&posed.shape)) {
        const bool isBall = capsule->halfLength == 0.0;
        if (!isBall) addRoundColumn(*link, pose, capsule->radius, capsule->halfLength);
        for (const double end : isBall ? std::vector{0.0} : std::vector{-1.0, 1.0})
          addBall(*link, pose * Vector3d(0, 0, end * capsule->halfLength), capsule->radius);
      } else if (const auto* hull = std::get_if<ConvexHull>(&posed.shape)) {
        const std::string file = prefix + std::to_string(shaped.meshes.size()) + ".obj";
        geometryIn(*link, pose)
            .InsertNewChildElement("mesh")
            ->SetAttribute("filename", file.c_str());
        shaped.meshes.emplace_back(file, objText(*hull));
      } else {
        detail::refuseShape();
      }
    }
  }
  shaped.text = xml.print();
  return shaped;
}

std::string shapeModelJson(const ShapeModel& model, const std::string& robot,
                           const std::vector<LinkSphereReport>& reports) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return shapeModelJson(model, robot, reports); });
  Json json = {{"robot", robot}, {"shapes", model.count()}, {"links", Json::array()}};
  for (const LinkShapes& link : model.links) {
    Json entry = {{"link", link.link}, {"shapes", Json::array()}};
    for (const PosedShape& shape : link.shapes) entry["shapes"].push_back(detail::shapeJson(shape));
    detail::addFigures(entry, link.link, reports);
    json["links"].push_back(std::move(entry));
  }
  return dumped(json) + "\n";
}

std::string xrdfSpheres(const SphereModel& model) {
  const std::string geometry = "enclosing_spheres";
  std::string text = "format: xrdf\nformat_version: 1.0\ncollision:\n  geometry: " + geometry +
                     "\nself_collision:\n  geometry: " + geometry + "\ngeometry:\n  " + geometry +
                     ":\n    spheres:\n";
  for (const LinkSpheres& link : model.links) {
    text += "      " + lineOf(Json(link.link)) + ":\n";
    for (const EnclosingSphere& sphere : link.spheres)
      text += "        - center: [" + exactNumber(sphere.center.x()) + ", " +
              exactNumber(sphere.center.y()) + ", " + exactNumber(sphere.center.z()) +
              "]\n          radius: " + exactNumber(sphere.radius) + "\n";
  }
  return text;
}

std::string vampConfiguration(const Robot& robot, const std::string& urdf,
                              const std::string& srdf) {
  const std::string name = structName(robot.name());
  Json json = {{"name", name}, {"urdf", urdf}};
  if (!srdf.empty()) json["srdf"] = srdf;
  for (const Group& group : robot.groups()) {
    if (group.tipLink < 0) continue;
    const std::string& tip = robot.links()[static_cast<std::size_t>(group.tipLink)].name;
    json["end_effector"] = tip;  // older versions read this, newer ones the list
    json["end_effectors"] = Json::array({tip});
    break;
  }
  json["resolution"] = 32;
  json["template"] = "templates/fk_template.hh";
  json["subtemplates"] =
      Json::array({{{"name", "ccfk"}, {"template", "templates/ccfk_template.hh"}}});
  json["output"] = name + "_fk.hh";
  return dumped(json) + "\n";
}

}  // namespace swept
