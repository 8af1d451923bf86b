// SPDX-License-Identifier: BSD-3-Clause
// Plans with OMPL, and gives the controller a trajectory that is proven as it executes it: blended
// at the corners, timed, with a tube for what the controller may be off by.
//   example_16_plan_trajectory MODELS
// Writes the message for ROS. Exits 0 if all of it is proven.
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <filesystem>
#include <iostream>

#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/trajectory_file.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::string arm = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  const auto world =
      std::make_shared<const swept::World>(swept::World::load(models + "/scenes/narrow_slot.yaml"));
  const auto checker = std::make_shared<const swept::Checker>(robot, "arm", world);

  const auto setup = swept::makeSimpleSetup(checker);
  swept::setStartAndGoal(*setup, *checker,
                         swept::namedConfiguration(*robot, checker->group(), "home"),
                         swept::namedConfiguration(*robot, checker->group(), "ready"));
  setup->setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup->getSpaceInformation()));

  // Velocities are those of the URDF; RateLimits::read() reads MoveIt's joint_limits.yaml.
  swept::RateLimits limits = swept::RateLimits::of(*robot, checker->group());
  for (double& limit : limits.acceleration) limit = 3.0;  // rad/s^2
  const swept::TrackingTolerance tube{{.rotation = 0.005}, {}};
  const swept::PlannedTrajectory planned = swept::planTrajectory(*setup, limits, tube);
  if (!planned.isProven()) return 1;

  const swept::TimedPath& timed = planned.trajectory->timed;
  std::cout << timed.trajectory.points.size() << " points, " << timed.curve.duration() << " s\n";
  for (const swept::TimedCorner& corner : timed.corners)
    std::cout << "way point " << corner.wayPoint << ": " << (corner.stops() ? "stops" : "blended")
              << ", off by " << corner.deviation << " rad\n";
  const auto file = std::filesystem::temp_directory_path() / "swept_example_trajectory.yaml";
  swept::writeTrajectory(file, timed.trajectory);
  return planned.trajectory->certificate.violations.empty() ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
