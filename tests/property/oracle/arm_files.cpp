// SPDX-License-Identifier: BSD-3-Clause
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "arm.hpp"

namespace oracle {
namespace {

using tinyxml2::XMLElement;

std::string text(const XMLElement& element, const char* attribute) {
  const char* value = element.Attribute(attribute);
  return value ? value : "";
}

double number(const XMLElement* element, const char* attribute, double otherwise) {
  return element ? element->DoubleAttribute(attribute, otherwise) : otherwise;
}

Vector3d triple(const XMLElement* element, const char* attribute, const Vector3d& otherwise) {
  if (!element || !element->Attribute(attribute)) return otherwise;
  std::istringstream in(element->Attribute(attribute));
  Vector3d v;
  in >> v[0] >> v[1] >> v[2];
  return v;
}

Eigen::Matrix3d turn(const Vector3d& rpy) {
  const Eigen::Array3d c = rpy.array().cos(), s = rpy.array().sin();
  Eigen::Matrix3d x, y, z;
  x << 1, 0, 0, 0, c[0], -s[0], 0, s[0], c[0];
  y << c[1], 0, s[1], 0, 1, 0, -s[1], 0, c[1];
  z << c[2], -s[2], 0, s[2], c[2], 0, 0, 0, 1;
  return z * y * x;
}

Isometry3d origin(const XMLElement& element) {
  const XMLElement* o = element.FirstChildElement("origin");
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = turn(triple(o, "rpy", Vector3d::Zero()));
  pose.translation() = triple(o, "xyz", Vector3d::Zero());
  return pose;
}

/// `package://a/b/c`, `file://` or a relative path: whatever exists at or above the file's folder.
std::filesystem::path meshPath(std::string name, std::filesystem::path folder) {
  for (const std::string& scheme : {std::string("package://"), std::string("file://")})
    if (name.rfind(scheme, 0) == 0) name = name.substr(scheme.size());
  folder = std::filesystem::absolute(folder);
  for (; folder.has_relative_path(); folder = folder.parent_path())
    if (std::filesystem::exists(folder / name)) return folder / name;
  throw std::runtime_error("no mesh " + name);
}

Piece piece(const XMLElement& geometry, const std::filesystem::path& folder) {
  if (const auto* e = geometry.FirstChildElement("sphere"))
    return Piece(Sphere{number(e, "radius", 0)});
  if (const auto* e = geometry.FirstChildElement("box"))
    return Piece(Box{triple(e, "size", Vector3d::Zero()) / 2});
  if (const auto* e = geometry.FirstChildElement("cylinder"))
    return Piece(Cylinder{number(e, "radius", 0), number(e, "length", 0) / 2});
  const auto* e = geometry.FirstChildElement("mesh");
  if (!e) throw std::runtime_error("unknown geometry");
  return Piece(std::make_shared<Mesh>(
      Mesh::read(meshPath(text(*e, "filename"), folder), triple(e, "scale", Vector3d::Ones()))));
}

template <class Use>
void forEach(const XMLElement& parent, const char* name, Use use) {
  for (auto* e = parent.FirstChildElement(name); e; e = e->NextSiblingElement(name)) use(*e);
}

const XMLElement& load(tinyxml2::XMLDocument& document, const std::filesystem::path& file) {
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS)
    throw std::runtime_error(file.string() + ": " + document.ErrorStr());
  return *document.RootElement();
}

}  // namespace

Arm::Arm(const std::filesystem::path& urdf, const std::filesystem::path& srdf) {
  readUrdf(urdf);
  if (!srdf.empty()) readSrdf(srdf);
  addVariables();
}

void Arm::readUrdf(const std::filesystem::path& file) {
  tinyxml2::XMLDocument document;
  const XMLElement& robot = load(document, file);
  forEach(robot, "link", [&](const XMLElement& e) {
    Body body{text(e, "name"), {}};
    forEach(e, "collision", [&](const XMLElement& c) {
      body.pieces.push_back(piece(*c.FirstChildElement("geometry"), file.parent_path()));
      body.pieces.back().body_from_piece = origin(c);
    });
    links_.push_back(std::move(body));
  });
  std::vector<ArmJoint> found;
  forEach(robot, "joint", [&](const XMLElement& e) {
    ArmJoint j;
    j.name = text(e, "name");
    j.type = text(e, "type");
    j.parent = link(text(*e.FirstChildElement("parent"), "link"));
    j.child = link(text(*e.FirstChildElement("child"), "link"));
    j.parent_from_joint = origin(e);
    j.axis = triple(e.FirstChildElement("axis"), "xyz", Vector3d::UnitX());
    if (j.type != "fixed") j.axis.normalize();
    const XMLElement* limit = e.FirstChildElement("limit");
    j.lower = number(limit, "lower", 0);
    j.upper = number(limit, "upper", 0);
    if (const auto* m = e.FirstChildElement("mimic")) {
      j.mimics = text(*m, "joint");
      j.multiplier = number(m, "multiplier", 1);
      j.offset = number(m, "offset", 0);
    }
    found.push_back(j);
  });
  // Parents first: take any joint whose parent link is a root or has been reached.
  std::vector<char> reached(links_.size(), 1);
  for (const ArmJoint& j : found) reached[j.child] = 0;
  while (!found.empty()) {
    const auto next = std::find_if(found.begin(), found.end(),
                                   [&](const ArmJoint& j) { return reached[j.parent]; });
    if (next == found.end()) throw std::runtime_error("joints form a loop");
    reached[next->child] = 1;
    joints_.push_back(*next);
    found.erase(next);
  }
}

void Arm::readSrdf(const std::filesystem::path& file) {
  tinyxml2::XMLDocument document;
  const XMLElement& root = load(document, file);
  forEach(root, "disable_collisions", [&](const XMLElement& e) {
    disabled_.insert(std::minmax(text(e, "link1"), text(e, "link2")));
  });
  forEach(root, "virtual_joint", [&](const XMLElement& e) {
    ArmJoint j;
    j.name = text(e, "name");
    j.type = text(e, "type");
    j.axis = Vector3d::UnitZ();
    j.child = link(text(e, "child_link"));
    joints_.insert(joints_.begin(), j);
  });
  auto jointAbove = [&](int child) -> const ArmJoint* {
    for (const ArmJoint& j : joints_)
      if (j.child == child) return &j;
    return nullptr;
  };
  forEach(root, "group", [&](const XMLElement& e) {
    std::set<std::string>& members = groups_[text(e, "name")];
    forEach(e, "joint", [&](const XMLElement& m) { members.insert(text(m, "name")); });
    forEach(e, "link", [&](const XMLElement& m) {
      if (const ArmJoint* j = jointAbove(link(text(m, "name")))) members.insert(j->name);
    });
    forEach(e, "chain", [&](const XMLElement& m) {
      const int base = link(text(m, "base_link"));
      for (int at = link(text(m, "tip_link")); at != base;) {
        const ArmJoint* j = jointAbove(at);
        if (!j || j->parent < 0) throw std::runtime_error("chain without its base");
        members.insert(j->name);
        at = j->parent;
      }
    });
    forEach(e, "group",
            [&](const XMLElement& m) { members.merge(std::set(groups_[text(m, "name")])); });
  });
}

void Arm::addVariables() {
  const double inf = INFINITY;
  for (ArmJoint& j : joints_) {
    if (j.type == "fixed" || !j.mimics.empty()) continue;
    j.variable = static_cast<int>(variables_.size());
    auto add = [&](const std::string& suffix, double lower, double upper, bool cyclic) {
      variables_.push_back({j.name + suffix, lower, upper, cyclic});
    };
    if (j.type == "planar") {
      add("/x", -inf, inf, false);
      add("/y", -inf, inf, false);
      add("/theta", -inf, inf, true);
    } else if (j.type == "floating") {
      for (const char* s : {"/trans_x", "/trans_y", "/trans_z"}) add(s, -inf, inf, false);
      for (const char* s : {"/rot_x", "/rot_y", "/rot_z", "/rot_w"}) add(s, -1, 1, false);
    } else if (j.type == "continuous") {
      add("", -inf, inf, true);
    } else {
      add("", j.lower, j.upper, false);
    }
  }
  // A follower of a follower follows the first one, its own rule applied last.
  auto named = [&](const std::string& name) -> const ArmJoint& {
    return *std::find_if(joints_.begin(), joints_.end(),
                         [&](const ArmJoint& j) { return j.name == name; });
  };
  for (ArmJoint& j : joints_) {
    for (std::string at = j.mimics; !at.empty();) {
      const ArmJoint& master = named(at);
      if (master.mimics.empty()) {
        j.variable = master.variable;
        break;
      }
      j.offset += j.multiplier * master.offset;
      j.multiplier *= master.multiplier;
      at = j.mimics = master.mimics;
    }
  }
}

}  // namespace oracle
