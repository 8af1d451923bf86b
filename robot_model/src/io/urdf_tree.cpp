// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <set>
#include <vector>

#include "io/urdf_outline.hpp"

namespace swept::detail {

namespace {

using ParentJoints = std::map<std::string, const UrdfOutline::Joint*>;

template <typename Entry>
void checkUnique(const std::vector<Entry>& entries, const std::string& kind,
                 const InputSource& source) {
  std::map<std::string, int> lines;
  for (const Entry& entry : entries) {
    const auto [known, isNew] = lines.emplace(entry.name, entry.line);
    if (!isNew) {
      source.fail(entry.line, "a second " + kind + " is named '" + entry.name +
                                  "'; the first is at line " + std::to_string(known->second));
    }
  }
}

ParentJoints collectParents(const UrdfOutline& outline, const InputSource& source) {
  std::set<std::string> links;
  for (const auto& link : outline.links) links.insert(link.name);
  ParentJoints parents;
  for (const auto& joint : outline.joints) {
    for (const auto& [role, link] : {std::pair{"parent", joint.parent}, {"child", joint.child}}) {
      if (links.contains(link)) continue;
      source.fail(joint.line, "joint '" + joint.name + "': its " + role + " link '" + link +
                                  "' does not exist");
    }
    if (joint.parent == joint.child) {
      source.fail(joint.line,
                  "joint '" + joint.name + "' joins link '" + joint.child + "' to itself");
    }
    const auto [known, isNew] = parents.emplace(joint.child, &joint);
    if (!isNew) {
      source.fail(joint.line, "link '" + joint.child + "' is the child of joint '" +
                                  known->second->name + "' and of joint '" + joint.name +
                                  "'; a link has one parent");
    }
  }
  return parents;
}

/// Fails when walking up from `link` never ends.
void checkAncestry(const std::string& link, const ParentJoints& parents, const InputSource& source,
                   std::set<std::string>& grounded) {
  std::vector<std::string> path;
  std::set<std::string> seen;
  std::string at = link;
  while (!grounded.contains(at)) {
    path.push_back(at);
    const auto joint = parents.find(at);
    if (joint == parents.end()) break;
    if (!seen.insert(at).second) {
      std::string loop;
      for (auto name = path.rbegin(); name != path.rend(); ++name) {
        loop += (loop.empty() ? "'" : " -> '") + *name + "'";
        if (name != path.rbegin() && *name == at) break;
      }
      source.fail(joint->second->line,
                  "the joints form a loop: " + loop + "; links must form a tree");
    }
    at = joint->second->parent;
  }
  grounded.insert(path.begin(), path.end());
}

}  // namespace

void checkTree(const UrdfOutline& outline, const InputSource& source) {
  checkUnique(outline.links, "link", source);
  checkUnique(outline.joints, "joint", source);
  if (outline.links.empty()) source.fail(1, "the robot has no links");
  const ParentJoints parents = collectParents(outline, source);
  std::set<std::string> grounded;
  for (const auto& link : outline.links) checkAncestry(link.name, parents, source, grounded);
  const UrdfOutline::Link* root = nullptr;
  for (const auto& link : outline.links) {
    if (parents.contains(link.name)) continue;
    if (root != nullptr) {
      source.fail(link.line,
                  "links '" + root->name + "' and '" + link.name +
                      "' are both roots; every link but one must be the child of a joint");
    }
    root = &link;
  }
}

void checkMimics(const UrdfOutline& outline, const InputSource& source) {
  std::map<std::string, const UrdfOutline::Joint*> joints;
  for (const auto& joint : outline.joints) joints.emplace(joint.name, &joint);
  for (const auto& joint : outline.joints) {
    if (!joint.mimic) continue;
    if (joint.mimic->joint == joint.name)
      source.fail(joint.mimic->line, "joint '" + joint.name + "' mimics itself");
  }
  for (const auto& joint : outline.joints) {
    std::set<std::string> seen;
    for (const auto* at = &joint; at->mimic; at = joints.at(at->mimic->joint)) {
      if (seen.insert(at->name).second) continue;
      source.fail(at->mimic->line, "joint '" + at->name + "' mimics itself through other joints");
    }
  }
}

}  // namespace swept::detail
