// SPDX-License-Identifier: BSD-3-Clause
// What certifying motions costs: more joints, finer meshes, larger worlds, other robots.
//   motion_benchmark [--seed N] [--only dof|mesh|world|robots]
#include <cstdlib>
#include <iostream>
#include <optional>
#include <random>

#include "../robot_model/input_files.hpp"
#include "box_worlds.hpp"
#include "data_folder.hpp"
#include "exit_code.hpp"
#include "made_arms.hpp"
#include "robot_costs.hpp"
#include "robot_worlds.hpp"

namespace swept::benchmark {
namespace {

struct Options {
  std::uint64_t seed = 1;
  std::string only;

  bool wants(const char* part) const { return only.empty() || only == part; }
};

/// A checker, and how long it took.
struct BuiltChecker {
  std::shared_ptr<const Checker> checker;
  double seconds = 0.0;

  BuiltChecker(const std::shared_ptr<const Robot>& robot, const std::string& group,
               const std::shared_ptr<const World>& world) {
    seconds = secondsOf([&] { checker = std::make_shared<const Checker>(robot, group, world); });
  }
  std::string milliseconds() const { return whole(1e3 * seconds); }
};

/// Rows that are compared with the first of them.
class CostTable {
 public:
  CostTable(const std::vector<std::string>& head, std::uint64_t seed, const BenchClock& clock)
      : table_(RobotCosts::head(head)), columns_(head.size()), seed_(seed), clock_(clock) {}

  void add(const std::vector<std::string>& cells, const Checkers& checkers) {
    const RobotCosts costs = costsOf(checkers, seed_, clock_);
    if (!reference_) reference_ = costs.freeMean();
    table_.row(costs.row(cells, *reference_));
  }
  void skip(const std::string& name) const {
    std::vector<std::string> cells(RobotCosts::head({}).size() + columns_, "skipped");
    cells.front() = name;
    table_.row(cells);
  }

 private:
  MarkdownTable table_;
  std::size_t columns_;
  std::uint64_t seed_;
  const BenchClock& clock_;
  std::optional<double> reference_;
};

class MotionBenchmark {
 public:
  explicit MotionBenchmark(const Options& options) : options_(options) {}

  void run() {
    std::printf(
        "Free and colliding motions: median / mean ns (share decided in single precision)\n");
    if (options_.wants("dof")) joints();
    if (options_.wants("mesh")) meshes();
    if (options_.wants("world")) worlds();
    if (options_.wants("robots")) robots();
  }

 private:
  void joints() const {
    std::printf("\n## Joints: arms of the same length among 12 boxes\n\n");
    CostTable table({"joints", "pairs", "checker ms"}, options_.seed, clock_);
    const auto world = std::make_shared<const World>(worldOf(twelveBoxes()));
    for (const int count : {7, 10, 14, 20, 30, 40, 50}) {
      const BuiltChecker built(Robot::parse(SerialArm{count}.urdf(), "arm.urdf"), "all", world);
      table.add({std::to_string(count), std::to_string(built.checker->checkedPairs().size()),
                 built.milliseconds()},
                {built.checker});
    }
  }

  void meshes() const {
    std::printf("\n## Link meshes: 7 joints among 12 boxes, as many triangles in each link\n\n");
    CostTable table({"triangles", "load s", "checker ms"}, options_.seed, clock_);
    const auto world = std::make_shared<const World>(worldOf(twelveBoxes()));
    const SerialArm arm;
    for (const int wanted : {1'000, 10'000, 100'000, 1'000'000}) {
      const test::TemporaryFolder folder;
      std::size_t triangles = 0;
      for (int link = 1; link <= arm.joints; ++link) {
        const Soup soup = arm.linkMesh(wanted / arm.joints);
        triangles += soup.triangles.size();
        writeStl(soup, folder.path() / ("link" + std::to_string(link) + ".stl"));
      }
      std::shared_ptr<const Robot> robot;
      const double load = secondsOf([&] {
        robot = Robot::parse(arm.urdfWithMeshes(), (folder.path() / "arm.urdf").string());
      });
      const BuiltChecker built(robot, "all", world);
      table.add({std::to_string(triangles), number(load, 2), built.milliseconds()},
                {built.checker});
    }
  }

  /// Those that have the same verdict in all worlds.
  static std::vector<BenchMotion> agreed(std::vector<BenchMotion> motions, Verdict verdict,
                                         const Checkers& checkers) {
    for (const auto& checker : checkers) {
      Workspace workspace(*checker);
      std::erase_if(motions, [&](const BenchMotion& motion) {
        const MotionCertificate found =
            checker->certifyMotion(motion.from, motion.to, workspace, MotionQuery::VerdictOnly);
        return found.verdict != verdict;
      });
    }
    return motions;
  }

  struct SharedMotions {
    std::vector<std::vector<BenchMotion>> free;  ///< by length
    std::vector<BenchMotion> colliding;
  };

  SharedMotions sharedBy(const Checkers& checkers) const {
    std::mt19937_64 random(options_.seed);
    SharedMotions shared;
    for (std::size_t i = 0; i < kLengths.size(); ++i) {
      const std::size_t colliding = i == kMiddle ? kColliding : 0;
      const MotionSamples samples =
          sampleMotions(*checkers.front(), kLengths[i], kFree, colliding, kMostTried, random);
      shared.free.push_back(agreed(samples.free, Verdict::Free, checkers));
      if (i == kMiddle) shared.colliding = agreed(samples.colliding, Verdict::Collision, checkers);
    }
    return shared;
  }

  /// `reference`: ns, by length, in the first world; is filled in by it.
  void addCosts(const Checker& checker, const SharedMotions& motions, bool hasPeer,
                std::vector<double>& reference, std::vector<std::string>& cells) const {
    std::vector<double> means;
    for (const auto& free : motions.free) {
      MotionCosts costs;
      measureMotions(checker, free, kSeconds, clock_, costs);
      means.push_back(costs.mean());
      if (reference.size() < means.size()) reference.push_back(costs.mean());
      cells.push_back(costs.text());
      cells.push_back(number(costs.mean() / reference[means.size() - 1]));
    }
    MotionCosts colliding;
    measureMotions(checker, motions.colliding, kSeconds, clock_, colliding);
    cells.push_back(colliding.text());
    const double peer = hasPeer ? measurePeer(checker, motions.free[kMiddle], clock_).mean() : 0.0;
    cells.push_back(hasPeer ? number(1e-3 * peer) : "-");
    cells.push_back(hasPeer ? number(means[kMiddle] / peer, 2) : "-");
  }

  void worlds() const {
    worldsAround("7 joints", Robot::parse(SerialArm{}.urdf(), "arm.urdf"), "all");
    const auto data = dataFolder();
    for (const RobotCase& which : robotCases(data.value_or(""))) {
      if (which.name != "Panda") continue;
      if (data)
        worldsAround(which.name, loadRobot(which), which.group);
      else
        std::printf("\nPanda: skipped\n");
    }
  }

  void worldsAround(const std::string& name, const std::shared_ptr<const Robot>& robot,
                    const std::string& group) const {
    std::printf("\n## Worlds: %s, the same space occupied, the same motions\n\n", name.c_str());
    const MarkdownTable table({"world", "world MB", "checker MB", "checker ms", "withWorld ms",
                               "free 0.1 rad", "of first row", "free 1 rad", "of first row",
                               "free 4 rad", "of first row", "colliding 1 rad", "FCL + OMPL us",
                               "swept / FCL"});
    const Checker empty(robot, group, std::make_shared<const World>());
    const std::vector<NamedWorld> worlds = worldsOfOneSpace();
    Checkers checkers;
    std::vector<std::vector<std::string>> rows;
    for (const NamedWorld& world : worlds) {
      const double before = heapBytes();
      const BuiltChecker built(robot, group, world.world);
      const double bytes = heapBytes() - before;
      const double again = secondsOf([&] { empty.withWorld(world.world); });
      rows.push_back({world.name, number(world.megabytes, 2), number(1e-6 * bytes, 2),
                      built.milliseconds(), number(1e3 * again, 2)});
      checkers.push_back(built.checker);
    }
    const SharedMotions motions = sharedBy(checkers);
    std::vector<double> reference;
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      addCosts(*checkers[i], motions, builtWithFcl(), reference, rows[i]);
      table.row(rows[i]);
    }
    std::printf("\nSame verdict in all worlds: %zu, %zu, %zu free, %zu colliding\n",
                motions.free[0].size(), motions.free[1].size(), motions.free[2].size(),
                motions.colliding.size());
    states(worlds, checkers);
  }

  /// Uniform ones, the same in all worlds. FCL is asked for motions so short that their end is the
  /// only state between.
  void states(const std::vector<NamedWorld>& worlds, const Checkers& checkers) const {
    std::printf("\nStates of these worlds: median / mean ns\n\n");
    const MarkdownTable table({"world", "free", "in collision", "undecided", "one state",
                               "of first row", "FCL us", "swept / FCL"});
    constexpr int kStates = 1000;
    std::mt19937_64 random(options_.seed);
    MotionSampler sampler(*checkers.front(), random);
    std::vector<BenchMotion> ends;
    for (int i = 0; i < kStates; ++i) ends.push_back(sampler.draw(1e-6));
    double reference = 0.0;
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      const StateCosts found = measureEnds(*checkers[i], ends, clock_);
      if (i == 0) reference = found.costs.mean();
      const double peer = builtWithFcl() ? measurePeer(*checkers[i], ends, clock_).mean() : 0.0;
      const auto count = [&](Verdict verdict) {
        return std::to_string(found.verdicts[static_cast<std::size_t>(verdict)]);
      };
      table.row({worlds[i].name, count(Verdict::Free), count(Verdict::Collision),
                 count(Verdict::Undecided),
                 whole(found.costs.median()) + " / " + whole(found.costs.mean()),
                 number(found.costs.mean() / reference), peer > 0.0 ? number(1e-3 * peer) : "-",
                 peer > 0.0 ? number(found.costs.mean() / peer, 2) : "-"});
    }
  }

  void robots() const {
    std::printf("\n## Robots\n\n");
    CostTable table({"robot", "variables", "worlds", "load s", "checker ms"}, options_.seed,
                    clock_);
    const auto data = dataFolder();
    for (const RobotCase& which : robotCases(data.value_or(""))) {
      if (which.needsData && !data) {
        table.skip(which.name);
        continue;
      }
      std::shared_ptr<const Robot> robot;
      const double load = secondsOf([&] { robot = loadRobot(which); });
      const auto worlds = loadWorlds(which);
      const BuiltChecker built(robot, which.group, worlds.front());
      Checkers checkers{built.checker};
      for (std::size_t i = 1; i < worlds.size(); ++i)
        checkers.push_back(std::make_shared<const Checker>(built.checker->withWorld(worlds[i])));
      table.add({which.name, std::to_string(built.checker->dimension()),
                 std::to_string(worlds.size()), number(load, 2), built.milliseconds()},
                checkers);
    }
  }

  Options options_;
  BenchClock clock_;
};

std::optional<Options> optionsOf(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (i + 1 == argc) return std::nullopt;
    const std::string value = argv[i + 1];
    if (name == "--only") {
      if (value != "dof" && value != "mesh" && value != "world" && value != "robots")
        return std::nullopt;
      options.only = value;
    } else if (name == "--seed") {
      char* end = nullptr;
      options.seed = std::strtoull(value.c_str(), &end, 10);
      if (*end != '\0') return std::nullopt;
    } else {
      return std::nullopt;
    }
  }
  return options;
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  return swept::benchmark::exitCodeOf(swept::benchmark::optionsOf(argc, argv),
                                      "motion_benchmark [--seed N] [--only dof|mesh|world|robots]",
                                      [](const auto& options) {
                                        swept::benchmark::MotionBenchmark(options).run();
                                        return true;
                                      });
}
