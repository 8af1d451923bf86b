// SPDX-License-Identifier: BSD-3-Clause
#include "io/urdf_elements.hpp"

#include <algorithm>

#include "io/numbers.hpp"

namespace swept::detail {

namespace {

bool contains(UrdfElements::Names names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::string UrdfElements::tag(std::string_view name) {
  return std::string("<").append(name).append(">");
}

void UrdfElements::setVector(Element& element, const char* attribute,
                             const Eigen::Vector3d& value) {
  const std::string text =
      formatNumber(value.x()) + " " + formatNumber(value.y()) + " " + formatNumber(value.z());
  element.SetAttribute(attribute, text.c_str());
}

void UrdfElements::setNumber(Element& element, const char* attribute, double value) {
  element.SetAttribute(attribute, formatNumber(value).c_str());
}

void UrdfElements::readOrigin(Element& parent, const std::string& owner) {
  Element* origin = xml_.onlyChild(parent, "origin", owner);
  if (origin == nullptr) return;
  if (origin->Attribute("quat_xyzw") != nullptr) {
    xml_.fail(*origin, XmlFile::quote(*origin, "quat_xyzw") + " of " + owner +
                           " is not supported; give the rotation as rpy");
  }
  warnUnknownAttributes(*origin, {"xyz", "rpy"}, owner);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  setVector(*origin, "xyz", xml_.vector(*origin, "xyz", owner, zero));
  setVector(*origin, "rpy", xml_.vector(*origin, "rpy", owner, zero));
}

void UrdfElements::warnUnknownAttributes(const Element& element, Names known,
                                         const std::string& owner) {
  for (auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    if (contains(known, a->Name())) continue;
    xml_.source().warn(element.GetLineNum(), std::string("<") + element.Name() + "> of " + owner +
                                                 ": unknown attribute '" + a->Name() +
                                                 "' is ignored");
  }
}

void UrdfElements::reduce(Element& parent, Names kept, Names ignored, const std::string& owner) {
  for (Element* child = parent.FirstChildElement(); child != nullptr;) {
    Element* next = child->NextSiblingElement();
    const std::string_view name = child->Name();
    if (!contains(kept, name)) {
      if (!contains(ignored, name)) {
        xml_.source().warn(child->GetLineNum(),
                           owner + ": unknown element " + tag(name) + " is ignored");
      }
      parent.DeleteChild(child);
    }
    child = next;
  }
}

}  // namespace swept::detail
