// SPDX-License-Identifier: BSD-3-Clause
// Boxes that move: the time to follow them and to visit all pairs that overlap, one
// step at a time.
// Arguments: N stops at N boxes; then, "coherent", "teleporting" or "robots" for these alone, and
// after it a share that moves, in %.
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "broadphase_bullet.hpp"
#include "broadphase_fcl.hpp"
#include "broadphase_robots.hpp"
#include "broadphase_worlds.hpp"
#include "number_argument.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

/// A library that took so many times as long as the best with a tenth of the boxes, or so long to
/// register them (s), is left out.
constexpr double kHopeless = 50.0, kPatience = 0.05;
/// s. Of one library in one round; steps not done by then are left out.
constexpr double kEnough = 4.0, kEnoughWarmUp = 10.0;
/// s. For robots that fold, of one library in a process of its own.
constexpr unsigned kFoldingPatience = 20;
/// Steps before the measured ones: from standing still to what goes on.
constexpr int kWarmUp = 10;

/// s, of asking for the time, which is a good part of the shortest steps.
double clockSeconds() {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 1000; ++i) {
    const double before = cpuSeconds();
    least = std::min(least, cpuSeconds() - before);
  }
  return least;
}

class SweptBroadphase : public BroadphasePeer {
 public:
  explicit SweptBroadphase(const BoxWorld& boxes) { manager_.registerBoxes(boxes.boxes()); }

  void prepare(const BoxWorld& boxes) override {
    moved_.clear();
    for (const std::uint32_t i : boxes.moving()) moved_.push_back(boxes.boxes()[i]);
  }
  std::size_t step(const BoxWorld& boxes) override {
    if (boxes.moving().size() == boxes.boxes().size())
      manager_.updateAll(boxes.boxes());
    else
      manager_.update(boxes.moving(), moved_);
    std::size_t pairs = 0;
    manager_.collide([&](BoxHandle, BoxHandle) {
      ++pairs;
      return false;
    });
    return pairs;
  }

 private:
  SweepAndPrune manager_;
  std::vector<Aabb> moved_;
};

struct Library {
  std::string name;
  std::unique_ptr<BroadphasePeer> (*make)(const BoxWorld&);
};

template <typename Peer>
std::unique_ptr<BroadphasePeer> make(const BoxWorld& boxes) {
  return std::make_unique<Peer>(boxes);
}

std::vector<Library> libraries() {
  std::vector<Library> all{{"swept", make<SweptBroadphase>}};
#ifdef SWEPT_HAS_FCL
  all.push_back({"FCL SaP", make<FclSweepAndPrune>});
  all.push_back({"FCL tree", make<FclDynamicTree>});
#else
  std::printf("FCL is not there.\n");
#endif
#ifdef SWEPT_HAS_BULLET
  all.push_back({"Bullet dbvt", bulletTrees});
  all.push_back({"Bullet axis sweep", bulletAxisSweep});
#else
  std::printf("Bullet is not there.\n");
#endif
  return all;
}

struct Setting {
  std::size_t count;
  double movingShare;
  BoxMotion motion;

  std::unique_ptr<BoxWorld> world() const {
    if (motion == BoxMotion::Folding) return std::make_unique<FoldingRobots>(count, 7);
    return std::make_unique<MovingBoxes>(count, movingShare, motion, 7);
  }
  int steps() const { return count <= 1000 ? 200 : count <= 10000 ? 80 : 40; }
  int rounds() const { return count <= 10000 ? 3 : 2; }
};

/// What one library did in all rounds: the least time of each step, and its pairs.
struct Run {
  std::vector<double> seconds;
  std::vector<std::size_t> pairs;
  double registering = 0.0;  ///< s

  void add(std::size_t step, double time, std::size_t found) {
    if (step == seconds.size()) {
      seconds.push_back(time);
      pairs.push_back(found);
    }
    seconds[step] = std::min(seconds[step], time);
    if (pairs[step] != found) pairs[step] = 0;  // does not agree with itself
  }
  double mean() const {
    double sum = 0.0;
    for (const double s : seconds) sum += s;
    return seconds.empty() ? std::numeric_limits<double>::infinity()
                           : sum / static_cast<double>(seconds.size());
  }
};

void oneRound(const Setting& setting, const Library& library, Run& run) {
  const std::unique_ptr<BoxWorld> world = setting.world();
  BoxWorld& boxes = *world;
  const double clock = clockSeconds();
  double start = cpuSeconds();
  const std::unique_ptr<BroadphasePeer> peer = library.make(boxes);
  run.registering = cpuSeconds() - start;
  for (int i = -kWarmUp; i < setting.steps(); ++i) {
    boxes.step();
    if (i < 0 && cpuSeconds() - start > kEnoughWarmUp) continue;
    peer->prepare(boxes);
    const double before = cpuSeconds();
    const std::size_t pairs = peer->step(boxes);
    const double seconds = cpuSeconds() - before - clock;
    if (i < 0) continue;
    if (i == 0) start = before;
    run.add(static_cast<std::size_t>(i), seconds, pairs);
    if (cpuSeconds() - start > kEnough) break;
  }
}

class Table {
 public:
  explicit Table(BoxMotion motion) : motion_(motion) {}

  void measure(std::size_t most, const std::vector<double>& shares) {
    std::vector<std::string> head{"boxes", "moving", "pairs"};
    for (const Library& library : libraries_) head.push_back(library.name);
    head.push_back("swept / best");
    const MarkdownTable table(head);
    for (const double share : shares) {
      std::vector<bool> hopeless(libraries_.size(), false);
      for (std::size_t count = 1000; count <= most; count *= 10)
        table.row(row({count, share, motion_}, hopeless));
    }
  }
  void printGrowth(std::size_t most) const {
    std::vector<std::string> head{"moving"};
    for (std::size_t count = 1000; count <= most; count *= 10)
      head.push_back(std::to_string(count) + " boxes, ns per box");
    head.push_back("exponent");
    std::printf("\n");
    const MarkdownTable table(head);
    const std::size_t sizes = head.size() - 2;
    for (std::size_t first = 0; first + sizes <= ours_.size(); first += sizes) {
      std::vector<std::string> cells{number(100.0 * ours_[first].setting.movingShare) + " %"};
      for (std::size_t i = first; i < first + sizes; ++i)
        cells.push_back(
            number(1e9 * ours_[i].seconds / static_cast<double>(ours_[i].setting.count)));
      cells.push_back(number(exponent(first, first + sizes - 1), 3));
      table.row(cells);
    }
  }
  bool agree() const { return agree_; }

 private:
  struct Point {
    Setting setting;
    double seconds;
  };

  /// `hopeless`: which libraries are left out; more for the next size.
  std::vector<std::string> row(const Setting& setting, std::vector<bool>& hopeless) {
    std::vector<Run> runs(libraries_.size());
    std::vector<std::string> mishaps(libraries_.size());
    for (std::size_t i = 0; setting.motion == BoxMotion::Folding && i < runs.size(); ++i) {
      if (hopeless[i]) continue;
      mishaps[i] = mishapOf([&] { oneRound(setting, libraries_[i], runs[i]); }, kFoldingPatience);
      hopeless[i] = !mishaps[i].empty();
    }
    for (int round = 0; round < setting.rounds(); ++round) {
      for (std::size_t i = 0; i < libraries_.size(); ++i) {
        // A step that takes longer than a round is measured once.
        const bool again = runs[i].seconds.empty() || runs[i].mean() < kEnough;
        if (!hopeless[i] && again) oneRound(setting, libraries_[i], runs[i]);
      }
    }
    const Run& ours = runs.front();
    if (ours.pairs.empty()) throw std::runtime_error("swept: " + mishaps.front());
    ours_.push_back({setting, ours.mean()});
    std::vector<std::string> cells{std::to_string(setting.count),
                                   number(100.0 * setting.movingShare) + " %",
                                   std::to_string(ours.pairs.back())};
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (runs[i].seconds.empty())
        cells.push_back(mishaps[i].empty() ? "-" : mishaps[i]);
      else
        cells.push_back(number(1e6 * runs[i].mean()));
      if (i > 0) best = std::min(best, runs[i].mean());
      check(setting, libraries_[i].name, ours, runs[i]);
    }
    cells.push_back(runs.size() > 1 ? number(ours.mean() / best, 2) : "-");
    for (std::size_t i = 1; i < runs.size(); ++i) {
      hopeless[i] =
          hopeless[i] || runs[i].mean() > kHopeless * best || runs[i].registering > kPatience;
    }
    return cells;
  }

  void check(const Setting& setting, const std::string& name, const Run& ours, const Run& theirs) {
    for (std::size_t i = 0; i < theirs.pairs.size(); ++i) {
      if (theirs.pairs[i] == ours.pairs[i]) continue;
      std::fprintf(stderr, "%zu boxes, step %zu: %zu pairs, %s %zu\n", setting.count, i,
                   ours.pairs[i], name.c_str(), theirs.pairs[i]);
      agree_ = false;
      return;
    }
  }

  double exponent(std::size_t first, std::size_t last) const {
    return std::log(ours_[last].seconds / ours_[first].seconds) /
           std::log(static_cast<double>(ours_[last].setting.count) /
                    static_cast<double>(ours_[first].setting.count));
  }

  BoxMotion motion_;
  std::vector<Library> libraries_ = libraries();
  std::vector<Point> ours_;
  bool agree_ = true;
};

/// `only`: empty, or the one to be measured. Whether all libraries agree.
bool measure(const std::string& only, const std::string& name, const char* title, BoxMotion motion,
             std::size_t most, const std::vector<double>& shares) {
  if (!only.empty() && only != name) return true;
  std::printf("\n%s: us per step\n\n", title);
  Table table(motion);
  table.measure(most, shares);
  table.printGrowth(most);
  return table.agree();
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  using swept::benchmark::BoxMotion;
  using swept::benchmark::countOf;
  using swept::benchmark::measure;
  using swept::benchmark::positiveNumber;
  const auto most = argc > 1 ? countOf(argv[1], 10'000'000) : 100'000;
  const std::string only = argc > 2 ? argv[2] : "";
  const bool known =
      only.empty() || only == "coherent" || only == "teleporting" || only == "robots";
  const auto share = argc > 3 ? positiveNumber(argv[3]) : std::nullopt;
  if (!most || *most < 1000 || !known || argc > 4 || (argc > 3 && !(share && *share <= 100.0))) {
    std::fputs(
        "usage: broadphase_benchmark [N [coherent|teleporting|robots [%]]], N from 1000 to 1e7\n",
        stderr);
    return 2;
  }
  std::vector<double> shares{0.01, 0.1, 1.0};
  if (share) shares = {0.01 * *share};
  try {
    bool agree = measure(only, "coherent", "Coherent, up to 10 mm along each axis",
                         BoxMotion::Coherent, *most, shares);
    agree &= measure(only, "teleporting", "Teleporting", BoxMotion::Teleporting, *most, shares);
    agree &= measure(only, "robots", "Robots that fold", BoxMotion::Folding, *most, {0.5});
    return agree ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "broadphase_benchmark: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
