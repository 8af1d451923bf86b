// SPDX-License-Identifier: BSD-3-Clause
#include "io/urdf_elements.hpp"

namespace swept::detail {

UrdfOutline::Link UrdfLinkReader::read(Element& element) {
  UrdfOutline::Link link;
  link.name = xml_.text(element, "name", "");
  link.line = element.GetLineNum();
  const std::string owner = "link '" + link.name + "'";
  reduce(element, {"collision"},
         {"inertial", "visual", "contact", "gravity", "self_collide", "sensor", "origin"}, owner);
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
    const Eigen::Vector3d size = xml_.vector(shape, "size", owner);
    if (!(size.minCoeff() > 0.0)) {
      xml_.fail(shape, XmlFile::quote(shape, "size") + " of " + owner +
                           " must have three sizes greater than 0");
    }
    setVector(shape, "size", size);
  } else if (name == "sphere") {
    setNumber(shape, "radius", xml_.positive(shape, "radius", owner));
  } else if (name == "cylinder") {
    setNumber(shape, "radius", xml_.positive(shape, "radius", owner));
    setNumber(shape, "length", xml_.positive(shape, "length", owner));
  } else if (name == "capsule") {
    const double radius = xml_.positive(shape, "radius", owner);
    collision.capsule = makeCapsule(radius, xml_.positive(shape, "length", owner));
    // A stand-in of a kind that urdfdom accepts; the capsule itself is taken from the outline.
    shape.SetName("sphere");
    setNumber(shape, "radius", 1.0);
  } else if (name == "mesh") {
    xml_.text(shape, "filename", owner);
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
