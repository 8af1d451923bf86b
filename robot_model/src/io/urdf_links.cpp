// SPDX-License-Identifier: BSD-3-Clause
#include "io/urdf_elements.hpp"

namespace swept::detail {

namespace {

/// Has a `<visual>` with a shape.
bool isShown(const UrdfElements::Element& link) {
  const auto* visual = link.FirstChildElement("visual");
  for (; visual != nullptr; visual = visual->NextSiblingElement("visual")) {
    const auto* geometry = visual->FirstChildElement("geometry");
    if (geometry != nullptr && geometry->FirstChildElement() != nullptr) return true;
  }
  return false;
}

}  // namespace

UrdfOutline::Link UrdfLinkReader::read(Element& element) {
  UrdfOutline::Link link;
  link.name = xml_.text(element, "name", "");
  link.line = element.GetLineNum();
  const std::string owner = "link '" + link.name + "'";
  link.hasVisual = isShown(element);
  reduce(element, {"collision"},
         {"inertial", "visual", "contact", "gravity", "self_collide", "self_filter", "sensor",
          "origin"},
         owner);
  for (Element* c = element.FirstChildElement("collision"); c != nullptr;
       c = c->NextSiblingElement("collision")) {
    link.collisions.push_back(readCollision(*c, owner));
  }
  return link;
}

UrdfOutline::Collision UrdfLinkReader::readCollision(Element& element, const std::string& owner) {
  reduce(element, {"origin", "geometry"}, {"material", "contact_coefficients", "verbose"}, owner);
  readOrigin(element, owner);
  Element* geometry = xml_.onlyChild(element, "geometry", owner);
  if (geometry == nullptr) xml_.fail(element, "<collision> of " + owner + " has no <geometry>");
  Element* shape = geometry->FirstChildElement();
  if (shape == nullptr) {
    xml_.fail(*geometry, "<geometry> of " + owner +
                             " is empty; it must hold box, cylinder, sphere, capsule or mesh");
  }
  if (const Element* second = shape->NextSiblingElement()) {
    xml_.fail(*second, "<geometry> of " + owner + " holds a second shape <" + second->Name() +
                           ">; one is allowed");
  }
  UrdfOutline::Collision collision;
  collision.shapeLine = shape->GetLineNum();
  readShape(*shape, collision, owner);
  return collision;
}

void UrdfLinkReader::readShape(Element& shape, UrdfOutline::Collision& collision,
                               const std::string& owner) {
  const std::string_view name = shape.Name();
  if (name == "box") {
    refuseUnknownAttributes(shape, {"size"}, owner);
    const Eigen::Vector3d size = xml_.vector(shape, "size", owner);
    if (!(size.minCoeff() >= 0.0)) {
      xml_.fail(shape, XmlFile::quote(shape, "size") + " of " + owner +
                           " must have three sizes of 0 or greater");
    }
    collision.withoutVolume = size.minCoeff() == 0.0;
    setVector(shape, "size", size);
  } else if (name == "sphere") {
    refuseUnknownAttributes(shape, {"radius"}, owner);
    const double radius = xml_.notNegative(shape, "radius", owner);
    collision.withoutVolume = radius == 0.0;
    setNumber(shape, "radius", radius);
  } else if (name == "cylinder" || name == "capsule") {
    refuseUnknownAttributes(shape, {"radius", "length"}, owner);
    const double radius = xml_.notNegative(shape, "radius", owner);
    const double length = xml_.notNegative(shape, "length", owner);
    if (name == "cylinder") {
      collision.withoutVolume = radius == 0.0 || length == 0.0;
      setNumber(shape, "radius", radius);
      setNumber(shape, "length", length);
      return;
    }
    collision.withoutVolume = radius == 0.0;
    collision.capsule = makeCapsule(radius, length);
    // A placeholder of a kind that urdfdom accepts; the outline gives the capsule itself.
    shape.SetName("sphere");
    setNumber(shape, "radius", 1.0);
  } else if (name == "mesh") {
    refuseUnknownAttributes(shape, {"filename", "scale"}, owner);
    collision.mesh = xml_.text(shape, "filename", owner);
    const Eigen::Vector3d scale = xml_.vector(shape, "scale", owner, Eigen::Vector3d::Ones());
    if (!(scale.cwiseAbs().minCoeff() > 0.0)) {
      xml_.fail(shape, XmlFile::quote(shape, "scale") + " of " + owner +
                           " must have three factors other than 0");
    }
    setVector(shape, "scale", scale);
  } else {
    xml_.fail(shape, tag(name) + " in <geometry> of " + owner +
                         " is unknown; allowed are box, cylinder, sphere, capsule and mesh");
  }
}

}  // namespace swept::detail
