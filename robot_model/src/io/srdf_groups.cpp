// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "io/srdf.hpp"
#include "robot/group_joints.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept::detail {

namespace {

/// Joints and links that a group holds, by index.
struct Members {
  std::set<int> joints;
  std::set<int> links;
  int depth = 1;        ///< groups in each other, this one included
  std::string missing;  ///< the first that the URDF lacks, in words; empty: it has all
  int missingLine = 0;
};

class GroupResolver {
 public:
  GroupResolver(const SrdfDocument& srdf, const InputSource& source, const RobotParts& robot)
      : srdf_(srdf),
        source_(source),
        robot_(robot),
        progress_(srdf.groups.size(), Progress::New),
        members_(srdf.groups.size()) {}

  /// Returns nothing where the URDF lacks a member; it then warns and adds an entry to `leftOut`.
  std::optional<Group> resolve(int index, std::vector<LeftOut>& leftOut);

 private:
  enum class Progress : std::uint8_t { New, Open, Done };

  /// `level`: 1 for a group that no other group contains.
  const Members& members(int index, int line, int level);
  void requireShallow(int depth, int line, const SrdfDocument::Group& group) const;
  /// Returns -1 where there is none, and records it in `result`.
  int link(const std::string& name, int line, Members& result) const;
  void addChain(const SrdfDocument::Chain& chain, Members& result) const;

  const SrdfDocument& srdf_;
  const InputSource& source_;
  const RobotParts& robot_;
  std::vector<Progress> progress_;
  std::vector<Members> members_;
};

/// The first counts.
void setMissing(Members& result, const std::string& what, int line) {
  if (!result.missing.empty()) return;
  result.missing = what;
  result.missingLine = line;
}

int GroupResolver::link(const std::string& name, int line, Members& result) const {
  const int index = indexOf(robot_.links, name);
  if (index < 0) setMissing(result, "link '" + name + "' does not exist", line);
  return index;
}

/// The joints between the two links: those that are on only one of their paths from the root.
void GroupResolver::addChain(const SrdfDocument::Chain& chain, Members& result) const {
  const int base = link(chain.base, chain.line, result);
  const int tip = link(chain.tip, chain.line, result);
  if (base < 0 || tip < 0) return;
  const std::vector<int> toBase = pathFromRoot(robot_.links, robot_.joints, base);
  const std::vector<int> toTip = pathFromRoot(robot_.links, robot_.joints, tip);
  const auto [forkBase, forkTip] =
      std::mismatch(toBase.begin(), toBase.end(), toTip.begin(), toTip.end());
  result.links.insert({base, tip});
  for (auto [at, end] : {std::pair{forkBase, toBase.end()}, {forkTip, toTip.end()}}) {
    for (; at != end; ++at) {
      result.joints.insert(*at);
      result.links.insert(robot_.joints[*at].childLink);
    }
  }
}

/// On the way down for the stack's sake; on the way up as well, so that the order of groups does
/// not matter.
void GroupResolver::requireShallow(int depth, int line, const SrdfDocument::Group& group) const {
  if (depth <= kMaxNesting) return;
  source_.fail(line, "group '" + group.name + "': groups are nested deeper than " +
                         std::to_string(kMaxNesting));
}

const Members& GroupResolver::members(int index, int line, int level) {
  const SrdfDocument::Group& group = srdf_.groups[index];
  if (progress_[index] == Progress::Done) return members_[index];
  if (progress_[index] == Progress::Open) {
    source_.fail(line, "group '" + group.name + "' contains itself");
  }
  requireShallow(level, line, group);
  progress_[index] = Progress::Open;
  Members result;
  for (const auto& chain : group.chains) addChain(chain, result);
  for (const auto& [name, at] : group.joints) {
    const int joint = indexOf(robot_.joints, name);
    if (joint < 0) {
      setMissing(result, "joint '" + name + "' does not exist", at);
      continue;
    }
    result.joints.insert(joint);
    result.links.insert(robot_.joints[joint].childLink);
  }
  for (const auto& [name, at] : group.links) {
    const int member = link(name, at, result);
    if (member < 0) continue;
    result.links.insert(member);
    if (robot_.links[member].parentJoint >= 0)
      result.joints.insert(robot_.links[member].parentJoint);
  }
  for (const auto& [name, at] : group.subgroups) {
    const int subgroup = indexOf(srdf_.groups, name);
    if (subgroup < 0) {
      setMissing(result, "group '" + name + "' does not exist", at);
      continue;
    }
    const Members& inner = members(subgroup, at, level + 1);
    if (!inner.missing.empty())
      setMissing(result, "its group '" + name + "' is left out: " + inner.missing, at);
    result.depth = std::max(result.depth, inner.depth + 1);
    requireShallow(result.depth, at, group);
    result.joints.insert(inner.joints.begin(), inner.joints.end());
    result.links.insert(inner.links.begin(), inner.links.end());
  }
  progress_[index] = Progress::Done;
  members_[index] = std::move(result);
  return members_[index];
}

/// MoveIt's planar joint with this property turns, drives and turns. Those are other motions than
/// the ones checked here. Returns what is wrong with the joint, or an empty text.
std::string otherMotion(const SrdfDocument& srdf, const InputSource& source,
                        const std::string& joint) {
  for (const SrdfDocument::JointProperty& property : srdf.properties) {
    if (property.joint != joint || property.name != "motion_model" || property.value == "holonomic")
      continue;
    return "joint '" + joint + "' has the motion_model '" + property.value + "' (" + source.name() +
           ":" + std::to_string(property.line) + "); 'holonomic' is supported";
  }
  return {};
}

/// The same for the first of a group's joints that has a problem.
std::string otherMotionOf(const Group& group, const SrdfDocument& srdf, const InputSource& source,
                          const std::vector<Joint>& joints) {
  for (const int j : group.joints)
    if (std::string other = otherMotion(srdf, source, joints[j].name); !other.empty()) return other;
  return {};
}

void leaveOut(const std::string& group, const std::string& why, int line, const InputSource& source,
              std::vector<LeftOut>& leftOut) {
  source.warn(line, "group '" + group + "' is left out: " + why);
  leftOut.push_back({group, {}, source.name() + ":" + std::to_string(line) + ": " + why});
}

std::optional<Group> GroupResolver::resolve(int index, std::vector<LeftOut>& leftOut) {
  const SrdfDocument::Group& given = srdf_.groups[index];
  Members found = members(index, given.line, 1);
  int tip = found.links.empty() ? -1 : *found.links.rbegin();
  if (!given.chains.empty()) tip = indexOf(robot_.links, given.chains.back().tip);
  Group group = makeGroup(given.name, found.joints, tip, robot_.joints, robot_.variables);
  const std::string other = otherMotionOf(group, srdf_, source_, robot_.joints);
  if (!other.empty()) setMissing(found, other, given.line);
  if (!found.missing.empty()) {
    leaveOut(given.name, found.missing, found.missingLine, source_, leftOut);
    return std::nullopt;
  }
  if (group.joints.empty()) {
    source_.warn(given.line, "group '" + given.name + "' has no joint that can be planned for");
  }
  return group;
}

}  // namespace

void addGroups(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot) {
  for (std::size_t i = 0; i < srdf.groups.size(); ++i) {
    const auto& group = srdf.groups[i];
    if (indexOf(srdf.groups, group.name) != static_cast<int>(i)) {
      source.fail(group.line, "a second group is named '" + group.name + "'");
    }
  }
  GroupResolver resolver(srdf, source, robot);
  for (std::size_t i = 0; i < srdf.groups.size(); ++i) {
    if (auto group = resolver.resolve(static_cast<int>(i), robot.leftOut))
      robot.groups.push_back(std::move(*group));
  }
  if (!srdf.groups.empty()) return;
  std::set<int> every;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) every.insert(static_cast<int>(j));
  const int last = static_cast<int>(robot.links.size()) - 1;
  Group all = makeGroup("all", every, last, robot.joints, robot.variables);
  const std::string other = otherMotionOf(all, srdf, source, robot.joints);
  if (other.empty())
    robot.groups.push_back(std::move(all));
  else
    leaveOut("all", other, srdf.robot.line, source, robot.leftOut);
}

}  // namespace swept::detail
