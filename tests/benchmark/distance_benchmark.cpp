// SPDX-License-Identifier: BSD-3-Clause
// What distances of states and motions cost: clearance(), signedClearance(), reportState(),
// motionClearance() and pathClearance().
//   [SWEPT_DATA=DATA] distance_benchmark [--seed N] [--samples N] [--only WORLD] [--query QUERY]
//                                        [--robot ROBOT]
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>
#include <string>

#include "data_folder.hpp"
#include "motion_samples.hpp"
#include "number_argument.hpp"
#include "robot_worlds.hpp"
#include "swept/robot_model/path_clearance.hpp"

namespace swept::benchmark {
namespace {

struct Options {
  std::uint64_t seed = 1;
  std::size_t samples = 100;
  std::string only;   ///< a world; empty: all
  std::string query;  ///< likewise
  std::string robot;  ///< likewise
};

constexpr double kAccuracy = 1e-3;  // m
constexpr double kLength = 1.0;     // rad

TriangleMesh meshFrom(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

/// Twelve bodies of about 0.2 m around an arm of 0.8 to 1.2 m at the origin: of one kind, or of all
/// in turn.
std::shared_ptr<const World> worldOfKind(const std::string& kind, std::uint64_t seed) {
  const std::vector<std::string> kinds{"boxes", "cylinders", "spheres", "meshes"};
  std::mt19937_64 random(seed);
  const Shape torus = meshFrom(bumpyTorus(50, 20, 0.1, 0.03));
  const Shape ball = meshFrom(bumpySphere(2000, 0.1));
  auto world = std::make_shared<World>();
  for (std::size_t i = 0; i < 12; ++i) {
    const std::string& own = kind == "mixed" ? kinds[i % kinds.size()] : kind;
    Eigen::Isometry3d pose = randomPose(random, Eigen::Vector3d::Zero());
    const double angle = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const double away = uniform(random, 0.45, 0.9);
    pose.translation() =
        Eigen::Vector3d(away * std::cos(angle), away * std::sin(angle), uniform(random, -0.1, 1.0));
    const double size = uniform(random, 0.1, 0.3);
    Shape shape = Sphere{0.5 * size};
    if (own == "boxes") shape = makeBox({size, 0.2, uniform(random, 0.05, 0.3)});
    if (own == "cylinders") shape = Cylinder{0.25 * size, uniform(random, 0.05, 0.15)};
    if (own == "meshes") shape = i % 2 == 0 ? torus : ball;
    world->add(own + std::to_string(i), std::move(shape), pose);
  }
  return world;
}

/// A sum that hardly any change of an answer leaves as it is, whatever the order.
class Checksum {
 public:
  void add(double value) { sum_ += std::isfinite(value) ? value : 1e6; }
  void add(const std::string& name) {
    for (const char letter : name) sum_ += 1e-3 * letter;
  }
  std::string text() const { return number(sum_, 10); }

 private:
  double sum_ = 0.0;
};

class DistanceBenchmark {
 public:
  DistanceBenchmark(const Options& options, const std::shared_ptr<const Robot>& robot,
                    const std::string& group)
      : options_(options), empty_(robot, group, std::make_shared<const World>()) {}

  void run() {
    const MarkdownTable table(
        {"world", "query", "free: mean", "median", "in contact: mean", "median", "sum"});
    for (const char* kind : {"boxes", "cylinders", "spheres", "meshes", "mixed"}) {
      if (!options_.only.empty() && options_.only != kind) continue;
      measureIn(kind, table);
    }
  }

 private:
  void measureIn(const std::string& kind, const MarkdownTable& table) {
    const Checker checker = empty_.withWorld(worldOfKind(kind, options_.seed));
    Workspace workspace(checker);
    std::mt19937_64 random(options_.seed);
    const MotionSamples samples =
        sampleMotions(checker, kLength, options_.samples, options_.samples / 2, 100'000, random);
    // The first state of the free motions, and the last of those that collide, if it does.
    std::vector<BenchMotion> touching;
    for (const BenchMotion& motion : samples.colliding)
      if (checker.checkState(motion.to, workspace) == Verdict::Collision)
        touching.push_back({motion.to, motion.from});
    const auto row = [&](const char* name, const auto& query) {
      if (!options_.query.empty() && options_.query != name) return;
      Checksum sum;
      const MotionCosts free = measure(samples.free, query, sum);
      const MotionCosts contact = measure(touching, query, sum);
      const auto micro = [](double value) { return number(1e-3 * value); };
      const auto mean = [&](const MotionCosts& costs) {
        return costs.nanoseconds.empty() ? "-" : micro(costs.mean());
      };
      const auto median = [&](const MotionCosts& costs) {
        return costs.nanoseconds.empty() ? "-" : micro(costs.median());
      };
      table.row({kind, name, mean(free), median(free), mean(contact), median(contact), sum.text()});
    };
    row("checkState", [&](const BenchMotion& motion, Checksum& sum) {
      sum.add(static_cast<double>(checker.checkState(motion.from, workspace)));
    });
    row("clearance", [&](const BenchMotion& motion, Checksum& sum) {
      sum.add(checker.clearance(motion.from, workspace));
    });
    row("signedClearance", [&](const BenchMotion& motion, Checksum& sum) {
      addSigned(checker.signedClearance(motion.from, workspace), sum);
    });
    std::vector<double> gradient(static_cast<std::size_t>(checker.dimension()));
    row("gradient", [&](const BenchMotion& motion, Checksum& sum) {
      addSigned(checker.signedClearance(motion.from, workspace, gradient), sum);
      for (const double value : gradient) sum.add(value);
    });
    row("reportState", [&](const BenchMotion& motion, Checksum& sum) {
      const StateReport report = checker.reportState(motion.from, workspace);
      sum.add(report.clearance);
      sum.add(report.world.clearance);
      sum.add(report.self.clearance);
      sum.add(report.nearestA);
      sum.add(report.nearestB);
      for (const Witness& contact : report.contacts) {
        sum.add(contact.bodyA);
        sum.add(contact.bodyB);
      }
    });
    const auto motionRow = [&](const char* name, ClearanceQuery query) {
      row(name, [&, query](const BenchMotion& motion, Checksum& sum) {
        const MotionClearance found =
            checker.motionClearance(motion.from, motion.to, kAccuracy, workspace, query);
        sum.add(found.lower);
        sum.add(found.upper);
      });
    };
    motionRow("motionClearance, least", ClearanceQuery::Least);
    motionRow("motionClearance, by kind", ClearanceQuery::ByKind);
    motionRow("motionClearance, world", ClearanceQuery::World);
    row("pathClearance, 8 motions", [&](const BenchMotion& motion, Checksum& sum) {
      std::vector<Eigen::VectorXd> path;
      for (int i = 0; i <= 8; ++i)
        path.push_back(checker.interpolate(motion.from, motion.to, i / 8.0));
      const PathClearance found = pathClearance(checker, path, kAccuracy, workspace);
      sum.add(found.lower);
      sum.add(found.upper);
    });
  }

  static void addSigned(const SignedClearance& found, Checksum& sum) {
    sum.add(found.lower);
    sum.add(found.upper);
    for (int i = 0; i < 3; ++i) sum.add(found.normal[i]);
  }

  template <typename Query>
  MotionCosts measure(const std::vector<BenchMotion>& motions, const Query& query,
                      Checksum& sum) const {
    constexpr int kPasses = 5;
    MotionCosts costs;
    costs.nanoseconds.resize(motions.size(), std::numeric_limits<double>::infinity());
    for (int pass = 0; pass < kPasses; ++pass) {
      for (std::size_t i = 0; i < motions.size(); ++i) {
        Checksum own = sum;
        const double taken = clock_.time([&] { query(motions[i], own); });
        costs.nanoseconds[i] = std::min(costs.nanoseconds[i], taken);
        if (pass == 0) sum = own;
      }
    }
    return costs;
  }

  Options options_;
  Checker empty_;
  BenchClock clock_;
};

void runAll(const Options& options) {
  std::printf("Distances, us. Random states and motions of %g rad among 12 bodies\n", kLength);
  for (const RobotCase& which : robotCases(dataFolder().value_or(""))) {
    if (!options.robot.empty() && which.name != options.robot) continue;
    if (which.name != "rook7" && which.name != "Panda") continue;
    std::printf("\n## %s\n\n", which.name.c_str());
    if (which.needsData && !dataFolder()) {
      std::printf("skipped: SWEPT_DATA is not set\n");
      continue;
    }
    DistanceBenchmark(options, loadRobot(which), which.group).run();
  }
}

std::optional<Options> parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i], value = argv[i + 1];
    constexpr std::size_t kMost = 1'000'000;
    if (name == "--only") {
      options.only = value;
    } else if (name == "--robot") {
      options.robot = value;
    } else if (name == "--query") {
      options.query = value;
    } else if (const auto count = countOf(value, kMost); count && name == "--seed") {
      options.seed = *count;
    } else if (count && name == "--samples") {
      options.samples = *count;
    } else {
      return std::nullopt;
    }
  }
  if (argc % 2 == 0) return std::nullopt;
  return options;
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  const auto options = swept::benchmark::parse(argc, argv);
  if (!options) {
    std::cerr << "usage: distance_benchmark [--seed N] [--samples N] [--only WORLD] "
                 "[--query QUERY] [--robot ROBOT]\n";
    return EXIT_FAILURE;
  }
  swept::benchmark::runAll(*options);
  return EXIT_SUCCESS;
}
