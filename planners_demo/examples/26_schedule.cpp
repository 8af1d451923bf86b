// SPDX-License-Identifier: BSD-3-Clause
// Two arms reach over one table, one after the other: is that free, and how late may the first be?
//   example_26_schedule MODELS
// Exits 0 if the schedule is proven, with some delays, and a conflict is found after these.
#include "swept/robot_model/schedule.hpp"

#include <iostream>
#include <string>
#include <vector>

#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/work_cell.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const auto robot = swept::loadWorkCell(swept::WorkCell::read(models + "/cells/two_rooks.yaml"));
  const swept::Checker checker(robot, "both", std::make_shared<swept::World>());

  // Each is tucked, reaches over the table and is tucked again: cubics that rest at their points.
  const std::vector<double> reaching{0, 1.3, 0, 0.3, 0, 0, 0}, rest(7, 0.0);
  const auto reach = [&](const std::string& arm, double start) {
    const swept::Group& group = *robot->findGroup(arm);
    const auto tucked = swept::namedConfiguration(*robot, group, "tucked");
    swept::JointTrajectory trajectory;
    for (const int variable : group.variables)
      trajectory.variables.push_back(robot->variables()[variable].name);
    trajectory.points = {
        {0.0, tucked, rest, {}}, {1.5, reaching, rest, {}}, {3.0, tucked, rest, {}}};
    return swept::ScheduledCurve{trajectory.variables, swept::controllerCurve(trajectory), start};
  };
  const std::vector<swept::ScheduledCurve> curves{reach("left/arm", 0.0), reach("right/arm", 3.0)};

  const swept::TrajectoryCertificate planned = swept::certifySchedule(checker, curves);
  std::cout << "one after the other: " << toString(planned.verdict) << '\n';

  // The left arm may start late, by any time up to some.
  const auto late =
      swept::certifyDelays(checker, curves, {.curve = 0, .latest = 3.0, .resolution = 0.01});
  if (!late.proven || !late.contact) return 1;
  const swept::Witness& witness = late.contact->contact.witness;
  std::cout << "the left one may be late by " << *late.proven << " s; at " << late.contact->delay
            << " s " << witness.bodyA << " meets " << witness.bodyB << " after "
            << late.contact->contact.time << " s\n";
  return planned.verdict == swept::Verdict::Free && *late.proven > 0.1 ? 0 : 2;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
