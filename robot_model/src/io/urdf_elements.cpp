// SPDX-License-Identifier: BSD-3-Clause
#include "io/urdf_elements.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "text/numbers.hpp"

namespace swept::detail {

namespace {

bool contains(UrdfElements::Names names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool hasPrefix(std::string_view name) {
  return name.find(':') != std::string_view::npos;
}

std::string listOf(UrdfElements::Names names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// The edit distance: how many letters have to be changed, inserted or removed. Case does not
/// count.
std::size_t editsBetween(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t same = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({same, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

bool isMisspelt(std::string_view name, std::string_view key) {
  constexpr std::size_t kLongest = 64;  // no key is nearly as long
  if (name.size() > kLongest) return false;
  return editsBetween(name, key) <= (key.size() < 5 ? 1 : 2);
}

bool holdsGeometry(const tinyxml2::XMLElement& element) {
  if (isMisspelt(element.Name(), "geometry") || isMisspelt(element.Name(), "collision"))
    return true;
  const auto* child = element.FirstChildElement();
  for (; child != nullptr; child = child->NextSiblingElement())
    if (holdsGeometry(*child)) return true;
  return false;
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
  refuseUnknownAttributes(*origin, {"xyz", "rpy"}, owner);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  setVector(*origin, "xyz", xml_.vector(*origin, "xyz", owner, zero));
  setVector(*origin, "rpy", xml_.vector(*origin, "rpy", owner, zero));
}

void UrdfElements::refuseUnknownAttributes(const Element& element, Names known,
                                           const std::string& owner) {
  for (auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    if (contains(known, a->Name()) || hasPrefix(a->Name())) continue;
    xml_.fail(element, tag(element.Name()) + " of " + owner + ": unknown attribute '" + a->Name() +
                           "'; allowed are " + listOf(known));
  }
}

void UrdfElements::reduce(Element& parent, Names kept, Names ignored, const std::string& owner) {
  for (Element* child = parent.FirstChildElement(); child != nullptr;) {
    Element* next = child->NextSiblingElement();
    const std::string_view name = child->Name();
    if (name.starts_with("xacro:"))
      xml_.fail(*child, tag(name) +
                            " is not expanded; run xacro on the file first, or let swept "
                            "do it with --xacro");
    if (!contains(kept, name)) {
      if (!contains(ignored, name) && !hasPrefix(name)) {
        const std::string unknown = owner + ": unknown element " + tag(name);
        for (const std::string_view key : kept)
          if (isMisspelt(name, key)) xml_.fail(*child, unknown + "; is " + tag(key) + " meant?");
        if (holdsGeometry(*child))
          xml_.fail(*child, unknown + " holds geometry; allowed are " + listOf(kept));
        xml_.source().warn(child->GetLineNum(), unknown + " is ignored");
      }
      parent.DeleteChild(child);
    }
    child = next;
  }
}

}  // namespace swept::detail
