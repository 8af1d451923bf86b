// SPDX-License-Identifier: BSD-3-Clause
#include <tinyxml2.h>

#include <string>

#include "io/xml.hpp"
#include "output/text_output.hpp"
#include "spheres/model_shapes.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/sphere_model.hpp"

namespace swept {
namespace {

using Element = tinyxml2::XMLElement;

std::string coordinates(const Eigen::Vector3d& point) {
  return exactNumber(point.x()) + " " + exactNumber(point.y()) + " " + exactNumber(point.z());
}

void removeChildren(Element& parent, const char* name) {
  while (Element* child = parent.FirstChildElement(name)) parent.DeleteChild(child);
}

void addCollision(Element& link, const EnclosingSphere& sphere) {
  Element* collision = link.InsertNewChildElement("collision");
  Element* origin = collision->InsertNewChildElement("origin");
  origin->SetAttribute("xyz", coordinates(sphere.center).c_str());
  origin->SetAttribute("rpy", "0 0 0");
  collision->InsertNewChildElement("geometry")
      ->InsertNewChildElement("sphere")
      ->SetAttribute("radius", exactNumber(sphere.radius).c_str());
}

}  // namespace

std::string spherizedUrdf(const SphereModel& model, const std::string& urdfText,
                          const std::string& name) {
  const detail::InputSource source(name, {});
  detail::XmlFile xml(urdfText, source);
  for (Element* link = xml.robot().FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    removeChildren(*link, "collision");
    const char* const own = link->Attribute("name");
    const LinkSpheres* spheres = own == nullptr ? nullptr : model.find(own);
    if (spheres == nullptr) continue;
    for (const EnclosingSphere& sphere : spheres->spheres) addCollision(*link, sphere);
  }
  return xml.print();
}

std::string urdfWithVisualsAsCollision(const std::string& urdfText, const std::string& name) {
  const detail::InputSource source(name, {});
  detail::XmlFile xml(urdfText, source);
  for (Element* link = xml.robot().FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    removeChildren(*link, "collision");
    while (Element* visual = link->FirstChildElement("visual")) {
      removeChildren(*visual, "material");
      visual->SetName("collision");
    }
  }
  return xml.print();
}

std::string urdfOfMesh(const std::filesystem::path& mesh) {
  tinyxml2::XMLDocument document;
  Element* robot = document.NewElement("robot");
  document.InsertEndChild(robot);
  robot->SetAttribute("name", mesh.stem().c_str());
  Element* link = robot->InsertNewChildElement("link");
  link->SetAttribute("name", mesh.stem().c_str());
  link->InsertNewChildElement("collision")
      ->InsertNewChildElement("geometry")
      ->InsertNewChildElement("mesh")
      ->SetAttribute("filename", mesh.c_str());
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

std::string sphereApproximationSrdf(const SphereModel& model, const std::string& robot,
                                    const std::string& srdfText, const std::string& name) {
  constexpr const char* kElement = "link_sphere_approximation";
  const detail::InputSource source(name, {});
  detail::XmlFile xml(srdfText.empty() ? "<?xml version=\"1.0\"?>\n<robot/>\n" : srdfText, source);
  Element& root = xml.robot();
  if (srdfText.empty()) root.SetAttribute("name", robot.c_str());
  removeChildren(root, kElement);
  for (const LinkSpheres& link : model.links) {
    Element* own = root.InsertNewChildElement(kElement);
    own->SetAttribute("link", link.link.c_str());
    for (const EnclosingSphere& sphere : link.spheres) {
      Element* element = own->InsertNewChildElement("sphere");
      element->SetAttribute("center", coordinates(sphere.center).c_str());
      element->SetAttribute("radius", exactNumber(sphere.radius).c_str());
    }
  }
  return xml.print();
}

std::string curoboSpheres(const SphereModel& model, const std::string& robot) {
  // A text of JSON is one of YAML, whatever is in the name.
  std::string text = "robot: " + lineOf(Json(robot)) + "\ncollision_spheres:\n";
  for (const LinkSpheres& link : model.links) {
    text += "  " + lineOf(Json(link.link)) + ":\n";
    for (const EnclosingSphere& sphere : link.spheres)
      text += "    - center: [" + exactNumber(sphere.center.x()) + ", " +
              exactNumber(sphere.center.y()) + ", " + exactNumber(sphere.center.z()) +
              "]\n      radius: " + exactNumber(sphere.radius) + "\n";
  }
  return text;
}

std::string sphereModelJson(const SphereModel& model, const std::string& robot,
                            const std::vector<LinkSphereReport>& reports) {
  Json json = {{"robot", robot}, {"spheres", model.count()}, {"links", Json::array()}};
  for (const LinkSpheres& link : model.links) {
    Json entry = {{"link", link.link}, {"spheres", Json::array()}};
    for (const EnclosingSphere& sphere : link.spheres)
      entry["spheres"].push_back(detail::sphereJson(sphere));
    detail::addFigures(entry, link.link, reports);
    json["links"].push_back(std::move(entry));
  }
  return dumped(json) + "\n";
}

}  // namespace swept
