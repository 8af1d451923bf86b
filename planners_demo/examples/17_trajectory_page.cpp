// SPDX-License-Identifier: BSD-3-Clause
// A page that plays a trajectory in real time: the curve that a controller makes of a few points,
// proven with all that the controller tolerates beside it, plotted with its limits.
//   example_17_trajectory_page MODELS [FILE.html]
// Exits 0 if the page says that the trajectory is free and within its limits.
#include <filesystem>
#include <iostream>
#include <limits>

#include "swept/pages/page.hpp"
#include "swept/robot_model/joint_trajectory.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::string arm = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  const auto world =
      std::make_shared<const swept::World>(swept::World::load(models + "/scenes/shelf.yaml"));
  swept::CheckerOptions options;
  options.tracking.rotation = 0.005;  // rad, of each joint: constraints.JOINT.trajectory
  const auto checker = std::make_shared<const swept::Checker>(robot, "arm", world, options);

  // From one compartment of the shelf to another: way points 0.8 s apart, passed at the mean
  // velocity of both sides. The controller makes cubics of them.
  const std::vector<std::vector<double>> states{
      {0.23, 0.53, 0.12, 1.44, 0.35, -0.73, 0.11}, {0.34, 0.19, -0.02, 1.72, 0.51, -0.25, -0.3},
      {0.8, -0.07, -0.09, 1.86, 0.2, 0.19, -0.33}, {0.99, -0.03, -0.37, 2.06, -0.28, 0.4, 0.23},
      {0.83, 0.18, -0.4, 2.26, -0.41, 0.16, 0.77}, {-0.32, 0.78, 0.2, 1.9, 0.01, -0.77, -0.14}};
  constexpr double kStep = 0.8;
  swept::JointTrajectory trajectory;
  for (std::size_t i = 0; i < states.size(); ++i) {
    std::vector<double> velocities(7, 0.0);
    for (std::size_t k = 0; k < 7 && i > 0 && i + 1 < states.size(); ++k)
      velocities[k] = (states[i + 1][k] - states[i - 1][k]) / (2 * kStep);
    trajectory.points.push_back({kStep * static_cast<double>(i), states[i], velocities, {}});
  }
  for (const int variable : checker->group().variables)
    trajectory.variables.push_back(robot->variables()[std::size_t(variable)].name);

  swept::TrajectoryQuery query;
  const double none = std::numeric_limits<double>::infinity();
  query.limits = swept::RateLimits{std::vector<double>(7, 2.0), std::vector<double>(7, 12.0),
                                   std::vector<double>(7, none)};
  swept::Page page(checker);
  page.addTrajectory("six points", swept::controllerCurve(trajectory), query, states);

  const auto folder = std::filesystem::temp_directory_path();
  const auto file = argc > 2 ? argv[2] : folder / "swept_example_trajectory_page.html";
  page.write(file);
  std::cout << "page of " << std::filesystem::file_size(file) << " bytes written to " << file
            << '\n';
  if (argc <= 2) std::filesystem::remove(file);
  return page.html().find("\"headline\":\"trajectory: free\"") != std::string::npos ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
