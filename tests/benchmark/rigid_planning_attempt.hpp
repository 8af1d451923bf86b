// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/stride/STRIDE.h>
#include <ompl/util/RandomNumbers.h>

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../robot_model/input_files.hpp"
#include "planning_validity.hpp"
#include "rigid_planning_problems.hpp"

/// One problem for a rigid body, one planner, one way to tell what is valid.
namespace swept::benchmark {

namespace og = ompl::geometric;

enum class RigidMethod : std::uint8_t {
  Certified,  ///< makeSimpleSetup
  Fcl,        ///< OMPL's discrete validator at its default resolution over FCL
};

template <typename Planner>
ompl::base::PlannerPtr plannerOf(const ompl::base::SpaceInformationPtr& si) {
  return std::make_shared<Planner>(si);
}

/// By the names that `--planner` takes.
inline const std::map<std::string, ompl::base::PlannerAllocator> kRigidPlanners{
    {"RRTConnect", plannerOf<og::RRTConnect>},
    {"KPIECE1", plannerOf<og::KPIECE1>},
    {"BKPIECE1", plannerOf<og::BKPIECE1>},
    {"BiEST", plannerOf<og::BiEST>},
    {"PRM", plannerOf<og::PRM>},
    {"STRIDE", plannerOf<og::STRIDE>}};

/// A problem the way a user of the library has it: the body is a robot read from files, which
/// floats in a world with one mesh.
class RigidScene {
 public:
  /// `tolerance`: of motions, m.
  RigidScene(const RigidProblem& problem, double tolerance)
      : start_(problem.start), goal_(problem.goal) {
    const test::TemporaryFolder folder;
    const std::filesystem::path mesh = folder.path() / "body.obj";
    test::writeObj(problem.body, mesh);
    auto world = std::make_shared<World>();
    // Walls in the data have open edges and no thickness: what is inside nobody knows.
    world->add("environment",
               TriangleMesh::build(problem.environment.vertices, problem.environment.triangles,
                                   MeshInterior::Surface),
               Eigen::Isometry3d::Identity());
    CheckerOptions options;
    options.tolerance = tolerance;
    checker_ = std::make_shared<const Checker>(test::floatingBody(mesh), "all", world, options);
    for (const int axis : {0, 1, 2})
      space_.limits["place/trans_" + std::string(1, "xyz"[axis])] = {problem.lower[axis],
                                                                     problem.upper[axis]};
  }

  const Checker& checker() const { return *checker_; }
  const std::vector<double>& start() const { return start_; }
  const std::vector<double>& goal() const { return goal_; }

  og::SimpleSetupPtr setup(RigidMethod method) const {
    if (method == RigidMethod::Certified) return makeSimpleSetup(checker_, {.space = space_});
    auto setup = std::make_shared<og::SimpleSetup>(space());
    const ompl::base::SpaceInformationPtr& si = setup->getSpaceInformation();
    si->setStateValidityChecker(std::make_shared<FclStates>(si, *checker_));
    si->setMotionValidator(std::make_shared<ompl::base::DiscreteMotionValidator>(si));
    return setup;
  }
  ompl::base::StateSpacePtr space() const {
    return makeStateSpace(checker_->robot(), checker_->group(), space_);
  }

 private:
  std::shared_ptr<const Checker> checker_;
  StateSpaceOptions space_;
  std::vector<double> start_, goal_;
};

/// What the checker says of a whole path.
struct RigidPath {
  std::size_t segments = 0, colliding = 0, undecided = 0;
  std::size_t firstColliding = 0;  ///< its number, if there is one
  std::optional<Witness> witness;  ///< of that segment
  bool free() const { return colliding == 0 && undecided == 0; }
};

inline RigidPath judge(const og::PathGeometric& path, const Checker& checker) {
  RigidPath judged;
  for (const MotionCertificate& certificate : certifyPath(path, checker)) {
    if (certificate.verdict == Verdict::Collision && judged.colliding++ == 0) {
      judged.firstColliding = judged.segments;
      judged.witness = certificate.witness;
    }
    judged.undecided += certificate.verdict == Verdict::Undecided;
    ++judged.segments;
  }
  return judged;
}

struct RigidAttempt {
  bool solved = false;
  double seconds = 0.0;  ///< s, CPU of the thread: planning, without the meter's own
  double share = 0.0;    ///< of it, within validity
  std::uint64_t motions = 0, states = 0;
  RigidPath path;  ///< if solved
};

struct RigidLimits {
  std::string planner = "RRTConnect";
  double seconds = 20.0;  ///< s, CPU, for each attempt
  unsigned runs = 10;
  std::uint32_t seed = 1;  ///< of the first run; the next has the next
};

class RigidPlanning {
 public:
  explicit RigidPlanning(RigidLimits limits)
      : limits_(std::move(limits)), meterSeconds_(meterSeconds(clock_)) {}

  const RigidLimits& limits() const { return limits_; }

  RigidAttempt attempt(const RigidScene& scene, RigidMethod method, unsigned run) const {
    // Spaces and planners draw from the seed as soon as they are made.
    ompl::RNG::setSeed(limits_.seed + run);
    const og::SimpleSetupPtr setup = scene.setup(method);
    ValidityMeter meter(clock_);
    meterValidity(setup->getSpaceInformation(), meter);
    const StateConversion conversion(scene.checker().robot(), scene.checker().group());
    ompl::base::ScopedState<> start(setup->getStateSpace()), goal(setup->getStateSpace());
    conversion.toState(scene.start(), start.get());
    conversion.toState(scene.goal(), goal.get());
    setup->setStartAndGoalStates(start, goal);
    setup->setPlanner(kRigidPlanners.at(limits_.planner)(setup->getSpaceInformation()));
    setup->setup();
    RigidAttempt attempt = solve(*setup, meter);
    if (attempt.solved) attempt.path = judge(setup->getSolutionPath(), scene.checker());
    return attempt;
  }

 private:
  RigidAttempt solve(og::SimpleSetup& setup, const ValidityMeter& meter) const {
    RigidAttempt attempt;
    const double begin = cpuSeconds();
    // Given seconds, OMPL starts a thread for its clock, which takes half as long as a quick plan.
    const double wall = 1e-9 * clock_.time([&] {
      attempt.solved = setup.solve(ompl::base::timedPlannerTerminationCondition(limits_.seconds)) ==
                       ompl::base::PlannerStatus::EXACT_SOLUTION;
    });
    const double meters = meterSeconds_ * static_cast<double>(meter.timedCalls());
    attempt.seconds = cpuSeconds() - begin - meters;
    // One clock on both sides: what else the machine does falls on both alike.
    attempt.share = 1e-9 * meter.nanoseconds() / (wall - meters);
    attempt.motions = meter.motions();
    attempt.states = meter.states();
    return attempt;
  }

  RigidLimits limits_;
  BenchClock clock_;
  double meterSeconds_;
};

}  // namespace swept::benchmark
