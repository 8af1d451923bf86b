// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <vector>

#include "io/srdf.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept::detail {

namespace {

/// Joints and links that a group holds, by index.
struct Members {
  std::set<int> joints;
  std::set<int> links;
  int depth = 1;  ///< groups in each other, this one included
};

class GroupResolver {
 public:
  GroupResolver(const SrdfDocument& srdf, const InputSource& source, const RobotParts& robot)
      : srdf_(srdf),
        source_(source),
        robot_(robot),
        progress_(srdf.groups.size(), Progress::New),
        members_(srdf.groups.size()) {}

  Group resolve(int index);

 private:
  enum class Progress : std::uint8_t { New, Open, Done };

  /// `level`: 1 for a group that is not asked for by another.
  const Members& members(int index, int line, int level);
  void requireShallow(int depth, int line, const SrdfDocument::Group& group) const;
  int link(const std::string& name, int line, const SrdfDocument::Group& group) const;
  void addChain(const SrdfDocument::Chain& chain, const SrdfDocument::Group& group,
                Members& result) const;
  std::vector<int> pathFromRoot(int link) const;

  const SrdfDocument& srdf_;
  const InputSource& source_;
  const RobotParts& robot_;
  std::vector<Progress> progress_;
  std::vector<Members> members_;
};

int GroupResolver::link(const std::string& name, int line, const SrdfDocument::Group& group) const {
  const int index = indexOf(robot_.links, name);
  if (index < 0)
    source_.fail(line, "group '" + group.name + "': link '" + name + "' does not exist");
  return index;
}

/// Joints from the root down to the link.
std::vector<int> GroupResolver::pathFromRoot(int link) const {
  std::vector<int> path;
  for (int joint = robot_.links[link].parentJoint; joint >= 0;) {
    path.push_back(joint);
    const int parent = robot_.joints[joint].parentLink;
    joint = parent >= 0 ? robot_.links[parent].parentJoint : -1;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

/// The joints between the two links: what their paths from the root do not share.
void GroupResolver::addChain(const SrdfDocument::Chain& chain, const SrdfDocument::Group& group,
                             Members& result) const {
  const int base = link(chain.base, chain.line, group);
  const int tip = link(chain.tip, chain.line, group);
  const std::vector<int> toBase = pathFromRoot(base);
  const std::vector<int> toTip = pathFromRoot(tip);
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
  for (const auto& chain : group.chains) addChain(chain, group, result);
  for (const auto& [name, at] : group.joints) {
    const int joint = indexOf(robot_.joints, name);
    if (joint < 0)
      source_.fail(at, "group '" + group.name + "': joint '" + name + "' does not exist");
    result.joints.insert(joint);
    result.links.insert(robot_.joints[joint].childLink);
  }
  for (const auto& [name, at] : group.links) {
    const int member = link(name, at, group);
    result.links.insert(member);
    if (robot_.links[member].parentJoint >= 0)
      result.joints.insert(robot_.links[member].parentJoint);
  }
  for (const auto& [name, at] : group.subgroups) {
    const int subgroup = indexOf(srdf_.groups, name);
    if (subgroup < 0)
      source_.fail(at, "group '" + group.name + "': group '" + name + "' does not exist");
    const Members& inner = members(subgroup, at, level + 1);
    result.depth = std::max(result.depth, inner.depth + 1);
    requireShallow(result.depth, at, group);
    result.joints.insert(inner.joints.begin(), inner.joints.end());
    result.links.insert(inner.links.begin(), inner.links.end());
  }
  progress_[index] = Progress::Done;
  members_[index] = std::move(result);
  return members_[index];
}

/// Keeps the joints that have variables and a motor, in the robot's order: parents first.
Group makeGroup(const std::string& name, const std::set<int>& joints, int tipLink,
                const RobotParts& robot) {
  Group group;
  group.name = name;
  group.tipLink = tipLink;
  for (const int j : joints) {
    if (robot.joints[j].firstVariable < 0 || robot.passive[j]) continue;
    group.joints.push_back(j);
    for (int v = robot.joints[j].firstVariable;
         v < static_cast<int>(robot.variables.size()) && robot.variables[v].joint == j; ++v) {
      group.variables.push_back(v);
    }
  }
  return group;
}

Group GroupResolver::resolve(int index) {
  const SrdfDocument::Group& given = srdf_.groups[index];
  const Members& found = members(index, given.line, 1);
  int tip = found.links.empty() ? -1 : *found.links.rbegin();
  if (!given.chains.empty()) tip = indexOf(robot_.links, given.chains.back().tip);
  Group group = makeGroup(given.name, found.joints, tip, robot_);
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
    robot.groups.push_back(resolver.resolve(static_cast<int>(i)));
  }
  if (!robot.groups.empty()) return;
  std::set<int> every;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) every.insert(static_cast<int>(j));
  robot.groups.push_back(makeGroup("all", every, static_cast<int>(robot.links.size()) - 1, robot));
}

}  // namespace swept::detail
