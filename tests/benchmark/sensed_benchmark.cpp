// SPDX-License-Identifier: BSD-3-Clause
// What certifying motions costs among points, triangles and boxes of any number, and how much of it
// is that of the slowest motions.
//   sensed_benchmark [--only points|meshes|boxes] [--kind NAME] [--size N] [--robot NAME]
//                    [--motions N] [--passes N] [--slowest N]
#include <cinttypes>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>

#include "data_folder.hpp"
#include "exit_code.hpp"
#include "made_arms.hpp"
#include "motion_samples.hpp"
#include "number_argument.hpp"
#include "robot_worlds.hpp"
#include "sensed_worlds.hpp"

namespace swept::benchmark {
namespace {

struct Options {
  std::string part, kind, robot;
  std::size_t size = 0;  ///< 0: all
  std::size_t motions = 500;
  std::size_t passes = 5;
  std::size_t slowest = 0;  ///< so many motions are listed
};

struct NamedRobot {
  std::string name;
  std::shared_ptr<const Robot> robot;
  std::string group;
};

/// The arms of which a table can be made: without data two of them.
std::vector<NamedRobot> arms() {
  std::vector<NamedRobot> found;
  found.push_back({"7 joints", Robot::parse(SerialArm{}.urdf(), "arm.urdf"), "all"});
  const auto data = dataFolder();
  for (const RobotCase& which : robotCases(data.value_or(""))) {
    if (which.name != "rook7" && which.name != "Panda") continue;
    if (which.needsData && !data) {
      std::printf("%s: skipped\n", which.name.c_str());
      continue;
    }
    found.push_back({which.name, loadRobot(which), which.group});
  }
  return found;
}

/// Free motions of 1 rad, and a digest of the verdicts of all that were drawn.
struct Drawn {
  std::vector<BenchMotion> free;
  std::array<int, 3> verdicts{};  ///< by Verdict
  std::uint64_t digest = 0xcbf29ce484222325;
};

Drawn draw(const Checker& checker, std::size_t wanted) {
  constexpr int kMostDrawn = 20'000;
  std::mt19937_64 random(1);
  MotionSampler sampler(checker, random);
  Workspace workspace(checker);
  Drawn drawn;
  for (int i = 0; i < kMostDrawn && drawn.free.size() < wanted; ++i) {
    BenchMotion motion = sampler.draw(1.0);
    const Verdict verdict =
        checker.certifyMotion(motion.from, motion.to, workspace, MotionQuery::VerdictOnly).verdict;
    const auto index = static_cast<std::size_t>(verdict);
    ++drawn.verdicts[index];
    drawn.digest = (drawn.digest ^ index) * 0x100000001b3;
    if (verdict == Verdict::Free) drawn.free.push_back(std::move(motion));
  }
  return drawn;
}

/// The mean of the slowest hundredth, one motion at least.
double meanOfSlowest(std::vector<double> nanoseconds) {
  const std::size_t count = std::max<std::size_t>(1, nanoseconds.size() / 100);
  std::ranges::sort(nanoseconds, std::greater());
  return std::accumulate(nanoseconds.begin(),
                         nanoseconds.begin() + static_cast<std::ptrdiff_t>(count), 0.0) /
         static_cast<double>(count);
}

class SensedBenchmark {
 public:
  explicit SensedBenchmark(const Options& options) : options_(options) {}

  void run() const {
    const std::vector<NamedRobot> robots = arms();
    const MarkdownTable table({"robot", "world", "size", "checker ms", "free, colliding, undecided",
                               "median us", "mean us", "mean / median", "in single precision",
                               "slowest 1 %, us", "share of the time", "verdicts"});
    for (const SensedKind& kind : sensedKinds()) {
      if (!options_.part.empty() && options_.part != kind.part) continue;
      if (!options_.kind.empty() && options_.kind != kind.name) continue;
      for (const int size : kind.sizes) {
        if (options_.size != 0 && options_.size != static_cast<std::size_t>(size)) continue;
        const auto world = std::make_shared<const World>(kind.make(size));
        for (const NamedRobot& robot : robots) {
          if (!options_.robot.empty() && options_.robot != robot.name) continue;
          row(table, kind, size, robot, world);
        }
      }
    }
  }

 private:
  void row(const MarkdownTable& table, const SensedKind& kind, int size, const NamedRobot& robot,
           const std::shared_ptr<const World>& world) const {
    std::unique_ptr<const Checker> checker;
    const double build = secondsOf(
        [&] { checker = std::make_unique<const Checker>(robot.robot, robot.group, world); });
    const Drawn drawn = draw(*checker, options_.motions);
    if (drawn.free.empty()) {
      std::printf("%s among %s of %d: no free motion\n", robot.name.c_str(), kind.name.c_str(),
                  size);
      return;
    }
    const MotionCosts costs = measure(*checker, drawn.free);
    const double median = costs.median(), mean = costs.mean();
    const double slowest = meanOfSlowest(costs.nanoseconds);
    const auto count = static_cast<double>(drawn.free.size());
    const double ofSlowest = std::max(1.0, std::floor(0.01 * count)) * slowest;
    char digest[17];
    std::snprintf(digest, sizeof digest, "%016" PRIx64, drawn.digest);
    const auto drawnOf = [&](Verdict verdict) {
      return std::to_string(drawn.verdicts[static_cast<std::size_t>(verdict)]);
    };
    table.row({robot.name, kind.name, std::to_string(size), number(1e3 * build),
               drawnOf(Verdict::Free) + ", " + drawnOf(Verdict::Collision) + ", " +
                   drawnOf(Verdict::Undecided),
               number(1e-3 * median), number(1e-3 * mean), number(mean / median, 2),
               number(100.0 * static_cast<double>(costs.inLanes) / count) + " %",
               number(1e-3 * slowest), number(100.0 * ofSlowest / (mean * count), 2) + " %",
               digest});
    list(*checker, drawn.free, costs);
  }

  /// The least of some passes over all motions: no motion finds the caches as its own last pass
  /// left them.
  MotionCosts measure(const Checker& checker, const std::vector<BenchMotion>& motions) const {
    MotionCosts costs;
    costs.nanoseconds.resize(motions.size(), std::numeric_limits<double>::infinity());
    Workspace workspace(checker);
    for (std::size_t pass = 0; pass < options_.passes; ++pass) {
      for (std::size_t i = 0; i < motions.size(); ++i) {
        MotionCertificate certificate;
        const double taken = clock_.time([&] {
          certificate = checker.certifyMotion(motions[i].from, motions[i].to, workspace,
                                              MotionQuery::VerdictOnly);
        });
        costs.nanoseconds[i] = std::min(costs.nanoseconds[i], taken);
        if (pass == 0 && certificate.effort.intervals == 0) ++costs.inLanes;
      }
    }
    return costs;
  }

  /// The slowest motions, and their effort.
  void list(const Checker& checker, const std::vector<BenchMotion>& motions,
            const MotionCosts& costs) const {
    std::vector<std::size_t> order(motions.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
      return costs.nanoseconds[a] > costs.nanoseconds[b];
    });
    Workspace workspace(checker);
    for (std::size_t i = 0; i < std::min(options_.slowest, order.size()); ++i) {
      const BenchMotion& motion = motions[order[i]];
      const MotionCertificate certificate =
          checker.certifyMotion(motion.from, motion.to, workspace, MotionQuery::VerdictOnly);
      const MotionClearance clearance =
          checker.motionClearance(motion.from, motion.to, 1e-5, workspace, ClearanceQuery::ByKind);
      std::printf("  motion %zu: %.1f us, %d intervals, %" PRId64 " distances, %" PRId64
                  " culled, %" PRId64 " lanes; from the world %.2f mm, itself %.2f mm\n",
                  order[i], 1e-3 * costs.nanoseconds[order[i]], certificate.effort.intervals,
                  certificate.effort.distances, certificate.effort.culled, certificate.effort.lanes,
                  1e3 * clearance.world.lower, 1e3 * clearance.self.lower);
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
    const auto count = [&](std::size_t& into) {
      const auto read = countOf(value, 100'000'000);
      if (read) into = *read;
      return read.has_value();
    };
    bool understood = true;
    if (name == "--only")
      options.part = value;
    else if (name == "--kind")
      options.kind = value;
    else if (name == "--robot")
      options.robot = value;
    else if (name == "--size")
      understood = count(options.size);
    else if (name == "--motions")
      understood = count(options.motions);
    else if (name == "--passes")
      understood = count(options.passes);
    else if (name == "--slowest")
      understood = count(options.slowest);
    else
      understood = false;
    if (!understood) return std::nullopt;
  }
  return options;
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  return swept::benchmark::exitCodeOf(
      swept::benchmark::optionsOf(argc, argv),
      "sensed_benchmark [--only points|meshes|boxes] [--kind NAME] [--size N] [--robot NAME] "
      "[--motions N] [--passes N] [--slowest N]",
      [](const auto& options) {
        swept::benchmark::SensedBenchmark(options).run();
        return true;
      });
}
