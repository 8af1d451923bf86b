// SPDX-License-Identifier: BSD-3-Clause
#include "planning/pose_target.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "output/text_output.hpp"
#include "planning/end_report.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"

namespace swept {
namespace {

constexpr int kSearches = 300;

/// Within the limits; where one is missing, a turn, or 2 pi m, from the other, or around zero.
std::vector<double> randomState(const Checker& checker, std::mt19937& random) {
  std::vector<double> q;
  for (const int v : checker.group().variables) {
    const Variable& variable = checker.robot().variables()[v];
    constexpr double kRange = 2.0 * std::numbers::pi;
    const double least = std::isfinite(variable.lower)   ? variable.lower
                         : std::isfinite(variable.upper) ? variable.upper - kRange
                                                         : -0.5 * kRange;
    const double most = std::isfinite(variable.upper) ? variable.upper : least + kRange;
    q.push_back(std::uniform_real_distribution<double>(least, most)(random));
  }
  return q;
}

double deepest(const EndReport& report) {
  double depth = 0.0;
  for (const EndContact& contact : report.contacts) depth = std::max(depth, contact.depth);
  return depth;
}

}  // namespace

std::string whyNotReached(const std::shared_ptr<const Checker>& owner, const PoseTarget& target,
                          std::uint32_t seed) {
  const Checker& checker = *owner;
  const std::shared_ptr<const Robot> robot(owner, &checker.robot());
  const InverseKinematics kinematics(robot, checker.group().name, target.link,
                                     checker.options().reference);
  InverseKinematics::Workspace scratch(kinematics);
  Workspace workspace(checker);
  const InverseKinematicsOptions options{.positionTolerance = target.positionTolerance,
                                         .orientationTolerance = target.orientationTolerance};
  std::mt19937 random(seed);
  int found = 0;
  std::optional<EndReport> best;
  for (int i = 0; i < kSearches; ++i) {
    std::vector<double> q = randomState(checker, random);
    if (!kinematics.solve(target.model_from_link, q, options, scratch)) continue;
    ++found;
    EndReport report =
        reportEnd(checker, {.label = "the best of them", .q = std::move(q)}, workspace);
    // The search for goals does not use up the tolerances, so that rounding cannot exceed them.
    if (report.verdict == Verdict::Free)
      return "the search for goals missed a free configuration that puts " + target.link +
             " at the goal pose: try larger tolerances or another --seed";
    if (!best || deepest(report) < deepest(*best)) best = std::move(report);
  }
  const std::string searches = std::to_string(kSearches) + " searches";
  if (!best)
    return "no configuration puts " + target.link + " at the goal pose: none found in " + searches;
  return "no free configuration puts " + target.link +
         " at the goal pose: " + std::to_string(found) + " of " + searches + " reach it, and " +
         endText(*best);
}

}  // namespace swept
