// SPDX-License-Identifier: BSD-3-Clause
/// Records the planned paths of paths_test.cpp: `record_paths MODELS FOLDER` writes them and their
/// verdicts into FOLDER. Lines of verdicts.csv for files that it does not write stay as they are.
///
/// Three kinds of problems: the stored queries; random ends; and random ends planned with motions
/// checked discretely, at a resolution at which some segments of the path collide. The planners
/// take turns; one that does not solve a problem, or cannot work in the space, leaves it to the
/// next. All of them run in one thread and for a number of iterations, so that the same seed gives
/// the same path unless the time limit cuts in.

#include <ompl/base/ScopedState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>
#include <ompl/util/RandomNumbers.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/ompl_bridge/planners.hpp"

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using swept::Checker;
using swept::Verdict;
using Configuration = std::vector<double>;
using Path = std::vector<Configuration>;

constexpr std::array kPlanners = {
    "RRTConnect", "RRT",      "BiEST",     "KPIECE1",  "BITstar", "SBL",     "TRRT",
    "PDST",       "BKPIECE1", "FMT",       "STRIDE",   "BiTRRT",  "LazyRRT", "ABITstar",
    "EST",        "LazyPRM",  "LBKPIECE1", "RRTsharp", "ProjEST", "BiRLRT",  "InformedRRTstar",
    "SST",        "RRTstar",  "BFMT"};
constexpr double kReach = 1.5;            // m, of translations that the robot does not bound
constexpr unsigned kIterations = 20'000;  // of a planner
constexpr double kSeconds = 5.0;          // of a planner
constexpr std::size_t kMostStates = 16;   // of a path that is kept as the planner returned it
constexpr double kCoarse = 0.05;          // of the space's extent, between discrete checks

struct Place {
  std::string robot, scene, group;
};

const std::vector<Place> kPlaces = {
    {"rook7", "empty", "arm"},
    {"rook6", "tunnel_trap", "arm"},
    {"rook6_cart", "shelf", "whole_body"},
    {"drifter", "cage", "body"},
    {"rook7", "shelf", "arm"},
    {"rook6", "bin", "arm"},
    {"rook6_cart", "table_objects", "base"},
    {"drifter", "tunnel_trap", "body"},
    {"rook7", "tunnel_trap", "arm_with_gripper"},
    {"rook6", "empty", "arm"},
    {"rook6_cart", "cage", "arm"},
    {"drifter", "shelf", "body"},
    {"rook7", "table_objects", "arm"},
    {"rook6", "cage", "arm_with_tool"},
    {"rook6_cart", "tunnel_trap", "whole_body"},
    {"drifter", "table_objects", "body"},
    {"rook7", "cage", "arm"},
    {"rook6", "narrow_slot", "arm"},
    {"rook6_cart", "narrow_slot", "base"},
    {"drifter", "bin", "body"},
    {"rook7", "bin", "arm_with_gripper"},
    {"rook6", "table_objects", "arm"},
    {"rook6_cart", "bin", "whole_body"},
    {"drifter", "narrow_slot", "body"},
};

struct Problem {
  Place place;
  std::optional<Path> ends;  ///< start and goal; none: random ones
  swept::MotionCheck motions = swept::MotionCheck::Certified;
};

std::vector<Problem> problems(const std::filesystem::path& models) {
  std::vector<Problem> all;
  for (const YAML::Node& query : YAML::LoadFile(models / "queries.yaml")) {
    const auto word = [&](const char* key) { return query[key].as<std::string>(); };
    all.push_back(
        {.place = {word("robot"), word("scene"), word("group")},
         .ends = Path{query["start"].as<Configuration>(), query["goal"].as<Configuration>()}});
  }
  for (const auto motions : {swept::MotionCheck::Certified, swept::MotionCheck::Discrete})
    for (const Place& place : kPlaces)
      all.push_back({.place = place, .ends = {}, .motions = motions});
  return all;
}

swept::StateSpaceOptions reachOf(const Checker& checker) {
  swept::StateSpaceOptions options;
  for (const int index : checker.group().variables) {
    const swept::Variable& variable = checker.robot().variables()[index];
    if (std::isinf(variable.lower) && !variable.cyclic)
      options.limits[variable.name] = {-kReach, kReach};
  }
  return options;
}

class Recorder {
 public:
  Recorder(std::filesystem::path models, std::filesystem::path folder)
      : models_(std::move(models)), folder_(std::move(folder)) {}

  void record(const Problem& problem, std::uint32_t seed) {
    const auto checker = checkerOf(problem.place);
    for (std::size_t i = 0; i < kPlanners.size(); ++i) {
      const std::string planner = kPlanners[(seed + i) % kPlanners.size()];
      const auto path = plan(problem, checker, planner, seed);
      if (!path || path->size() < 3) continue;
      const auto certificates = certify(*path, *checker);
      const bool discrete = problem.motions == swept::MotionCheck::Discrete;
      const bool free = std::ranges::all_of(
          certificates, [](const auto& one) { return one.verdict == Verdict::Free; });
      if (!free && !discrete)
        std::cerr << "not all free: problem " << seed << ", by " << planner << '\n';
      if (free == discrete) continue;
      write(problem.place, planner + (discrete ? "-discrete" : ""), *checker, *path, certificates);
      return;
    }
    std::cerr << "no path: problem " << seed << ", " << problem.place.robot << " in "
              << problem.place.scene << '\n';
  }

  void writeVerdicts() {
    std::ifstream before(folder_ / "verdicts.csv");
    std::string header, line;
    std::getline(before, header);
    std::map<std::string, std::vector<std::string>> others;
    while (std::getline(before, line)) others[line.substr(0, line.find(','))].push_back(line);
    verdicts_.merge(others);
    std::ofstream out(folder_ / "verdicts.csv");
    out << "file,segment,verdict,free_until\n";
    for (const auto& [file, lines] : verdicts_)
      for (const std::string& each : lines) out << each << '\n';
    close(out, folder_ / "verdicts.csv");
  }

 private:
  static void close(std::ofstream& out, const std::filesystem::path& file) {
    out.close();
    if (!out) throw std::runtime_error(file.string() + " cannot be written");
  }

  std::shared_ptr<const Checker> checkerOf(const Place& place) {
    auto& robot = robots_[place.robot];
    const auto stem = models_ / "robots" / place.robot / place.robot;
    if (!robot) robot = swept::Robot::load(stem.string() + ".urdf", stem.string() + ".srdf");
    const auto world = std::make_shared<const swept::World>(
        swept::World::load(models_ / "scenes" / (place.scene + ".yaml")));
    return std::make_shared<const Checker>(robot, place.group, world);
  }

  /// Two valid states that no straight motion joins, for sure.
  static bool drawEnds(const ob::SpaceInformationPtr& si,
                       const std::shared_ptr<const Checker>& checker, ob::State* start,
                       ob::State* goal) {
    constexpr int kTries = 10'000;
    const swept::CertifiedMotionValidator certified(si, checker);
    const ob::StateSamplerPtr sampler = si->allocStateSampler();
    for (int i = 0; i < kTries; ++i) {
      sampler->sampleUniform(start);
      sampler->sampleUniform(goal);
      if (si->isValid(start) && si->isValid(goal) && !certified.checkMotion(start, goal))
        return true;
    }
    return false;
  }

  static std::optional<Path> plan(const Problem& problem,
                                  const std::shared_ptr<const Checker>& checker,
                                  const std::string& planner, std::uint32_t seed) {
    ompl::RNG::setSeed(seed);
    const auto setup =
        swept::makeSimpleSetup(checker, {.space = reachOf(*checker), .motions = problem.motions});
    const ob::SpaceInformationPtr& si = setup->getSpaceInformation();
    if (problem.motions == swept::MotionCheck::Discrete)
      si->setStateValidityCheckingResolution(kCoarse);
    si->setup();
    const swept::StateConversion conversion(checker->robot(), checker->group());
    ob::ScopedState<> start(si), goal(si);
    if (problem.ends) {
      conversion.toState(problem.ends->front(), start.get());
      conversion.toState(problem.ends->back(), goal.get());
    } else if (!drawEnds(si, checker, start.get(), goal.get())) {
      return std::nullopt;
    }
    setup->setStartAndGoalStates(start, goal);
    // The first path is good enough.
    const auto any = std::make_shared<ob::PathLengthOptimizationObjective>(si);
    any->setCostThreshold(ob::Cost(std::numeric_limits<double>::infinity()));
    setup->setOptimizationObjective(any);
    setup->setPlanner(swept::makePlanner(planner, si));
    ob::IterationTerminationCondition iterations(kIterations);
    const auto end = ob::plannerOrTerminationCondition(
        iterations, ob::timedPlannerTerminationCondition(kSeconds));
    try {
      if (setup->solve(end) != ob::PlannerStatus::EXACT_SOLUTION) return std::nullopt;
    } catch (const ompl::Exception&) {
      return std::nullopt;  // some planners do not take every kind of space
    }
    og::PathGeometric& path = setup->getSolutionPath();
    if (seed % 2 == 0 || path.getStateCount() > kMostStates)
      og::PathSimplifier(si).simplifyMax(path);
    return statesOf(path, conversion);
  }

  static Path statesOf(const og::PathGeometric& path, const swept::StateConversion& conversion) {
    Path states;
    for (std::size_t i = 0; i < path.getStateCount(); ++i) {
      states.emplace_back(conversion.dimension());
      conversion.toConfiguration(path.getState(static_cast<unsigned int>(i)), states.back());
    }
    return states;
  }

  /// Of the numbers in the file.
  static std::vector<swept::MotionCertificate> certify(const Path& path, const Checker& checker) {
    swept::Workspace workspace(checker);
    std::vector<swept::MotionCertificate> certificates;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      certificates.push_back(checker.certifyMotion(path[i], path[i + 1], workspace));
    return certificates;
  }

  void write(const Place& place, const std::string& planner, const Checker& checker,
             const Path& path, const std::vector<swept::MotionCertificate>& certificates) {
    const std::string stem = place.robot + "." + place.scene + "." + place.group + "." + planner;
    char number[32];
    std::snprintf(number, sizeof number, ".%02d.csv", ++numbers_[stem]);
    const std::string file = stem + number;
    std::ofstream out(folder_ / file);
    out.precision(17);
    const char* comma = "";
    for (const int v : checker.group().variables) {
      out << comma << checker.robot().variables()[v].name;
      comma = ",";
    }
    out << '\n';
    for (const Configuration& q : path)
      for (std::size_t i = 0; i < q.size(); ++i) out << q[i] << (i + 1 < q.size() ? "," : "\n");
    close(out, folder_ / file);
    for (std::size_t i = 0; i < certificates.size(); ++i) {
      char until[16];
      std::snprintf(until, sizeof until, "%.3f", certificates[i].freeUntil);
      verdicts_[file].push_back(file + "," + std::to_string(i) + "," +
                                std::string(toString(certificates[i].verdict)) + "," + until);
    }
  }

  std::filesystem::path models_, folder_;
  std::map<std::string, std::shared_ptr<const swept::Robot>> robots_;
  std::map<std::string, int> numbers_;
  std::map<std::string, std::vector<std::string>> verdicts_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: record_paths MODELS FOLDER\n";
    return 3;
  }
  ompl::msg::noOutputHandler();
  try {
    Recorder recorder(argv[1], argv[2]);
    std::uint32_t seed = 0;
    for (const Problem& problem : problems(argv[1])) recorder.record(problem, ++seed);
    recorder.writeVerdicts();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
