// SPDX-License-Identifier: BSD-3-Clause
#include "io/trajectory_rows.hpp"

#include <utility>

#include "io/judged_state.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept::detail {

namespace {

/// Velocities or accelerations that a row may leave out. `one`: what messages call one of them.
std::vector<double> ratesOf(std::span<const double> row, const GroupColumns& columns,
                            const std::string& one, const FailAt& fail) {
  if (row.empty()) return {};
  std::vector<double> rates = columns.ofGroup(row);
  columns.requireStillRates(one, row, rates, fail);
  return rates;
}

void setRates(GroupColumns& columns, std::span<const std::string> names, const std::string& several,
              const FailAtColumn& failAt, const FailAt& fail) {
  columns.set(names, failAt);
  if (const std::vector<std::string> missing = columns.missing(); !missing.empty())
    fail("there are " + several + " of " + joined(names) + ", but none of " + joined(missing) +
         ", which the group moves, too");
}

}  // namespace

TrajectoryRows::TrajectoryRows(const InputSource& source, const Robot& robot, const Group& group,
                               const Eigen::VectorXd& reference)
    : source_(source),
      robot_(robot),
      group_(group),
      positions_(robot, group, reference),
      velocities_(robot, group, reference),
      accelerations_(robot, group, reference) {}

void TrajectoryRows::begin(std::span<const std::string> names, const FailAtColumn& failAt,
                           const FailAt& fail) {
  positions_.set(names, failAt);
  positions_.requireWholeGroup(fail);
  velocities_.set(names, failAt);
  accelerations_.set(names, failAt);
  trajectories_.push_back({.variables = variableNames(robot_, group_), .points = {}});
}

void TrajectoryRows::setVelocities(std::span<const std::string> names, const FailAtColumn& failAt,
                                   const FailAt& fail) {
  setRates(velocities_, names, "velocities", failAt, fail);
}

void TrajectoryRows::setAccelerations(std::span<const std::string> names,
                                      const FailAtColumn& failAt, const FailAt& fail) {
  setRates(accelerations_, names, "accelerations", failAt, fail);
}

void TrajectoryRows::add(const TrajectoryPoint& row, int line, const FailAt& fail) {
  requireLater(row.time, fail);
  std::vector<double> positions = positionsOf(row.positions, line, fail);
  trajectories_.back().points.push_back(
      {.time = row.time,
       .positions = std::move(positions),
       .velocities = ratesOf(row.velocities, velocities_, "velocity", fail),
       .accelerations = ratesOf(row.accelerations, accelerations_, "acceleration", fail)});
}

void TrajectoryRows::requireLater(double time, const FailAt& fail) const {
  const std::vector<TrajectoryPoint>& points = trajectories_.back().points;
  const std::string seen = "the time is " + exactNumber(time) + " s; it must be ";
  if (points.empty() && !(time >= 0.0)) fail(seen + "0 or more");
  if (!points.empty() && !(time > points.back().time))
    fail(seen + "more than " + exactNumber(points.back().time) + " s, that of the point before");
}

std::vector<double> TrajectoryRows::positionsOf(std::span<const double> row, int line,
                                                const FailAt& fail) {
  std::vector<double> q = positions_.ofGroup(row);
  const std::string problem = normalizeOrientations(robot_, group_, q);
  if (!problem.empty()) fail(problem);
  for (const TakenToLimit& taken : takeToLimits(robot_, group_, q))
    taken_.note(taken.variable, limitRemark(taken), line);
  positions_.requireStill(row, q, fail);
  return q;
}

void TrajectoryRows::tellRemarks() const {
  taken_.tell([this](int line, const std::string& text) { source_.warn(line, text); });
}

}  // namespace swept::detail
