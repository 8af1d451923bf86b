// SPDX-License-Identifier: BSD-3-Clause
#include "input/groups.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "command_line/exit_code.hpp"
#include "input/rules.hpp"
#include "input/states.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/did_you_mean.hpp"

namespace swept {
namespace {

/// That of --joints and --chain cannot be that of an SRDF's group, but by intent.
std::string nameOfGroup(const Arguments& args) {
  if (!args.joints.empty()) return "joints " + args.joints;
  if (!args.chain.empty()) return "chain " + args.chain;
  return args.group;
}

template <typename Entry>
std::vector<std::string> namesOf(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

bool hasState(const Robot& robot, const Group& group, const std::string& name) {
  return robot.findNamedState(name, group.name) != nullptr;
}

bool isSomeState(const Robot& robot, const std::string& name) {
  return std::ranges::find(robot.namedStates(), name, &NamedState::name) !=
         robot.namedStates().end();
}

/// Groups with joints that have all the named states among the texts.
std::vector<const Group*> candidates(const Robot& robot, const std::vector<std::string>& states) {
  std::vector<const Group*> groups;
  for (const Group& group : robot.groups()) {
    const bool fits = std::ranges::all_of(states, [&](const std::string& text) {
      return !isSomeState(robot, text) || hasState(robot, group, text);
    });
    if (fits && !group.variables.empty()) groups.push_back(&group);
  }
  return groups;
}

[[noreturn]] void refuseGroup(const Robot& robot, const std::string& name) {
  for (const LeftOut& out : robot.leftOut())
    if (out.group == name && out.state.empty())
      throw UsageError("group '" + name + "' of robot '" + robot.name() +
                       "' is left out: " + out.reason);
  const std::vector<std::string> names = namesOf(robot.groups());
  throw UsageError("robot '" + robot.name() + "' has no group '" + name + "'; it has " +
                   (names.empty() ? "none" : joined(names)) + didYouMean(name, names));
}

const Group& onlyGroup(const Robot& robot, const std::vector<std::string>& states) {
  const std::vector<const Group*> found = candidates(robot, states);
  if (found.size() == 1) return *found.front();
  // It says itself that nothing moves.
  if (robot.groups().size() == 1) return robot.groups().front();
  std::string text = "robot '" + robot.name() + "' has ";
  std::vector<std::string> left;
  for (const LeftOut& out : robot.leftOut())
    if (out.state.empty()) left.push_back("'" + out.group + "', " + out.reason);
  if (robot.groups().empty())
    throw UsageError(text + "no group" + (left.empty() ? "" : "; left out: " + joined(left, "; ")) +
                     "; --joints or --chain makes one");
  throw UsageError(text +
                   "several groups; choose one with --group: " + joined(namesOf(robot.groups())));
}

/// With the group `left/arm+right/arm` of all joints of both, if it asks for one that is not there.
std::shared_ptr<const Robot> withSum(std::shared_ptr<const Robot> robot, const std::string& name) {
  if (name.find('+') == std::string::npos || robot->findGroup(name) != nullptr) return robot;
  std::vector<std::string> joints;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('+', begin), name.size());
    const Group* const group = robot->findGroup(name.substr(begin, end - begin));
    if (group == nullptr) refuseGroup(*robot, name.substr(begin, end - begin));
    for (const int joint : group->joints) {
      const std::string& own = robot->joints()[static_cast<std::size_t>(joint)].name;
      if (std::ranges::find(joints, own) == joints.end()) joints.push_back(own);
    }
    begin = end + 1;
  }
  return robot->withGroup(name, joints);
}

}  // namespace

bool asksForGroup(const Arguments& args) {
  return !nameOfGroup(args).empty();
}

const Group& chooseGroup(const Robot& robot, const std::string& name) {
  if (name.empty()) return onlyGroup(robot, {});
  if (const Group* group = robot.findGroup(name)) return *group;
  refuseGroup(robot, name);
}

const Group& chooseGroup(const Robot& robot, const Arguments& args) {
  return asksForGroup(args) ? chooseGroup(robot, nameOfGroup(args)) : onlyGroup(robot, args.states);
}

std::shared_ptr<const Robot> withAskedGroup(std::shared_ptr<const Robot> robot,
                                            const Arguments& args) {
  if (args.joints.empty() && args.chain.empty()) return withSum(std::move(robot), args.group);
  try {
    if (!args.joints.empty())
      return robot->withGroup(nameOfGroup(args), splitAtCommas(args.joints));
    const auto [base, tip] = namesOfPair("--chain", args.chain);
    return robot->withChain(nameOfGroup(args), base, tip);
  } catch (const std::invalid_argument& error) {
    const bool joints = !args.joints.empty();
    std::string text = (joints ? "--joints '" + args.joints : "--chain '" + args.chain) + "': ";
    text += error.what();
    const std::vector<std::string> known =
        joints ? namesOf(robot->joints()) : namesOf(robot->links());
    for (const std::string& name : splitAtCommas(joints ? args.joints : args.chain))
      if (std::ranges::find(known, name) == known.end())
        throw UsageError(text + didYouMean(name, known));
    throw UsageError(text);
  }
}

}  // namespace swept
