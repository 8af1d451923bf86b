// SPDX-License-Identifier: BSD-3-Clause
// A roadmap of proven motions while its world changes, beside a recheck of all of its motions.
//   SWEPT_DATA=DATA roadmap_benchmark [panda] [ur5] [--set NAME] [--states N] [--turns N]
//   [--threads N]
#include <ompl/util/Console.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <optional>
#include <random>

#include "exit_code.hpp"
#include "number_argument.hpp"
#include "planning_problems.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

constexpr double kMilli = 1e3, kMicro = 1e6;

struct Options {
  std::string robot = "Panda";
  std::string set;  ///< empty: the first
  std::size_t states = 1700;
  std::size_t turns = 20;
  unsigned threads = 1;
};

/// s. Of one thread its own time, which other programs on the machine do not change.
double seconds(unsigned threads) {
  if (threads == 1) return cpuSeconds();
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Median and largest.
std::string spread(std::vector<double> values, double unit) {
  if (values.empty()) return "-";
  std::ranges::sort(values);
  return number(unit * values[(values.size() - 1) / 2]) + " / " + number(unit * values.back());
}

/// What changes of one kind took, beside a recheck of all motions.
class Changes {
 public:
  Changes(std::string name, unsigned threads) : name_(std::move(name)), threads_(threads) {}

  void take(const std::function<Checker()>& makeVersion, CertifiedRoadmap& roadmap) {
    const double begin = seconds(threads_);
    const auto changed = std::make_shared<const Checker>(makeVersion());
    const double made = seconds(threads_);
    const ProvenGraph::Change change = roadmap.update(changed, threads_);
    const double done = seconds(threads_);
    versions_.push_back(made - begin);
    updates_.push_back(done - made);
    both_.push_back(done - begin);
    asked_.push_back(static_cast<double>(change.motionsAsked));
    freed_ += change.freed;
    blocked_ += change.blocked;
    recheck(roadmap);
  }

  void print(const MarkdownTable& table) const {
    table.row({name_, std::to_string(updates_.size()), spread(versions_, kMilli),
               spread(updates_, kMilli), spread(both_, kMilli), spread(rechecks_, kMilli),
               spread(asked_, 1.0), std::to_string(blocked_), std::to_string(freed_),
               std::to_string(unsound_), std::to_string(lost_), std::to_string(more_)});
  }
  bool isRight() const { return unsound_ == 0 && lost_ == 0; }

 private:
  /// Every motion from nothing, which tells whether the roadmap is right.
  void recheck(const CertifiedRoadmap& roadmap) {
    const ProvenGraph& graph = roadmap.graph();
    std::vector<double> from, to;
    for (std::size_t i = 0; i < graph.motions(); ++i) {
      const ConfigurationView a = graph.state(graph.motion(i).from);
      const ConfigurationView b = graph.state(graph.motion(i).to);
      from.insert(from.end(), a.begin(), a.end());
      to.insert(to.end(), b.begin(), b.end());
    }
    std::vector<MotionCertificate> certificates(graph.motions());
    const double begin = seconds(threads_);
    if (threads_ == 1) {
      Workspace workspace(*graph.checker());
      for (std::size_t i = 0; i < graph.motions(); ++i)
        certificates[i] = graph.checker()->certifyMotion(graph.state(graph.motion(i).from),
                                                         graph.state(graph.motion(i).to), workspace,
                                                         MotionQuery::VerdictOnly);
    } else {
      graph.checker()->certifyMotions(from, to, certificates, MotionQuery::VerdictOnly, threads_);
    }
    rechecks_.push_back(seconds(threads_) - begin);
    for (std::size_t i = 0; i < graph.motions(); ++i) {
      const Verdict verdict = certificates[i].verdict;
      unsound_ += graph.isFree(i) && verdict == Verdict::Collision ? 1 : 0;
      more_ += graph.isFree(i) && verdict == Verdict::Undecided ? 1 : 0;
      lost_ += !graph.isFree(i) && verdict == Verdict::Free ? 1 : 0;
    }
  }

  std::string name_;
  unsigned threads_;
  std::vector<double> versions_, updates_, both_, rechecks_, asked_;
  std::size_t freed_ = 0, blocked_ = 0, unsound_ = 0, lost_ = 0, more_ = 0;
};

class RoadmapRun {
 public:
  RoadmapRun(const Options& options, const PlanningProblems& problems, const PlanningCase& problem)
      : options_(options), problem_(problem) {
    checker_ = std::make_shared<const Checker>(problems.robot(), problems.group(), problem.world);
    const double begin = seconds(options_.threads);
    roadmap_.emplace(checker_,
                     RoadmapOptions{.states = options.states, .threads = options.threads});
    const ProvenGraph& graph = roadmap_->graph();
    std::printf("%s %d, %zu bodies: %zu states, %zu motions, %zu free, %zu components, %.2f s\n\n",
                problem.set.c_str(), problem.index, problem.world->bodies().size(), graph.states(),
                graph.motions(), roadmap_->freeMotions(), roadmap_->components(),
                seconds(options_.threads) - begin);
  }

  bool changes() {
    std::printf(
        "ms: median / largest; motions that are free and must not be, that are lost, and "
        "that the recheck leaves undecided\n\n");
    const MarkdownTable table({"change", "times", "version", "update", "both", "recheck", "asked",
                               "blocked", "freed", "unsound", "lost", "more"});
    Changes moved("one box moved", options_.threads),
        cloud("new cloud of an object", options_.threads),
        seen("new cloud of all", options_.threads);
    const Shape box = makeBox(Eigen::Vector3d(0.1, 0.1, 0.2));
    roadmap_->update(
        std::make_shared<const Checker>(checkerNow().withBody("box", box, anywhere())));
    for (std::size_t turn = 0; turn < options_.turns; ++turn) {
      const Eigen::Isometry3d to = anywhere();
      moved.take([&] { return checkerNow().withReplaced("box", box, to); }, *roadmap_);
    }
    roadmap_->update(checker_);
    moved.print(table);
    const Checker empty = checkerNow().withBody("cloud", makeSphere(0.01), anywhere());
    roadmap_->update(std::make_shared<const Checker>(empty));
    for (std::size_t turn = 0; turn < options_.turns; ++turn) {
      const PointCloud points = cloudOf({box}, {anywhere()});
      cloud.take(
          [&] { return checkerNow().withReplaced("cloud", points, Eigen::Isometry3d::Identity()); },
          *roadmap_);
    }
    cloud.print(table);
    std::vector<Shape> shapes;
    std::vector<Eigen::Isometry3d> poses;
    for (const WorldBody& body : problem_.world->bodies())
      for (const WorldBody::Part& part : body.parts) {
        shapes.push_back(part.shape);
        poses.push_back(part.world_from_shape);
      }
    for (std::size_t turn = 0; turn < options_.turns; ++turn) {
      const PointCloud points = cloudOf(shapes, poses);
      seen.take(
          [&] { return checkerNow().withReplaced("cloud", points, Eigen::Isometry3d::Identity()); },
          *roadmap_);
    }
    seen.print(table);
    roadmap_->update(checker_);
    return moved.isRight() && cloud.isRight() && seen.isRight();
  }

  /// Between free states at random.
  bool queries() {
    constexpr std::size_t kQueries = 1000;
    Workspace workspace(*checker_);
    std::vector<std::vector<double>> states;
    while (states.size() < 2 * kQueries) {
      std::vector<double> q;
      for (const int i : checker_->group().variables) {
        const Variable& variable = checker_->robot().variables()[static_cast<std::size_t>(i)];
        q.push_back(
            std::uniform_real_distribution<double>(variable.lower, variable.upper)(random_));
      }
      if (checker_->checkState(q, workspace) == Verdict::Free) states.push_back(std::move(q));
    }
    std::vector<double> all, around;  // of those whose start and goal no free motion joins
    std::size_t found = 0, segments = 0, unproven = 0;
    for (std::size_t i = 0; i < kQueries; ++i) {
      const double begin = seconds(options_.threads);
      const auto path = roadmap_->path(states[2 * i], states[2 * i + 1], workspace);
      all.push_back(seconds(options_.threads) - begin);
      if (!path || path->size() > 2) around.push_back(all.back());
      if (!path) continue;
      ++found;
      const PathCertificate certificate = certifyPath(*checker_, *path, {.clearances = false});
      segments += certificate.segments.size();
      unproven += certificate.segments.size() - certificate.count(Verdict::Free);
    }
    std::printf("\nus of queries: median / largest\n\n");
    const MarkdownTable table({"queries", "with a path", "all", "not joined directly", "these",
                               "motions", "not proven anew"});
    table.row({std::to_string(kQueries), std::to_string(found), spread(all, kMicro),
               std::to_string(around.size()), spread(around, kMicro), std::to_string(segments),
               std::to_string(unproven)});
    return unproven == 0;
  }

 private:
  const Checker& checkerNow() const { return *roadmap_->graph().checker(); }

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// Within what the robot reaches and the scene fills.
  Eigen::Isometry3d anywhere() {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(uniform(0.3, 0.9), uniform(-0.6, 0.6), uniform(0.1, 1.1));
    pose.linear() =
        Eigen::AngleAxisd(uniform(-3.0, 3.0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return pose;
  }

  /// Of 10^5 points on boxes' sides and other shapes' bounding boxes, with a radius of 1 mm.
  PointCloud cloudOf(const std::vector<Shape>& shapes,
                     const std::vector<Eigen::Isometry3d>& poses) {
    constexpr std::size_t kPoints = 100'000;
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < kPoints; ++i) {
      const std::size_t shape = i % shapes.size();
      const Aabb box = boundingBox(shapes[shape]);
      Eigen::Vector3d point;
      for (int k = 0; k < 3; ++k) point[k] = uniform(box.lower[k], box.upper[k]);
      const int side = static_cast<int>(random_() % 3);
      point[side] = random_() % 2 == 0 ? box.lower[side] : box.upper[side];
      points.push_back(poses[shape] * point);
    }
    return PointCloud::build(points, 0.001);
  }

  Options options_;
  const PlanningCase& problem_;
  std::mt19937 random_{1};
  std::shared_ptr<const Checker> checker_;
  std::optional<CertifiedRoadmap> roadmap_;
};

/// False where a motion is wrong.
bool run(const Options& options, const std::filesystem::path& data) {
  const PlanningProblems problems(data, options.robot, 1);
  for (const PlanningCase& problem : problems.cases()) {
    if (!options.set.empty() && problem.set != options.set) continue;
    RoadmapRun roadmap(options, problems, problem);
    const bool changesRight = roadmap.changes();
    return roadmap.queries() && changesRight;
  }
  throw std::runtime_error("there is no set '" + options.set + "'");
}

std::optional<Options> optionsOf(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "panda" || word == "ur5") {
      options.robot = word == "panda" ? "Panda" : "UR5";
      continue;
    }
    if (++i == argc) return std::nullopt;
    if (word == "--set") {
      options.set = argv[i];
      continue;
    }
    const std::optional<double> value = positiveNumber(argv[i]);
    if (!value || *value != std::floor(*value) || *value > 1e6) return std::nullopt;
    if (word == "--states")
      options.states = static_cast<std::size_t>(*value);
    else if (word == "--turns")
      options.turns = static_cast<std::size_t>(*value);
    else if (word == "--threads")
      options.threads = static_cast<unsigned>(*value);
    else
      return std::nullopt;
  }
  return options;
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  return swept::benchmark::exitCodeWithData(
      swept::benchmark::optionsOf(argc, argv),
      "roadmap_benchmark [panda] [ur5] [--set NAME] [--states N] [--turns N] [--threads N]",
      [](const auto& options, const auto& data) {
        ompl::msg::noOutputHandler();
        return swept::benchmark::run(options, data);
      });
}
