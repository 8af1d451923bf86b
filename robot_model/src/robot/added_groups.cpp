// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <stdexcept>

#include "robot/group_joints.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

namespace detail {

std::vector<int> pathFromRoot(const std::vector<Link>& links, const std::vector<Joint>& joints,
                              int link) {
  std::vector<int> path;
  for (int joint = links[link].parentJoint; joint >= 0;) {
    path.push_back(joint);
    const int parent = joints[joint].parentLink;
    joint = parent >= 0 ? links[parent].parentJoint : -1;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

Group makeGroup(const std::string& name, const std::set<int>& joints, int tipLink,
                const std::vector<Joint>& all, const std::vector<Variable>& variables) {
  Group group;
  group.name = name;
  group.tipLink = tipLink;
  for (const int j : joints) {
    if (all[j].firstVariable < 0 || all[j].passive) continue;
    group.joints.push_back(j);
    for (int v = all[j].firstVariable;
         v < static_cast<int>(variables.size()) && variables[v].joint == j; ++v)
      group.variables.push_back(v);
  }
  return group;
}

}  // namespace detail

namespace {

void requireFree(const Robot& robot, const std::string& name) {
  if (robot.findGroup(name) != nullptr)
    throw std::invalid_argument("robot '" + robot.name() + "' has a group '" + name + "' already");
}

int linkNamed(const Robot& robot, const std::string& name) {
  const std::optional<int> link = robot.findLink(name);
  if (!link) throw std::invalid_argument("robot '" + robot.name() + "' has no link '" + name + "'");
  return *link;
}

}  // namespace

std::shared_ptr<const Robot> Robot::withGroup(const std::string& name,
                                              std::span<const std::string> joints) const {
  requireFree(*this, name);
  std::set<int> members;
  int tip = -1;
  for (const std::string& joint : joints) {
    const std::optional<int> index = findJoint(joint);
    if (!index) throw std::invalid_argument("robot '" + name_ + "' has no joint '" + joint + "'");
    const Joint& member = joints_[*index];
    if (member.firstVariable < 0)
      throw std::invalid_argument(
          "joint '" + joint + "' has no value of its own: " +
          (member.mimic ? "it follows joint '" + joints_[member.mimic->master].name + "'"
                        : std::string("nothing moves in it")));
    if (member.passive)
      throw std::invalid_argument("joint '" + joint + "' is passive: nothing drives it");
    members.insert(*index);
    tip = std::max(tip, member.childLink);
  }
  std::shared_ptr<Robot> robot(new Robot(*this));
  robot->groups_.push_back(detail::makeGroup(name, members, tip, joints_, variables_));
  return robot;
}

std::shared_ptr<const Robot> Robot::withChain(const std::string& name, const std::string& baseLink,
                                              const std::string& tipLink) const {
  requireFree(*this, name);
  const int tip = linkNamed(*this, tipLink);
  const std::vector<int> toBase = detail::pathFromRoot(links_, joints_, linkNamed(*this, baseLink));
  const std::vector<int> toTip = detail::pathFromRoot(links_, joints_, tip);
  // The parts of the two paths from the root that they do not share.
  const auto [forkBase, forkTip] =
      std::mismatch(toBase.begin(), toBase.end(), toTip.begin(), toTip.end());
  std::set<int> members(forkBase, toBase.end());
  members.insert(forkTip, toTip.end());
  std::shared_ptr<Robot> robot(new Robot(*this));
  robot->groups_.push_back(detail::makeGroup(name, members, tip, joints_, variables_));
  return robot;
}

}  // namespace swept
