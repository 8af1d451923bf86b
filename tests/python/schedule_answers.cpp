// SPDX-License-Identifier: BSD-3-Clause
// Two arms on one clock, each from rest to rest within 1 s of its own: schedules_test.py has the
// same. A question has both ends, starts (s) and slowdowns; one about delays more. And what is
// planned for both.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "answer.hpp"
#include "swept/ompl_bridge/schedule_plan.hpp"
#include "swept/robot_model/schedule.hpp"

namespace swept::test {
namespace {

std::vector<ScheduledCurve> halves(const Checker& checker, ConfigurationView q,
                                   std::span<const double> more) {
  const std::size_t half = q.size() / 2;
  const std::vector<double> rest(half, 0.0);
  std::vector<ScheduledCurve> curves;
  for (std::size_t i = 0; i < 2; ++i) {
    JointTrajectory trajectory;
    for (std::size_t v = i * half; v < (i + 1) * half; ++v)
      trajectory.variables.push_back(
          checker.robot().variables()[checker.group().variables[v]].name);
    const auto part = [&](std::span<const double> all) {
      const std::span<const double> own = all.subspan(i * half, half);
      return std::vector<double>(own.begin(), own.end());
    };
    trajectory.points = {{0.0, part(q), rest, {}}, {1.0, part(more), rest, {}}};
    curves.push_back({.variables = trajectory.variables,
                      .curve = controllerCurve(trajectory),
                      .start = more[q.size() + i],
                      .slowdown = more[q.size() + 2 + i]});
  }
  return curves;
}

void addCombined(Answer& answer, const Checker& checker,
                 const std::vector<ScheduledCurve>& curves) {
  const CombinedCurve combined = combinedCurve(checker.robot(), checker.group(), curves);
  for (const double value : combined.rounding) answer << value;
  for (const double knot : combined.curve.knots()) {
    answer << knot;
    for (const double value : combined.curve.position(knot)) answer << value;
  }
}

/// Both arms from q to the goals in `more`, and then a seed, a delay and the slowest factor.
void addPlan(Answer& answer, const Checker& checker, ConfigurationView q,
             std::span<const double> more) {
  const std::size_t half = q.size() / 2;
  std::vector<ScheduleTask> tasks;
  for (const std::string group : {"left/arm", "right/arm"}) {
    const auto part = [&](std::span<const double> all) {
      const std::span<const double> own = all.subspan(tasks.size() * half, half);
      return std::vector<double>(own.begin(), own.end());
    };
    RateLimits limits = RateLimits::of(checker.robot(), *checker.robot().findGroup(group));
    limits.acceleration.assign(half, 5.0);
    tasks.push_back({.group = group, .start = part(q), .goals = {part(more)}, .limits = limits});
  }
  const PlannedSchedule found = planSchedule(checker, tasks, {}, {},
                                             {.seconds = 600.0,
                                              .delay = more[q.size() + 1],
                                              .slowest = more[q.size() + 2],
                                              .improvements = 30,
                                              .seed = static_cast<std::uint32_t>(more[q.size()])});
  std::string status = toString(found.status);
  std::ranges::replace(status, ' ', '_');
  answer << status;
  for (const JointTrajectory& trajectory : found.trajectories)
    for (const TrajectoryPoint& point : trajectory.points) {
      answer << point.time;
      for (const double value : point.positions) answer << value;
    }
}

}  // namespace

bool askSchedules(Answer& answer, const std::string& question, const Checker& checker,
                  ConfigurationView q, std::span<const double> more) {
  if (question == "combine") {
    addCombined(answer, checker, halves(checker, q, more));
  } else if (question == "schedule") {
    const TrajectoryCertificate found = certifySchedule(checker, halves(checker, q, more));
    answer << toString(found.verdict) << found.freeUntil;
    if (found.contact)
      answer << found.contact->time << found.contact->witness.bodyA << found.contact->witness.bodyB;
  } else if (question == "plan_schedule") {
    addPlan(answer, checker, q, more);
  } else if (question == "delays") {
    const std::span<const double> query = more.subspan(q.size() + 4);
    const DelayCertificate found = certifyDelays(checker, halves(checker, q, more),
                                                 {.curve = static_cast<std::size_t>(query[0]),
                                                  .latest = query[1],
                                                  .slowest = query[2],
                                                  .resolution = query[3]});
    answer << toString(found.verdict) << found.proven.value_or(-1.0)
           << static_cast<double>(found.curves);
    if (found.contact)
      answer << found.contact->delay << found.contact->slowdown << found.contact->contact.time
             << found.contact->contact.witness.bodyA << found.contact->contact.witness.bodyB;
  } else {
    return false;
  }
  return true;
}

}  // namespace swept::test
