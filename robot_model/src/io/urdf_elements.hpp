// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml2.h>

#include <initializer_list>
#include <string>
#include <string_view>

#include "io/urdf_outline.hpp"
#include "io/xml.hpp"

namespace swept::detail {

/// What the readers of links and joints share: both check elements and leave them in the reduced
/// form.
class UrdfElements {
 public:
  using Element = tinyxml2::XMLElement;
  using Names = std::initializer_list<std::string_view>;

  explicit UrdfElements(XmlFile& xml) : xml_(xml) {}

  /// Removes what is not in `kept`. Warns of what is not in `ignored` either and has no prefix of a
  /// namespace; refuses it where the robot would be less without: a name of `kept` misspelt, and
  /// what holds geometry.
  void reduce(Element& parent, Names kept, Names ignored, const std::string& owner);

 protected:
  void readOrigin(Element& parent, const std::string& owner);
  /// One of another namespace apart: a misspelt one would leave the default in its place.
  void refuseUnknownAttributes(const Element& element, Names known, const std::string& owner);
  static std::string tag(std::string_view name);
  static void setVector(Element& element, const char* attribute, const Eigen::Vector3d& value);
  static void setNumber(Element& element, const char* attribute, double value);

  XmlFile& xml_;
};

class UrdfLinkReader : UrdfElements {
 public:
  using UrdfElements::UrdfElements;
  UrdfOutline::Link read(Element& element);

 private:
  UrdfOutline::Collision readCollision(Element& element, const std::string& owner);
  void readShape(Element& shape, UrdfOutline::Collision& collision, const std::string& owner);
};

class UrdfJointReader : UrdfElements {
 public:
  using UrdfElements::UrdfElements;
  UrdfOutline::Joint read(Element& element);

 private:
  JointType readType(const Element& element, const std::string& owner);
  void readAxis(Element& joint, JointType type, const std::string& owner);
  void readLimit(Element& joint, JointType type, const std::string& owner);
  void readMimic(Element& joint, UrdfOutline::Joint& outline, const std::string& owner);
};

}  // namespace swept::detail
