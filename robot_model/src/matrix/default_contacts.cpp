// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "matrix/contact_search.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/collision_matrix.hpp"

namespace swept {

namespace {

std::set<std::pair<int, int>> adjacentLinks(const Robot& robot) {
  std::set<std::pair<int, int>> pairs;
  for (const Joint& joint : robot.joints())
    if (joint.parentLink >= 0) pairs.insert(std::minmax(joint.parentLink, joint.childLink));
  return pairs;
}

}  // namespace

CollisionRules allowDefaultContacts(const Robot& robot) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return allowDefaultContacts(robot); });
  }
  const detail::KinematicModel model = detail::wholeKinematics(robot);
  const Eigen::VectorXd start = robot.defaultState();
  const std::set<std::pair<int, int>> adjacent = adjacentLinks(robot);
  const int count = static_cast<int>(robot.links().size());
  std::vector<detail::LinkPieces> pieces;
  for (int link = 0; link < count; ++link) pieces.push_back(detail::piecesOf(robot, model, link));
  CollisionRules rules;
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      if (pieces[a].pieces.empty() || pieces[b].pieces.empty() || adjacent.contains({a, b}))
        continue;
      const detail::LinkChain chain(robot, model, model.bodyOfLink[a], model.bodyOfLink[b]);
      if (chain.variables().empty()) continue;
      detail::LinkChain::Place place;
      chain.startFrom(start, place);
      detail::ContactSearch search(pieces[a], pieces[b], chain, 0.0, place);
      detail::ContactSearch::Values values;
      for (const int v : chain.variables()) values.push_back(start[v]);
      if (search.isContact(values))
        rules.allow(robot.links()[a].name, robot.links()[b].name, std::string(kDefaultContact));
    }
  return rules;
}

}  // namespace swept
