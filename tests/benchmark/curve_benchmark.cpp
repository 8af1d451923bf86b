// SPDX-License-Identifier: BSD-3-Clause
// What certifying timed curves costs, beside the polyline through the same knots, without and with
// a tube, and what samples of the same curves miss.
//   curve_benchmark [--seed N] [--curves N] [--csv FILE] [--svg FILE]
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>

#include "bench/clock.hpp"
#include "curve_samples.hpp"
#include "data_folder.hpp"
#include "exit_code.hpp"
#include "report/plot.hpp"
#include "robot_worlds.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

struct Options {
  std::uint64_t seed = 1;
  int curves = 2000;  ///< of each robot, in all of its worlds
  std::string csv, svg;
};

constexpr double kTube = 0.005;  // rad, m
/// s, between two samples of a curve.
constexpr std::array kSteps{0.001, 0.004, 0.01, 0.1};
/// Each time is the least of so many.
constexpr int kTurns = 3;

/// Times and verdicts of many curves.
struct Costs {
  double nanoseconds = 0.0;  ///< of those that count
  int curves = 0;
  int free = 0, collision = 0, undecided = 0;
  std::int64_t looks = 0;  ///< at exact geometry

  void add(double own, const Effort& effort) {
    nanoseconds += own;
    ++curves;
    looks += effort.intervals;
  }
  void count(Verdict verdict) {
    free += verdict == Verdict::Free ? 1 : 0;
    collision += verdict == Verdict::Collision ? 1 : 0;
    undecided += verdict == Verdict::Undecided ? 1 : 0;
  }
  double mean() const { return nanoseconds / std::max(1, curves); }
};

/// What samples of the colliding curves say.
struct SampleCosts {
  double nanoseconds = 0.0;
  int curves = 0;
  int missed = 0;  ///< said to be free
};

class RobotCurves {
 public:
  RobotCurves(const RobotCase& which, const Options& options, const BenchClock& clock)
      : clock_(clock), robot_(loadRobot(which)) {
    const auto worlds = loadWorlds(which);
    const int each = std::max(1, options.curves / static_cast<int>(worlds.size()));
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      const auto checker = std::make_shared<const Checker>(robot_, which.group, worlds[i]);
      const Checker inTube = checker->withTracking({{.rotation = kTube, .translation = kTube}, {}});
      WanderingTrajectories trajectories(checker, options.seed + i);
      Workspace workspace(*checker);
      Workspace tubeWorkspace(inTube);
      for (int k = 0; k < each; ++k)
        measure(*checker, inTube, trajectories.draw(), workspace, tubeWorkspace);
    }
  }

  Costs curve, polyline, tube;
  std::array<SampleCosts, kSteps.size()> samples{};
  double certifyCollisions = 0.0;  ///< ns, of all curves that the samples are of

 private:
  template <typename Work>
  double least(const Work& work) const {
    double best = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < kTurns; ++turn) best = std::min(best, clock_.time(work));
    return best;
  }

  void measure(const Checker& checker, const Checker& inTube, const JointTrajectory& trajectory,
               Workspace& workspace, Workspace& tubeWorkspace) {
    const PiecewisePolynomial all = controllerCurve(trajectory);
    const TrajectoryQuery query{.contact = MotionQuery::VerdictOnly};
    TrajectoryCertificate found;
    const double own = least([&] { found = checker.certifyTrajectory(all, workspace, query); });
    curve.count(found.verdict);
    if (found.verdict == Verdict::Collision) {
      certifyCollisions += own;
      sample(checker, all, workspace);
    }
    TrajectoryCertificate wide;
    const double wider = least([&] { wide = inTube.certifyTrajectory(all, tubeWorkspace, query); });
    tube.count(wide.verdict);
    if (found.verdict != Verdict::Free) return;
    Effort effort;
    Verdict verdict = Verdict::Free;
    const double straight = least([&] {
      effort = {};
      verdict = Verdict::Free;
      for (std::size_t i = 1; i < trajectory.points.size() && verdict == Verdict::Free; ++i) {
        const MotionCertificate part = checker.certifyMotion(trajectory.points[i - 1].positions,
                                                             trajectory.points[i].positions,
                                                             workspace, MotionQuery::VerdictOnly);
        verdict = part.verdict;
        effort.intervals += part.effort.intervals;
      }
    });
    if (verdict != Verdict::Free || wide.verdict != Verdict::Free) return;
    curve.add(own, found.effort);
    polyline.add(straight, effort);
    tube.add(wider, wide.effort);
  }

  void sample(const Checker& checker, const PiecewisePolynomial& all, Workspace& workspace) {
    std::vector<double> q(static_cast<std::size_t>(checker.dimension()));
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      const int steps = std::max(1, static_cast<int>(std::ceil(all.duration() / kSteps[i] - 1e-9)));
      bool hit = false;
      const double own = least([&] {
        hit = false;
        for (int k = 0; k <= steps && !hit; ++k) {
          all.position(all.begin() + all.duration() * k / steps, q);
          hit = checker.checkState(q, workspace) == Verdict::Collision;
        }
      });
      samples[i].nanoseconds += own;
      ++samples[i].curves;
      samples[i].missed += hit ? 0 : 1;
    }
  }

  const BenchClock& clock_;
  std::shared_ptr<const Robot> robot_;
};

std::string percent(int part, int all) {
  return number(100.0 * part / std::max(1, all)) + " %";
}

class CurveBenchmark {
 public:
  explicit CurveBenchmark(const Options& options) : options_(options) {}

  void run() {
    std::printf(
        "Trajectories of 20 cubic pieces over 2 s from random free states, %d for each robot (seed "
        "%llu). Times are means over those that are free as curves, as polylines and in a tube of "
        "%g rad per joint.\n\n",
        options_.curves, static_cast<unsigned long long>(options_.seed), kTube);
    const MarkdownTable table({"robot", "free", "collision", "undecided", "curve us", "polyline us",
                               "curve / polyline", "in the tube: free", "undecided", "us",
                               "tube / polyline", "exact looks, tube"});
    const auto data = dataFolder();
    for (const RobotCase& which : robotCases(data.value_or(""))) {
      if (which.needsData && !data) {
        std::vector<std::string> skipped(12, "skipped");
        skipped.front() = which.name;
        table.row(skipped);
        continue;
      }
      const RobotCurves found(which, options_, clock_);
      const int all = found.curve.free + found.curve.collision + found.curve.undecided;
      const double straight = found.polyline.mean();
      table.row({which.name, percent(found.curve.free, all), percent(found.curve.collision, all),
                 percent(found.curve.undecided, all), number(1e-3 * found.curve.mean()),
                 number(1e-3 * straight), number(found.curve.mean() / straight),
                 percent(found.tube.free, all), percent(found.tube.undecided, all),
                 number(1e-3 * found.tube.mean()), number(found.tube.mean() / straight),
                 number(static_cast<double>(found.tube.looks) / std::max(1, found.tube.curves))});
      keepSamples(which.name, found);
    }
    printSamples();
    if (!options_.csv.empty()) writeCsv();
    if (!options_.svg.empty()) writeSvg();
  }

 private:
  struct SampleRow {
    std::string robot;
    std::string way;
    double missed = 0.0;  ///< share of the colliding curves
    double nanoseconds = 0.0;
    int curves = 0;
  };

  void keepSamples(const std::string& robot, const RobotCurves& found) {
    const int all = found.samples.front().curves;
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      const SampleCosts& own = found.samples[i];
      rows_.push_back({robot, "every " + number(1e3 * kSteps[i]) + " ms",
                       static_cast<double>(own.missed) / std::max(1, all),
                       own.nanoseconds / std::max(1, all), all});
    }
    rows_.push_back({robot, "certified", 0.0, found.certifyCollisions / std::max(1, all), all});
  }

  void printSamples() const {
    std::printf(
        "\nCurves in collision: what samples of their states miss, with the state check of the "
        "same library\n\n");
    const MarkdownTable table({"robot", "curves", "states", "missed", "us"});
    for (const SampleRow& row : rows_)
      table.row({row.robot, std::to_string(row.curves), row.way, number(100.0 * row.missed) + " %",
                 number(1e-3 * row.nanoseconds)});
  }

  void writeCsv() const {
    std::ofstream stream(options_.csv);
    stream << "robot,curves,states,missed_share,mean_us\n";
    for (const SampleRow& row : rows_)
      stream << '"' << row.robot << "\"," << row.curves << ',' << row.way << ','
             << number(row.missed, 6) << ',' << number(1e-3 * row.nanoseconds, 6) << '\n';
    if (!stream) throw std::runtime_error(options_.csv + ": cannot be written");
  }

  /// A line for the samples of each robot, and a point for the certificate.
  void writeSvg() const {
    Plot plot{.title = "Colliding curves that samples miss",
              .yLabel = "missed, share of colliding curves",
              .unit = Plot::Unit::Share,
              .series = {}};
    int style = 0;
    for (const SampleRow& row : rows_) {
      if (row.robot != "Panda" && row.robot != "rook7") continue;
      if (plot.series.empty() || plot.series.back().name != row.robot)
        plot.series.push_back({.name = row.robot, .style = style++, .points = {}});
      plot.series.back().points.push_back(
          {row.nanoseconds, row.missed, row.way, row.robot + ", " + row.way});
    }
    std::ofstream stream(options_.svg);
    stream << svgText(plot);
    if (!stream) throw std::runtime_error(options_.svg + ": cannot be written");
  }

  const Options options_;
  BenchClock clock_;
  std::vector<SampleRow> rows_;
};

std::optional<Options> optionsOf(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (i + 1 == argc) return std::nullopt;
    const std::string value = argv[i + 1];
    char* end = nullptr;
    if (name == "--seed")
      options.seed = std::strtoull(value.c_str(), &end, 10);
    else if (name == "--curves")
      options.curves = static_cast<int>(std::strtol(value.c_str(), &end, 10));
    else if (name == "--csv")
      options.csv = value;
    else if (name == "--svg")
      options.svg = value;
    else
      return std::nullopt;
    if (end != nullptr && *end != '\0') return std::nullopt;
  }
  if (options.curves < 1) return std::nullopt;
  return options;
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  return swept::benchmark::exitCodeOf(
      swept::benchmark::optionsOf(argc, argv),
      "curve_benchmark [--seed N] [--curves N] [--csv FILE] [--svg FILE]", [](const auto& options) {
        swept::benchmark::CurveBenchmark(options).run();
        return true;
      });
}
