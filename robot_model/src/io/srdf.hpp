// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/input_source.hpp"
#include "io/robot_parts.hpp"

namespace swept::detail {

/// The content of an SRDF, with names not yet looked up. Empty without an SRDF.
struct SrdfDocument {
  struct Name {
    std::string name;
    int line = 0;
  };
  struct VirtualJoint {
    std::string name;
    std::string child;
    std::string parentFrame;  ///< empty: it is not named
    JointType type = JointType::Fixed;
    int line = 0;
  };
  struct Chain {
    std::string base;
    std::string tip;
    int line = 0;
  };
  struct Group {
    std::string name;
    int line = 0;
    std::vector<Chain> chains;
    std::vector<Name> joints;
    std::vector<Name> links;
    std::vector<Name> subgroups;
  };
  struct JointValue {
    std::string joint;
    std::vector<double> values;
    int line = 0;
  };
  struct State {
    std::string name;
    std::string group;
    int line = 0;
    std::vector<JointValue> values;
  };
  struct Pair {
    std::string link1;
    std::string link2;
    std::string reason;
    int line = 0;
    bool enable = false;  ///< from <enable_collisions>: takes the pair back
  };
  struct JointProperty {
    std::string joint;
    std::string name;
    std::string value;
    int line = 0;
  };
  Name robot;
  std::optional<VirtualJoint> virtualJoint;
  std::vector<Group> groups;
  std::vector<State> states;
  std::vector<Pair> pairs;
  std::vector<Name> passive;
  std::vector<Name> uncheckedByDefault;  ///< <disable_default_collisions>
  std::vector<JointProperty> properties;
};

/// Throws InputError for malformed XML, elements that lack something they need, and elements and
/// attributes that no SRDF has.
SrdfDocument readSrdf(const std::string& text, const InputSource& source);

/// Marks passive joints, then adds groups, named states, disabled and enabled pairs to `robot`.
/// SRDFs often keep links and joints of other variants of a robot. A group that names one is left
/// out, with its states. A value of such a joint is left out, and so is a pair with such a link.
/// Warnings say so. Throws InputError.
void applySrdf(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot);

/// Adds the groups; `all` when the SRDF has none.
void addGroups(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot);

/// Adds the pairs that are disabled and enabled.
void addPairs(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot);

}  // namespace swept::detail
