// SPDX-License-Identifier: BSD-3-Clause
// The robot of a ClearanceCase.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "clearance_case.hpp"

namespace {

using Eigen::Vector3d;

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

}  // namespace

/// Pieces near the link's origin, and one up to `reach` (m) away from it.
std::string ClearanceCase::linkText(const std::string& name, double reach) {
  Body body{.name = name, .link = name, .parts = {}};
  std::string text = "<link name=\"" + name + "\">";
  const int count = 1 + random_.below(4);
  for (int i = 0; i < count; ++i) {
    RandomPiece piece = pieces_.ofLink();
    const Vector3d place = i == 0 ? pieces_.away(0.1, reach) : pieces_.away(0.05, 0.35);
    const Vector3d rpy = 3.0 * random_.inCube();
    piece.body_from_shape.linear() = turnOf(rpy);
    piece.body_from_shape.translation() = place;
    text += "<collision>" + urdfOrigin(place, rpy) + "<geometry>" + piece.urdf +
            "</geometry></collision>";
    body.parts.push_back(partOf(piece));
  }
  robot_.push_back(std::move(body));
  return text + "</link>";
}

std::string ClearanceCase::jointText(int index, const std::string& parent,
                                     const std::string& child) {
  const std::string limits = R"(<limit lower="-2.8" upper="2.7" effort="1" velocity="1"/>)";
  const std::string slide = R"(<limit lower="-0.2" upper="0.3" effort="1" velocity="1"/>)";
  const double kind = random_.uniform(0.0, 1.0);
  const bool first = index == 1;
  std::string type = "revolute", more = limits;
  std::string axis = "<axis xyz=\"" + urdfText(random_.direction()) + "\"/>";
  if (first && kind < 0.08) {
    type = "planar";
    axis = R"(<axis xyz="0 0 1"/>)";
    more.clear();
  } else if (first && kind < 0.14) {
    type = "floating";
    axis.clear();
    more.clear();
  } else if (!first && kind < 0.1) {
    type = "fixed";
    axis.clear();
    more.clear();
  } else if (kind < 0.3) {
    type = "prismatic";
    more = slide;
  } else if (kind < 0.6) {
    type = "continuous";
    more.clear();
  }
  const Vector3d place = pieces_.away(0.0, 0.4);
  return "<joint name=\"j" + std::to_string(index) + "\" type=\"" + type + "\"><parent link=\"" +
         parent + "\"/><child link=\"" + child + "\"/>" +
         urdfOrigin(place, 3.0 * random_.inCube()) + axis + more + "</joint>";
}

void ClearanceCase::makeRobot(const std::filesystem::path& folder) {
  const int joints = 1 + random_.below(4);
  std::vector<std::string> names{"base"};
  std::string links = linkText("base", 0.3);
  std::string bare = "<link name=\"base\"/>";
  std::string tree;
  for (int i = 1; i <= joints; ++i) {
    const std::string name = "l" + std::to_string(i);
    const std::size_t parent = random_.chance(0.7)
                                   ? names.size() - 1
                                   : static_cast<std::size_t>(random_.below(names.size()));
    links += linkText(name, random_.chance(0.6) ? 2.0 : 0.4);
    bare += "<link name=\"" + name + "\"/>";
    tree += jointText(i, names[parent], name);
    names.push_back(name);
  }
  const std::string begin = "<robot name=\"r\">", end = "</robot>";
  write(folder / "robot.urdf", begin + links + tree + end);
  // The oracle is asked for poses only, and does not read every shape.
  write(folder / "bare.urdf", begin + bare + tree + end);
  loaded_ = swept::Robot::load(folder / "robot.urdf");
  arm_ = std::make_unique<oracle::Arm>(folder / "bare.urdf", "");
  for (const int v : loaded_->findGroup("all")->variables) {
    const auto& known = arm_->variables();
    const auto found = std::ranges::find(
        known, loaded_->variables()[static_cast<std::size_t>(v)].name, &oracle::ArmVariable::name);
    if (found == known.end()) throw std::runtime_error("the oracle lacks a variable");
    place_.push_back(static_cast<int>(found - known.begin()));
  }
}

/// All of the oracle's variables. Joints in the middle are frequent: a chain that is stretched gets
/// as far as bounds on its reach say.
std::vector<double> ClearanceCase::randomState() {
  std::vector<double> q;
  for (const oracle::ArmVariable& variable : arm_->variables()) {
    constexpr double kFar = 0.4;  // m, of what has no limits
    const bool limited = std::isfinite(variable.lower) && std::isfinite(variable.upper);
    const double most = variable.cyclic ? std::numbers::pi : limited ? variable.upper : kFar;
    const double least = variable.cyclic ? -std::numbers::pi : limited ? variable.lower : -kFar;
    q.push_back(random_.chance(0.3) ? 0.0 : random_.uniform(least, most));
  }
  for (const oracle::ArmJoint& joint : arm_->joints()) {
    if (joint.type != "floating") continue;
    const Eigen::Quaterniond turned(pieces_.turned(Vector3d::Zero()).linear());
    std::copy_n(turned.coeffs().data(), 4, q.begin() + joint.variable + 3);
  }
  return q;
}
