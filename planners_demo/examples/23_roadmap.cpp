// SPDX-License-Identifier: BSD-3-Clause
// A roadmap whose motions stay proven while the world changes: a crate comes and goes, and only
// motions near it are asked about again.
#include <iostream>
#include <memory>
#include <string>

#include "swept/ompl_bridge/certified_roadmap.hpp"
#include "swept/robot_model/named_states.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 23_roadmap MODELS\n";
    return 3;
  }
  const std::string models = argv[1], folder = models + "/robots/rook7/";
  const auto robot = swept::Robot::load(folder + "rook7.urdf", folder + "rook7.srdf");
  const auto world =
      std::make_shared<const swept::World>(swept::World::load(models + "/scenes/narrow_slot.yaml"));
  const auto first = std::make_shared<const swept::Checker>(robot, "arm", world);
  const auto start = swept::namedConfiguration(*robot, first->group(), "home");
  const auto goal = swept::namedConfiguration(*robot, first->group(), "ready");

  swept::CertifiedRoadmap roadmap(first, {.states = 400});
  const std::size_t freeAtFirst = roadmap.freeMotions();
  std::cout << freeAtFirst << " of " << roadmap.graph().motions() << " motions are free\n";

  // Another version of the checker, as a sensor or a program brings it.
  const Eigen::Isometry3d place(Eigen::Translation3d(-0.5, 0.3, 0.5));
  const auto crated = std::make_shared<const swept::Checker>(
      first->withBody("crate", swept::makeBox({0.2, 0.2, 0.2}), place));
  const swept::ProvenGraph::Change change = roadmap.update(crated);
  std::cout << "with a crate: " << change.motionsAsked << " motions are asked about, "
            << change.blocked << " are blocked\n";
  swept::Workspace workspace(*crated);
  const auto path = roadmap.path(start, goal, workspace);
  if (!path) return 1;
  std::cout << "a path of " << path->size() - 1 << " motions\n";

  // Each motion is as a checker says that is asked about all of them.
  bool right = true;
  for (std::size_t i = 0; i + 1 < path->size(); ++i)
    right &= crated->certifyMotion((*path)[i], (*path)[i + 1], workspace).verdict ==
             swept::Verdict::Free;
  for (std::size_t i = 0; i < roadmap.graph().motions(); ++i) {
    const auto [from, to] = roadmap.graph().motion(i);
    const auto verdict =
        crated->certifyMotion(roadmap.graph().state(from), roadmap.graph().state(to), workspace)
            .verdict;
    right &= roadmap.graph().isFree(i) == (verdict == swept::Verdict::Free);
  }
  roadmap.update(first);
  return right && change.blocked > 0 && roadmap.freeMotions() == freeAtFirst ? 0 : 1;
}
