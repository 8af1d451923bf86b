// SPDX-License-Identifier: BSD-3-Clause
// Two arms lift a tray between their hands. At every instant the tray stays level, and the second
// hand keeps its pose in the first: example_22_tray MODELS. Exits 0 if all of the path is proven.
#include <iostream>

#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/work_cell.hpp"

using Eigen::Isometry3d, Eigen::Translation3d, Eigen::Vector3d;

/// `tool` is within 2 mm and 0.02 rad of a pose in `reference`.
swept::TaskConstraint holds(const char* tool, const char* reference, const Isometry3d& pose) {
  swept::ConstraintRegion ball{.type = swept::ConstraintRegion::Type::Sphere, .size = {2e-3, 0, 0}};
  ball.reference_from_region.translation() = pose.translation();
  return {.positions = {{.frame = {tool}, .reference = {reference}, .regions = {ball}}},
          .orientations = {{.frame = {tool},
                            .reference = {reference},
                            .orientation = Eigen::Quaterniond(pose.linear()),
                            .tolerance = Vector3d::Constant(0.02)}}};
}

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const auto robot = swept::loadWorkCell(swept::WorkCell::read(models + "/cells/two_rooks.yaml"));
  // The hands point at each other, along the tray's x axis; up is the tools' -x axis.
  const Isometry3d left = Translation3d(-0.17, 0, 0) * Eigen::AngleAxisd(M_PI_2, Vector3d::UnitY());
  const Isometry3d right = Eigen::AngleAxisd(M_PI, Vector3d::UnitZ()) * left;
  const swept::Checker carrying =
      swept::Checker(robot, "both", std::make_shared<const swept::World>())
          .withAttached("tray", "left/tool", swept::makeBox({0.3, 0.2, 0.02}), left.inverse(),
                        {"*/hand", "*/finger_*"});
  swept::TaskConstraint task = holds("right/tool", "left/tool", left.inverse() * right);
  task.add(swept::TaskConstraint::upright("left/tool", 0.05, -Vector3d::UnitX()));
  const auto checker = std::make_shared<const swept::Checker>(carrying.withConstraints(task));

  // Postures of both arms that hold the tray at a place, near those in `q`.
  const auto reach = [&](const Vector3d& place, std::vector<double>& q) {
    swept::TaskConstraint there = task;
    there.add(holds("left/tool", "", Translation3d(place) * left));
    const swept::ConstraintProjection projection(carrying.withConstraints(there));
    swept::ConstraintProjection::Workspace steps(projection);
    return projection.project(q, {}, steps);
  };
  std::vector<double> start{-1.52, 0.83, 0.32,  1.53, -1.54, -1.22, -0.02,
                            1.57,  0.82, -0.38, 1.53, -1.54, 1.18,  1.56};
  const bool starts = reach({0.6, -0.6, 0.35}, start);
  std::vector<double> goal = start;
  if (!starts || !reach({0.55, -0.55, 0.6}, goal)) return 1;
  const auto setup = swept::makeSimpleSetup(checker);
  swept::setStartAndGoal(*setup, *checker, start, goal);
  setup->setPlanner(std::make_shared<swept::CertifiedConnect>(setup->getSpaceInformation()));
  if (setup->solve(20.0) != ompl::base::PlannerStatus::EXACT_SOLUTION) return 2;
  for (const auto& segment : swept::certifyPath(setup->getSolutionPath(), *checker))
    if (segment.verdict != swept::Verdict::Free) return 3;
  std::cout << "carried over " << setup->getSolutionPath().getStateCount() << " states, proven\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 4;
}
