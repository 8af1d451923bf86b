// SPDX-License-Identifier: BSD-3-Clause
// One arm reaches over a table and back. A second arm is planned beside it, to the same place.
//   example_28_plan_beside MODELS
// Exits 0 if a way is found, proven together with that of the first arm, and the second arm waits.
#include <iostream>
#include <string>
#include <vector>

#include "swept/ompl_bridge/schedule_plan.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/work_cell.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const auto robot = swept::loadWorkCell(swept::WorkCell::read(models + "/cells/two_rooks.yaml"));
  // Links of the two arms keep 2 cm apart.
  const swept::Checker checker(robot, "both", std::make_shared<swept::World>(), {.margin = 0.02});
  const std::vector<double> reaching{0, 1.3, 0, 0.3, 0, 0, 0}, rest(7, 0.0);

  // The first arm: tucked, over the table from 1.5 s to 2.5 s, and tucked again.
  const swept::Group& left = *robot->findGroup("left/arm");
  const auto tucked = swept::namedConfiguration(*robot, left, "tucked");
  swept::JointTrajectory first;
  for (const int variable : left.variables)
    first.variables.push_back(robot->variables()[variable].name);
  first.points = {{0.0, tucked, rest, {}},
                  {1.5, reaching, rest, {}},
                  {2.5, reaching, rest, {}},
                  {4.0, tucked, rest, {}}};
  const std::vector<swept::ScheduledCurve> known{{first.variables, swept::controllerCurve(first)}};

  const swept::Group& right = *robot->findGroup("right/arm");
  const std::vector<double> start = swept::namedConfiguration(*robot, right, "tucked");
  swept::RateLimits limits = swept::RateLimits::of(*robot, right);
  limits.acceleration.assign(7, 5.0);  // rad/s^2
  const std::vector<swept::ScheduleTask> tasks{{"right/arm", start, {reaching}, limits}};
  std::vector<double> still = tucked;  // of both arms: the first one stays tucked
  still.insert(still.end(), start.begin(), start.end());
  const auto alone = swept::planSchedule(checker, tasks, {}, still);
  const auto plan = swept::planSchedule(checker, tasks, known);
  if (!alone.found() || !plan.found()) return 1;

  const double arrival = plan.curves.front().curve.end();
  std::cout << "alone, it arrives after " << alone.curves.front().curve.end() << " s; beside the "
            << "first arm after " << arrival << " s, " << toString(plan.certificate->verdict)
            << '\n';
  for (const swept::TrajectoryPoint& point : plan.trajectories.front().points)
    std::cout << "  " << point.time << " s, joint2 at " << point.positions[1] << '\n';
  return arrival > alone.curves.front().curve.end() + 0.5 ? 0 : 2;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
