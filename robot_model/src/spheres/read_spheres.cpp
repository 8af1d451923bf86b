// SPDX-License-Identifier: BSD-3-Clause
#include <tinyxml2.h>

#include <algorithm>
#include <string>
#include <utility>

#include "io/json_value.hpp"
#include "io/xml.hpp"
#include "io/yaml.hpp"
#include "spheres/link_names.hpp"
#include "spheres/model_shapes.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/sphere_model.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

using detail::unknownLink;
using detail::YamlPlace;

/// The entry of the link, which may have come before.
std::vector<EnclosingSphere>& spheresOf(SphereModel& model, const std::string& link) {
  const auto found = std::ranges::find(model.links, link, &LinkSpheres::link);
  if (found != model.links.end()) return found->spheres;
  model.links.push_back({link, {}});
  return model.links.back().spheres;
}

SphereModel fromUrdf(const std::string& file, const Robot& robot, const LoadOptions& options);

SphereModel fromJson(const std::string& file, const Robot& robot, const LoadOptions& options) {
  const nlohmann::json json = JsonValue::parseFile(file);
  const JsonValue root(json, "the file", file);
  if (const auto urdf = detail::urdfOfConfiguration(root))
    return fromUrdf(urdf->string(), robot, options);
  SphereModel model;
  for (const JsonValue& entry : root.at("links").elements()) {
    const JsonValue name = entry.at("link");
    const std::string link = name.text();
    if (const std::string unknown = unknownLink(robot, link); !unknown.empty())
      name.fail("is " + unknown);
    std::vector<EnclosingSphere>& spheres = spheresOf(model, link);
    for (const JsonValue& sphere : entry.at("spheres").elements())
      spheres.push_back(detail::sphereOf(sphere));
  }
  return model;
}

/// The mapping from links to spheres in a file for cuRobo, or an XRDF one.
YamlPlace spheresByLink(const YamlPlace& root, bool isXrdf) {
  if (isXrdf || root.at("format").present()) {
    if (!root.at("format").present() || root.at("format").text() != "xrdf")
      root.at("format").fail("must be xrdf");
    YamlPlace user =
        root.at("world_collision").present() ? root.at("world_collision") : root.at("collision");
    const std::string name = user.at("geometry").text();
    const YamlPlace geometry = root.at("geometry").at(name);
    if (!geometry.present()) user.at("geometry").fail("is '" + name + "', which geometry lacks");
    return geometry.at("spheres");
  }
  const bool nested = root.at("robot_cfg").present();
  return nested ? root.at("robot_cfg").at("kinematics").at("collision_spheres")
                : root.at("collision_spheres");
}

SphereModel fromYaml(const std::string& file, const Robot& robot, const LoadOptions& options) {
  const detail::InputSource source(file, options);
  const YamlPlace root = YamlPlace::parse(readTextFile(file), source);
  if (!root.isMap()) root.fail("a file of spheres must be a mapping with 'collision_spheres'");
  const YamlPlace links = spheresByLink(root, file.ends_with(".xrdf"));
  if (!links.present()) links.fail("is missing");
  if (!links.isMap())
    links.fail("must be a mapping from links to their spheres; if it names a file, give that file");
  SphereModel model;
  for (const auto& [name, list] : links.entries()) {
    const std::string link = name.text();
    if (const std::string unknown = unknownLink(robot, link); !unknown.empty())
      name.fail("has " + unknown);
    std::vector<EnclosingSphere>& spheres = spheresOf(model, link);
    for (const YamlPlace& sphere : list.elements()) {
      const Eigen::Vector3d center = sphere.at("center").vector();
      const double radius = sphere.at("radius").number();
      if (radius >= 0.0) spheres.push_back({center, radius});
    }
  }
  return model;
}

SphereModel fromSrdf(const std::string& file, const Robot& robot, const LoadOptions& options) {
  const detail::InputSource source(file, options);
  detail::XmlFile xml(readTextFile(file), source);
  SphereModel model;
  bool any = false;
  for (auto* links = xml.robot().FirstChildElement("link_sphere_approximation"); links != nullptr;
       links = links->NextSiblingElement("link_sphere_approximation")) {
    any = true;
    const std::string link = xml.text(*links, "link", "the robot");
    if (const std::string unknown = unknownLink(robot, link); !unknown.empty())
      xml.fail(*links, "<link_sphere_approximation> is of " + unknown);
    const std::string owner = "the approximation of link '" + link + "'";
    std::vector<EnclosingSphere>& spheres = spheresOf(model, link);
    for (auto* sphere = links->FirstChildElement("sphere"); sphere != nullptr;
         sphere = sphere->NextSiblingElement("sphere"))
      spheres.push_back(
          {xml.vector(*sphere, "center", owner), xml.notNegative(*sphere, "radius", owner)});
  }
  if (!any) source.fail(0, "has no <link_sphere_approximation>");
  return model;
}

SphereModel fromUrdf(const std::string& file, const Robot& robot, const LoadOptions& options) {
  const auto spherized = Robot::load(file, {}, options);
  SphereModel model;
  for (const Link& link : spherized->links()) {
    if (link.collision.empty()) continue;
    if (const std::string unknown = unknownLink(robot, link.name); !unknown.empty())
      throw InputError(file, 0, "it has link " + unknown);
    std::vector<EnclosingSphere>& spheres = spheresOf(model, link.name);
    for (const CollisionGeometry& geometry : link.collision) {
      const auto* sphere = std::get_if<Sphere>(&geometry.shape);
      if (sphere == nullptr)
        throw InputError(file, 0,
                         "the <collision> of link '" + link.name + "' has '" + geometry.source +
                             "'; allowed in a model of spheres: sphere");
      spheres.push_back({geometry.link_from_shape.translation(), sphere->radius});
    }
  }
  return model;
}

}  // namespace

SphereModel readSphereModel(const std::filesystem::path& file, const Robot& robot,
                            const LoadOptions& options) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return readSphereModel(file, robot, options); });
  const std::string ending = file.extension().string();
  if (ending == ".json") return fromJson(file.string(), robot, options);
  if (ending == ".yaml" || ending == ".yml" || ending == ".xrdf")
    return fromYaml(file.string(), robot, options);
  if (ending == ".srdf") return fromSrdf(file.string(), robot, options);
  if (ending == ".urdf") return fromUrdf(file.string(), robot, options);
  throw InputError(file.string(), 0,
                   "spheres cannot be in a file that ends in '" + ending +
                       "'; allowed: .json, .yaml, .yml (cuRobo), .xrdf, .srdf, .urdf");
}

}  // namespace swept
