// SPDX-License-Identifier: BSD-3-Clause
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>
#include <pybind11/stl.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "errors.hpp"
#include "goals.hpp"
#include "handles.hpp"
#include "roadmaps.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/certified_connect.hpp"
#include "swept/ompl_bridge/certified_roadmap.hpp"
#include "swept/ompl_bridge/paths.hpp"
#include "swept/ompl_bridge/planners.hpp"
#include "swept/ompl_bridge/pose_goal.hpp"
#include "swept/ompl_bridge/setup.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "swept/robot_model/proven_trajectory.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "watch.hpp"

namespace py = pybind11;
namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace swept::python {
namespace {

using States = std::vector<std::vector<double>>;
/// swept.Plan.
struct Plan {
  std::string planner, status;
  bool solved = false;
  States states = {};
  std::size_t dimension = 0;
  PathCertificate certificate = {};
  double seconds = 0.0, length = 0.0;
  unsigned certified = 0, refused = 0;
};

struct PlanOptions {
  std::string planner;
  double seconds;
  std::uint32_t seed;
  std::optional<double> range;
  bool shorten;
  std::optional<double> simplifySeconds;
  /// In place of a planner of that name; null: none.
  const CertifiedRoadmap* roadmap = nullptr;
};

/// What a plan leads to: states, or a pose.
struct Goals {
  States states;
  std::optional<PoseTarget> pose;
};

States statesOf(const Table& table) {
  States states;
  for (const ConfigurationView row : table.list()) states.emplace_back(row.begin(), row.end());
  return states;
}

/// OMPL says on its console that seeds come too late, which they do not for what is made next.
void seed(std::uint32_t value) {
  ompl::msg::OutputHandler* const console = ompl::msg::getOutputHandler();
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(value);
  ompl::msg::useOutputHandler(console);
}

double secondsSince(Watch::Clock::time_point begin) {
  return std::chrono::duration<double>(Watch::Clock::now() - begin).count();
}

/// A setup whose space contains the states.
og::SimpleSetupPtr setupFor(const std::shared_ptr<const Checker>& checker, const States& states) {
  SetupOptions options;
  options.space.limits = limitsAround(checker->robot(), checker->group(), states);
  return makeSimpleSetup(checker, options);
}

void setGoals(og::SimpleSetup& setup, const StateConversion& conversion, const States& goals) {
  ob::ScopedState<> state(setup.getStateSpace());
  if (goals.size() == 1) {  // which every planner takes
    conversion.toState(goals.front(), state.get());
    setup.setGoalState(state);
    return;
  }
  auto all = std::make_shared<ob::GoalStates>(setup.getSpaceInformation());
  for (const std::vector<double>& goal : goals) {
    conversion.toState(goal, state.get());
    all->addState(state);
  }
  setup.setGoal(all);
}

/// With all its samples, so that the same seed gives the same path. False: there is none.
bool setPoseGoal(og::SimpleSetup& setup, const std::shared_ptr<const Checker>& checker,
                 const PoseTarget& target, std::uint32_t seedOfSamples,
                 const std::stop_token& stop) {
  PoseGoalOptions options;
  options.positionTolerance = target.positionTolerance;
  options.orientationTolerance = target.orientationTolerance;
  options.seed = seedOfSamples;
  options.link_from_tool = target.link_from_tool;
  setup.getSpaceInformation()->setup();
  const auto goal = std::make_shared<PoseGoal>(setup.getSpaceInformation(), checker, target.link,
                                               target.model_from_tool, options);
  goal->startSampling();
  while (goal->isSampling() && !stop.stop_requested())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  goal->stopSampling();
  setup.setGoal(goal);
  return goal->hasStates();
}

/// Shortest text that reads back as the same double, as planners take their parameters.
std::string exactText(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

ob::PlannerPtr plannerOf(const og::SimpleSetup& setup, const PlanOptions& options) {
  if (options.roadmap != nullptr) {
    // Whoever plans on a roadmap keeps it as long as the planner.
    const std::shared_ptr<const CertifiedRoadmap> kept(std::shared_ptr<void>(), options.roadmap);
    return std::make_shared<RoadmapPlanner>(setup.getSpaceInformation(), kept);
  }
  ob::PlannerPtr planner = makePlanner(options.planner, setup.getSpaceInformation());
  if (auto* own = dynamic_cast<CertifiedConnect*>(planner.get())) own->setSeed(options.seed);
  if (options.range && !(planner->params().hasParam("range") &&
                         planner->params().setParam("range", exactText(*options.range))))
    throw UsageError("planner " + options.planner + " has no range");
  return planner;
}

void shorten(og::SimpleSetup& setup, const Checker& checker, const PlanOptions& options) {
  if (options.simplifySeconds)
    simplifyPath(setup.getSolutionPath(), checker, *options.simplifySeconds, setup.getGoal());
  else if (options.shorten)
    shortenPath(setup.getSolutionPath());
}

Plan solve(const std::shared_ptr<const Checker>& checker, const std::vector<double>& start,
           const Goals& goals, const PlanOptions& options, const std::stop_token& stop) {
  Plan plan{.planner = options.planner,
            .status = {},
            .dimension = static_cast<std::size_t>(checker->dimension())};
  const auto begin = Watch::Clock::now();
  seed(options.seed);
  States ends = goals.states;
  ends.push_back(start);
  const og::SimpleSetupPtr setup = setupFor(checker, ends);
  const StateConversion conversion(checker->robot(), checker->group());
  ob::ScopedState<> state(setup->getStateSpace());
  conversion.toState(start, state.get());
  setup->setStartState(state);
  if (!goals.pose) {
    setGoals(*setup, conversion, goals.states);
  } else if (!setPoseGoal(*setup, checker, *goals.pose, options.seed, stop)) {
    plan.status = "no free state reaches the goal pose";
    plan.seconds = secondsSince(begin);
    return plan;
  }
  setup->setPlanner(plannerOf(*setup, options));
  const ob::PlannerTerminationCondition stopped([&stop] { return stop.stop_requested(); });
  const ob::PlannerStatus status = setup->solve(ob::plannerOrTerminationCondition(
      ob::timedPlannerTerminationCondition(options.seconds), stopped));
  plan.status = status.asString();
  plan.solved = status == ob::PlannerStatus::EXACT_SOLUTION;
  const ob::MotionValidatorPtr& validator = setup->getSpaceInformation()->getMotionValidator();
  if (plan.solved && !stop.stop_requested()) {
    shorten(*setup, *checker, options);
    plan.states = configurationsOf(setup->getSolutionPath(), *checker);
    // Some planners make a path of one state of a start that is the goal.
    if (plan.states.size() == 1) plan.states.push_back(plan.states.front());
    plan.length = setup->getSolutionPath().length();
    plan.certificate = certifyPath(*checker, plan.states, {.clearances = false});
  }
  plan.certified = validator->getValidMotionCount();
  plan.refused = validator->getInvalidMotionCount();
  plan.seconds = secondsSince(begin);
  return plan;
}

/// One state or several, (n,) or (k, n), or a pose.
Goals readGoals(const py::object& goal, std::size_t dimension) {
  if (py::isinstance<PoseTarget>(goal)) return {{}, goal.cast<const PoseTarget&>()};
  const bool isTable = py::hasattr(goal, "ndim")
                           ? goal.attr("ndim").cast<int>() == 2
                           : py::isinstance<py::sequence>(goal) && py::len(goal) > 0 &&
                                 py::isinstance<py::sequence>(py::object(goal[py::int_(0)]));
  const States states =
      statesOf(isTable ? readTable(goal, "goal", dimension) : readVector(goal, "goal", dimension));
  if (states.empty()) throw std::invalid_argument("goal: expected one state at least");
  return {states, {}};
}

void requireOptions(const PlanOptions& options) {
  if (!(options.seconds > 0.0)) throw std::invalid_argument("seconds: expected a positive number");
  if (options.seed == 0) throw std::invalid_argument("seed: expected a number above 0");
  if (options.range && !(*options.range > 0.0 && std::isfinite(*options.range)))
    throw std::invalid_argument("range: expected a positive number");
}

Plan plan(const CheckerHandle& checker, const py::object& start, const py::object& goal,
          const std::string& planner, double seconds, std::uint32_t seedValue,
          std::optional<double> range, bool shortens, std::optional<double> simplifySeconds,
          const Token& cancel) {
  const PlanOptions options{.planner = plannerName(planner),
                            .seconds = seconds,
                            .seed = seedValue,
                            .range = range,
                            .shorten = shortens,
                            .simplifySeconds = simplifySeconds};
  requireOptions(options);
  const States first = statesOf(readVector(start, "start", checker.dimension()));
  const Goals goals = readGoals(goal, checker.dimension());
  Plan found;
  runWatched(Watch(std::nullopt, cancel), [&](const std::stop_token& stop) {
    found = inDefaultEnvironment(
        [&] { return solve(checker.shared(), first.front(), goals, options, stop); });
  });
  return found;
}

Plan planOnRoadmap(const RoadmapHandle& self, const py::object& start, const py::object& goal,
                   double seconds, std::uint32_t seedValue, bool shortens,
                   std::optional<double> simplifySeconds, const Token& cancel) {
  PlanOptions options{.planner = "RoadmapPlanner",
                      .seconds = seconds,
                      .seed = seedValue,
                      .range = {},
                      .shorten = shortens,
                      .simplifySeconds = simplifySeconds};
  requireOptions(options);
  const States first = statesOf(readVector(start, "start", self.dimension()));
  const Goals goals = readGoals(goal, self.dimension());
  Plan found;
  runWatched(Watch(std::nullopt, cancel), [&](const std::stop_token& stop) {
    found = self.read([&](const CertifiedRoadmap& roadmap) {
      options.roadmap = &roadmap;
      return inDefaultEnvironment(
          [&] { return solve(roadmap.graph().checker(), first.front(), goals, options, stop); });
    });
  });
  return found;
}

/// A path after `change` has worked on it as a path of OMPL.
template <typename Change>
py::object changed(const CheckerHandle& checker, const py::object& path, const Change& change) {
  const States states = statesOf(readTable(path, "path", checker.dimension()));
  if (states.empty()) throw std::invalid_argument("path: expected one state at least");
  States result;
  runWatched(Watch(std::nullopt, nullptr), [&](const std::stop_token&) {
    inDefaultEnvironment([&] {
      const og::SimpleSetupPtr setup = setupFor(checker.shared(), states);
      setup->getSpaceInformation()->setup();
      const StateConversion conversion(checker.checker().robot(), checker.checker().group());
      og::PathGeometric geometric(setup->getSpaceInformation());
      ob::ScopedState<> state(setup->getStateSpace());
      for (const std::vector<double>& q : states) {
        conversion.toState(q, state.get());
        geometric.append(state.get());
      }
      change(geometric);
      result = configurationsOf(geometric, checker.checker());
    });
  });
  return makeArray(result, checker.dimension());
}

void bindPlan(py::module_& module) {
  py::class_<Plan> type(
      module, "Plan",
      "The result of `plan`. True if it is solved and every segment is proven free.");
  type.def_readonly("solved", &Plan::solved, "Whether the planner has an exact solution.")
      .def_readonly("status", &Plan::status, "What OMPL says.")
      .def_readonly("planner", &Plan::planner, "Its name.")
      .def_property_readonly(
          "path",
          [](const Plan& self) -> py::object {
            if (self.states.empty()) return py::none();
            return makeArray(self.states, self.dimension);
          },
          "(m, n) rad or m; None if it is not solved.")
      .def_readonly("certificate", &Plan::certificate,
                    "PathCertificate of the path, without clearances.")
      .def_readonly("seconds", &Plan::seconds, "s, of planning and shortening.")
      .def_readonly("length", &Plan::length, "Of the path, in the metric of OMPL's space.")
      .def_readonly("motions_certified", &Plan::certified, "Motions that were proven free.")
      .def_readonly("motions_refused", &Plan::refused, "Motions in collision or undecided.")
      .def("__bool__",
           [](const Plan& self) {
             return !self.states.empty() && self.certificate.verdict() == Verdict::Free;
           })
      .def("__repr__", [](const Plan& self) {
        return "<swept.Plan of " + self.planner + ": " + self.status + ", " +
               std::to_string(self.states.size()) + " states>";
      });
  addImmutableCopies(type);

  const PoseGoalOptions usual;
  py::class_<PoseTarget> goal(
      module, "PoseGoal",
      "A goal of `plan`: the states in which a tool, a frame fixed in a link, "
      "has a pose (4, 4) in the model frame.");
  goal.def(py::init([](const std::string& link, const py::object& pose,
                       const py::object& linkFromTool, double position, double orientation) {
             return PoseTarget{link, readPose(pose, "pose"),
                               readPose(linkFromTool, "link_from_tool"), position, orientation};
           }),
           py::arg("link"), py::arg("pose"), py::kw_only(), py::arg("link_from_tool") = py::none(),
           py::arg("position_tolerance") = usual.positionTolerance,
           py::arg("orientation_tolerance") = usual.orientationTolerance,
           "Tolerances in m and rad; infinite ones allow any.")
      .def_readonly("link", &PoseTarget::link, "The link.")
      .def_property_readonly(
          "pose", [](const PoseTarget& self) { return makeArray(self.model_from_tool); },
          "(4, 4) model_from_tool.");
  addRepr(goal, {"link", "pose"});
  addImmutableCopies(goal);
}

ProvenTrajectory prove(const CheckerHandle& checker, const py::object& path,
                       const RateLimits& limits, double blendDeviation, double velocityScale,
                       double accelerationScale, bool jerkLimited,
                       const std::vector<std::size_t>& stops) {
  const Table states = readTable(path, "path", checker.dimension());
  const py::gil_scoped_release others;
  return provenTrajectory(checker.checker(), states.list(), limits,
                          {.blendDeviation = blendDeviation,
                           .velocityScale = velocityScale,
                           .accelerationScale = accelerationScale,
                           .jerkLimited = jerkLimited,
                           .stops = stops});
}

void bindTiming(py::module_& module) {
  py::class_<TimedCorner> corner(module, "TimedCorner",
                                 "A way point at which the path turns or stops.");
  corner.def_readonly("way_point", &TimedCorner::wayPoint, "Its index.")
      .def_readonly("deviation", &TimedCorner::deviation,
                    "rad or m, bounds the distance between blend and straight motions.")
      .def_readonly("begin", &TimedCorner::begin, "s, of the blend.")
      .def_readonly("end", &TimedCorner::end, "s, of the blend.")
      .def_property_readonly("stops", &TimedCorner::stops, "Whether the robot stops there.");
  addRepr(corner, {"way_point", "deviation", "begin", "end", "stops"});

  py::class_<ProvenTrajectory> type(
      module, "ProvenTrajectory",
      "A path with times, and the proof of its curve. True if all of it is proven free.");
  type.def_property_readonly(
          "trajectory", [](const ProvenTrajectory& self) { return self.timed.trajectory; },
          "Trajectory for a controller.")
      .def_property_readonly(
          "curve", [](const ProvenTrajectory& self) { return self.timed.curve; },
          "Curve that the controller makes of it.")
      .def_property_readonly(
          "corners",
          [](const ProvenTrajectory& self) { return py::tuple(py::cast(self.timed.corners)); },
          "A TimedCorner for each, in the order of the path.")
      .def_readonly("certificate", &ProvenTrajectory::certificate,
                    "TrajectoryCertificate of the curve.")
      .def("__bool__",
           [](const ProvenTrajectory& self) { return self.certificate.verdict == Verdict::Free; })
      .def("__repr__", [](const ProvenTrajectory& self) {
        return "<swept.ProvenTrajectory of " +
               std::string(py::str(py::float_(self.timed.curve.duration()))) + " s, " +
               std::string(toString(self.certificate.verdict)) + ">";
      });
  addImmutableCopies(type);

  const TimingOptions usual;
  module.def(
      "proven_trajectory", &prove, py::arg("checker"), py::arg("path"), py::arg("limits"),
      py::kw_only(), py::arg("blend_deviation") = usual.blendDeviation,
      py::arg("velocity_scale") = usual.velocityScale,
      py::arg("acceleration_scale") = usual.accelerationScale,
      py::arg("jerk_limited") = usual.jerkLimited, py::arg("stops") = std::vector<std::size_t>(),
      "ProvenTrajectory along a path (m, n), as fast as RateLimits allow, its corners blended as "
      "far as that is proven. `blend_deviation`:\nrad or m, how far a blend may leave the path; 0: "
      "the robot stops at corners. Scales: factors of all limits. `jerk_limited`:\nwhether "
      "limits of jerks hold, too. `stops`: indices of way points to stop at. If every straight "
      "motion is FREE, so is the curve,\nbut for rounding.");
}

}  // namespace

void bindPlanning(py::module_& module) {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  bindPlan(module);
  bindTiming(module);
  module.def(
      "planner_names", [] { return py::tuple(py::cast(plannerNames())); },
      "The planners that `plan` knows: CertifiedConnect, and the geometric ones of OMPL.");
  module.def(
      "plan", &plan, py::arg("checker"), py::arg("start"), py::arg("goal"), py::kw_only(),
      py::arg("planner") = "CertifiedConnect", py::arg("seconds") = 5.0, py::arg("seed") = 1,
      py::arg("range") = py::none(), py::arg("shorten") = true,
      py::arg("simplify_seconds") = py::none(), py::arg("cancel") = py::none(),
      "Plan of a path from start (n,) to a goal: (n,), any of (k, n), or a PoseGoal. `planner`: "
      "see planner_names(). `seconds`: how long\nit may search. `range`: longest motion of a "
      "tree. A checker's constraints hold all along the path; CertifiedConnect plans for them. The "
      "path is shortened by a few tens of motions, or by OMPL's simplifier for\n"
      "`simplify_seconds`. The same seed gives the same path, if no other thread plans with a "
      "planner of OMPL's. Ctrl-C and `cancel`\nend it: KeyboardInterrupt, Cancelled.");
  py::class_<RoadmapHandle>(module.attr("CertifiedRoadmap"))
      .def("plan", &planOnRoadmap, py::arg("start"), py::arg("goal"), py::kw_only(),
           py::arg("seconds") = 5.0, py::arg("seed") = 1, py::arg("shorten") = true,
           py::arg("simplify_seconds") = py::none(), py::arg("cancel") = py::none(),
           "Plan of a path in the roadmap's current world; arguments as `plan`. `seed`: of the "
           "samples of a PoseGoal.");
  module.def(
      "shorten_path",
      [](const CheckerHandle& checker, const py::object& path, int rounds, double leastGain) {
        return changed(checker, path, [&](og::PathGeometric& geometric) {
          shortenPath(geometric, {.rounds = rounds, .leastGain = leastGain});
        });
      },
      py::arg("checker"), py::arg("path"), py::kw_only(),
      py::arg("rounds") = ShorteningOptions().rounds,
      py::arg("least_gain") = ShorteningOptions().leastGain,
      "(k, n) a shorter path with the ends of path (m, n): states are joined, and corners cut in "
      "rounds, by motions that are proven free.\n`least_gain`: share of the length; a cut that "
      "gains less is not made.");
  module.def(
      "simplify_path",
      [](const CheckerHandle& checker, const py::object& path, double seconds) {
        return changed(checker, path, [&](og::PathGeometric& geometric) {
          simplifyPath(geometric, checker.checker(), seconds);
        });
      },
      py::arg("checker"), py::arg("path"), py::arg("seconds") = 0.5,
      "(k, n) a path simplified by OMPL for about `seconds`; the path itself, if the result is "
      "not proven free or not shorter.");
}

}  // namespace swept::python
