// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "acm/contact_search.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/allowed_collision_matrix.hpp"

namespace swept {

namespace {

constexpr int kSamples = 1000;
/// The time for each pair is proportional to the chain between the two, and the total to the cube
/// of the number of links.
constexpr int kMostLinks = 150;
constexpr std::uint64_t kSeed = 1;

std::set<std::pair<int, int>> adjacentLinks(const Robot& robot) {
  std::set<std::pair<int, int>> pairs;
  for (const Joint& joint : robot.joints())
    if (joint.parentLink >= 0) pairs.insert(std::minmax(joint.parentLink, joint.childLink));
  return pairs;
}

}  // namespace

DefaultContacts defaultContacts(const Robot& robot) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return defaultContacts(robot); });
  }
  const detail::KinematicModel model = detail::wholeKinematics(robot);
  const Eigen::VectorXd start = robot.defaultState();
  const std::set<std::pair<int, int>> adjacent = adjacentLinks(robot);
  const int count = static_cast<int>(robot.links().size());
  std::vector<detail::LinkPieces> pieces;
  for (int link = 0; link < count; ++link) pieces.push_back(detail::piecesOf(robot, model, link));
  DefaultContacts contacts;
  if (robot.links().size() > kMostLinks) return contacts;
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
      if (!search.isContact(values)) continue;
      const std::string &nameA = robot.links()[a].name, &nameB = robot.links()[b].name;
      if (search.findApart(kSamples, kSeed))
        contacts.sometimes.emplace_back(nameA, nameB);
      else
        contacts.always.allow(nameA, nameB, std::string(kDefaultContact));
    }
  return contacts;
}

}  // namespace swept
