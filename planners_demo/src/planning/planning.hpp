// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command_line/exit_code.hpp"
#include "input/task.hpp"
#include "output/clearance_text.hpp"
#include "planning/end_report.hpp"
#include "planning/pose_target.hpp"
#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"

namespace ompl::geometric {
class SimpleSetup;
}

namespace swept {

/// Space, validity and motion checks of a checker's group.
using SetupMaker = std::function<std::shared_ptr<ompl::geometric::SimpleSetup>(
    const std::shared_ptr<const Checker>&, const StateSpaceOptions&)>;

struct PlanRequest {
  std::string planner;               ///< as plannerName() returns it
  double time = 5.0;                 ///< s; limit of the planner
  std::optional<double> range = {};  ///< of the planner's motions; none: of our own choice
  std::uint32_t seed = 1;
  bool simplify = true;
  std::optional<double> simplifyTime = {};  ///< s, of OMPL's simplifier; none: shortenPath()
  int threads = 1;                          ///< of the planner, or copies of it where it has none
  std::optional<PoseTarget> goalPose = {};  ///< instead of goal states
  bool clearance = true;                    ///< bound the least distance of every segment too
  SetupMaker setup = {};                    ///< none: makeSimpleSetup
};

/// What is known about one motion of a path.
struct PathSegment {
  MotionCertificate certificate;
  double clearance = 0.0;  ///< m, proven lower bound; infinity: no pairs; 0 when not asked for
  Clearances clearances;   ///< of pairs with the world, and of the others; likewise
};

struct PlanOutcome {
  ExitCode code = ExitCode::Collision;  ///< Free: a path from start to goal, every segment Free
  std::string failure;                  ///< why there is no path; empty when there is one
  std::string status;                   ///< the planner's own word; empty when it did not run
  double planningTime = 0.0;            ///< s
  double simplifyTime = 0.0;            ///< s
  double certifyTime = 0.0;             ///< s, of the final path, clearance included
  double length = 0.0;                  ///< of the path, in the metric of the state space
  unsigned certified = 0;  ///< motions the validator proved free, for planner and simplification
  unsigned refused = 0;    ///< motions it did not
  std::vector<EndReport> badEnds = {};  ///< starts and goals that cannot be used
  std::vector<std::vector<double>> states;
  std::vector<PathSegment> segments;  ///< one fewer than states

  bool solved() const { return failure.empty(); }
  bool proven() const;                 ///< solved, and every segment is Free
  double leastClearance() const;       ///< m, over the segments
  Clearances leastClearances() const;  ///< likewise
};

/// Plans from `states[0]` to any of the others, or to the goal pose, and certifies the path once
/// more when it is final. The same request gives the same path unless a time limit cuts in, or the
/// planner uses threads. Throws UsageError when the planner cannot work in the group's state space,
/// and for a goal pose of a link that is not there or does not move.
PlanOutcome plan(const std::shared_ptr<const Checker>& checker,
                 const std::vector<LabelledState>& states, const PlanRequest& request);

/// OMPL's messages: to stderr, or nowhere.
void routePlannerMessages(bool toStderr);

}  // namespace swept
