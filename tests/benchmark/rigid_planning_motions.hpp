// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "rigid_planning_attempt.hpp"
#include "timing.hpp"

/// What one motion of a rigid body costs, without a planner.
namespace swept::benchmark {

struct RigidMotions {
  static constexpr std::size_t kCount = 1000;

  std::string problem;
  std::array<std::size_t, 3> count{};  ///< by verdict
  std::array<double, 3> seconds{};     ///< s, CPU, by verdict
  double slowest = 0.0;                ///< s, CPU
  double peerSeconds = 0.0;            ///< s, CPU
  std::size_t missed = 0;              ///< taken for free by FCL, and in collision
};

/// Motions between two free states, uniform but for their length: at most 20 % of the space's
/// extent, which is the range of OMPL's planners.
struct FreeEnds {
  const Checker& checker;
  ompl::base::StateSpacePtr space;
  StateConversion conversion{checker.robot(), checker.group()};
  Workspace workspace{checker};
  ompl::base::ScopedState<> from{space}, to{space};
  std::vector<double> q0 = std::vector<double>(7), q1 = q0;  ///< the same

  void next() {
    do {
      from.random();
      to.random();
      const double share = 0.2 * space->getMaximumExtent() / space->distance(from.get(), to.get());
      if (share < 1.0) space->interpolate(from.get(), to.get(), share, to.get());
      conversion.toConfiguration(from.get(), q0);
      conversion.toConfiguration(to.get(), q1);
    } while (checker.checkState(q0, workspace) != Verdict::Free ||
             checker.checkState(q1, workspace) != Verdict::Free);
  }
};

inline RigidMotions measureMotions(const RigidScene& scene, const std::string& name,
                                   std::uint32_t seed) {
  ompl::RNG::setSeed(seed);
  const og::SimpleSetupPtr peer = scene.setup(RigidMethod::Fcl);
  const ompl::base::SpaceInformationPtr& si = peer->getSpaceInformation();
  si->setup();
  FreeEnds ends{scene.checker(), peer->getStateSpace()};
  Workspace workspace(scene.checker());
  RigidMotions motions{.problem = name};
  for (std::size_t i = 0; i < RigidMotions::kCount; ++i) {
    ends.next();
    const double begin = cpuSeconds();
    const Verdict verdict =
        scene.checker()
            .certifyMotion(ends.q0, ends.q1, workspace, MotionQuery::VerdictOnly)
            .verdict;
    const double middle = cpuSeconds();
    const bool valid = si->checkMotion(ends.from.get(), ends.to.get());
    motions.peerSeconds += cpuSeconds() - middle;
    ++motions.count[static_cast<std::size_t>(verdict)];
    motions.seconds[static_cast<std::size_t>(verdict)] += middle - begin;
    motions.slowest = std::max(motions.slowest, middle - begin);
    motions.missed += valid && verdict == Verdict::Collision;
  }
  return motions;
}

inline void printRigidMotions(const std::vector<RigidMotions>& all) {
  const MarkdownTable table({"problem", "free", "collision", "undecided", "us: free", "collision",
                             "undecided", "all", "slowest", "FCL, 1 %: us", "swept / FCL",
                             "collisions that it misses"});
  const std::array order{Verdict::Free, Verdict::Collision, Verdict::Undecided};
  const double each = 1e6 / static_cast<double>(RigidMotions::kCount);
  for (const RigidMotions& motions : all) {
    std::vector<std::string> row{motions.problem};
    for (const Verdict verdict : order)
      row.push_back(std::to_string(motions.count[static_cast<std::size_t>(verdict)]));
    double sum = 0.0;
    for (const Verdict verdict : order) {
      const double seconds = motions.seconds[static_cast<std::size_t>(verdict)];
      const auto count = static_cast<double>(motions.count[static_cast<std::size_t>(verdict)]);
      row.push_back(count > 0.0 ? number(1e6 * seconds / count) : "-");
      sum += seconds;
    }
    for (const std::string& cell :
         {number(each * sum), number(1e6 * motions.slowest), number(each * motions.peerSeconds),
          number(sum / motions.peerSeconds, 2), std::to_string(motions.missed)})
      row.push_back(cell);
    table.row(row);
  }
}

}  // namespace swept::benchmark
