// SPDX-License-Identifier: BSD-3-Clause
// Deforming meshes: refit, discrete and continuous collision of a scene with itself and of its
// objects with one another, per frame, after Table IV of Pan, Chitta, Manocha 2012. Arguments: a
// scene (balls, shatter, large; all without), and of how many frames one is measured. Or `sizes`:
// one step of the bursting block in five sizes, its refit on two threads, and the memory of the
// mesh.
#include <chrono>
#include <cstdlib>
#include <optional>
#include <string>

#include "deform_fcl.hpp"
#include "deform_judge.hpp"
#include "deform_scenes.hpp"
#include "number_argument.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

constexpr int kRefit = 0, kSelf = 1, kSelfContinuous = 2, kRefitObjects = 3, kPairs = 4,
              kPairsContinuous = 5, kQueries = 6;
constexpr const char* kNames[kQueries] = {
    "refit",           "discrete, itself", "continuous, itself", "refit of the objects",
    "discrete, pairs", "continuous, pairs"};

/// Means over frames, ms; and what was found, to compare.
struct Costs {
  double ms[kQueries] = {};
  double found[kQueries] = {};
};

class Stopwatch {
 public:
  explicit Stopwatch(Costs& costs) : costs_(costs) {}
  /// The least of two turns. `run` returns the number of pairs it found.
  template <typename Run>
  void measure(int query, const Run& run) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t found = 0;
    for (int turn = 0; turn < 2; ++turn) {
      const double start = cpuSeconds();
      found = run();
      least = std::min(least, cpuSeconds() - start);
    }
    costs_.ms[query] += 1e3 * least;
    costs_.found[query] += static_cast<double>(found);
  }

 private:
  Costs& costs_;
};

/// Pairs of objects whose boxes overlap during the step: the broad phase is the same for all.
std::vector<std::pair<std::size_t, std::size_t>> objectPairs(const std::vector<Points>& from,
                                                             const std::vector<Points>& to) {
  std::vector<Eigen::AlignedBox3d> boxes(from.size());
  for (std::size_t o = 0; o < from.size(); ++o) {
    for (const auto* points : {&from[o], &to[o]})
      for (const Eigen::Vector3d& p : *points) boxes[o].extend(p);
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t o = 0; o < boxes.size(); ++o)
    for (std::size_t p = o + 1; p < boxes.size(); ++p)
      if (boxes[o].intersects(boxes[p])) pairs.emplace_back(o, p);
  return pairs;
}

/// What a step is measured on.
struct Step {
  Points allFrom, allTo;
  std::vector<Points> from, to;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;

  Step(const DeformScene& scene, int frame)
      : allFrom(scene.allAt(frame)), allTo(scene.allAt(frame + 1)) {
    for (std::size_t o = 0; o < scene.objects().size(); ++o) {
      from.push_back(scene.at(o, frame));
      to.push_back(scene.at(o, frame + 1));
    }
    pairs = objectPairs(from, to);
  }
};

class Ours {
 public:
  explicit Ours(const DeformScene& scene)
      : all_(DeformingMesh::build(scene.allAt(0), scene.allTriangles())) {
    for (std::size_t o = 0; o < scene.objects().size(); ++o)
      objects_.push_back(DeformingMesh::build(scene.at(o, 0), scene.objects()[o]));
  }

  void measure(const Step& step, Costs& costs) {
    Stopwatch watch(costs);
    // Both turns end where the step begins.
    watch.measure(kRefit, [&] { return all_.moveTo(step.allFrom), 0; });
    watch.measure(kSelf, [&] {
      selfCollide(all_, {kAll}, touching_, workspace_);
      return touching_.pairs.size();
    });
    watch.measure(kRefitObjects, [&] {
      for (std::size_t o = 0; o < objects_.size(); ++o) objects_[o].moveTo(step.from[o]);
      return 0;
    });
    watch.measure(kPairs, [&] {
      std::size_t found = 0;
      for (const auto& [o, p] : step.pairs) {
        collide(objects_[o], objects_[p], {kAll}, touching_, workspace_);
        found += touching_.pairs.size();
      }
      return found;
    });
    all_.moveTo(step.allTo);
    for (std::size_t o = 0; o < objects_.size(); ++o) objects_[o].moveTo(step.to[o]);
    watch.measure(kSelfContinuous, [&] {
      selfCollideContinuous(all_, {}, impacts_, workspace_);
      return impacts_.impacts.size();
    });
    watch.measure(kPairsContinuous, [&] {
      std::size_t found = 0;
      for (const auto& [o, p] : step.pairs) {
        collideContinuous(objects_[o], objects_[p], {}, impacts_, workspace_);
        found += impacts_.impacts.size();
      }
      return found;
    });
  }
  std::size_t rebuilds() const { return all_.rebuilds(); }

 private:
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  DeformingMesh all_;
  std::vector<DeformingMesh> objects_;
  DeformingWorkspace workspace_;
  MeshCollisionResult touching_;
  DeformingResult impacts_;
};

#ifdef SWEPT_HAS_FCL
template <typename Volume>
class Fcls {
 public:
  explicit Fcls(const DeformScene& scene) : all_({scene.allAt(0), scene.allTriangles()}) {
    for (std::size_t o = 0; o < scene.objects().size(); ++o)
      objects_.emplace_back(Soup{scene.at(o, 0), scene.objects()[o]});
  }

  void measure(const Step& step, Costs& costs) {
    Stopwatch watch(costs);
    watch.measure(kRefit, [&] { return all_.place(step.allFrom), 0; });
    watch.measure(kSelf, [&] { return all_.touching(all_).size(); });
    watch.measure(kRefitObjects, [&] {
      for (std::size_t o = 0; o < objects_.size(); ++o) objects_[o].place(step.from[o]);
      return 0;
    });
    watch.measure(kPairs, [&] {
      std::size_t found = 0;
      for (const auto& [o, p] : step.pairs) found += objects_[o].touching(objects_[p]).size();
      return found;
    });
    for (const bool last : {false, true}) {
      all_.moveTo(last ? step.allTo : step.allFrom);
      for (std::size_t o = 0; o < objects_.size(); ++o)
        objects_[o].moveTo(last ? step.to[o] : step.from[o]);
    }
    watch.measure(kSelfContinuous, [&] { return all_.meeting(all_).size(); });
    watch.measure(kPairsContinuous, [&] {
      std::size_t found = 0;
      for (const auto& [o, p] : step.pairs) found += objects_[o].meeting(objects_[p]).size();
      return found;
    });
  }

 private:
  FclDeforming<Volume> all_;
  std::vector<FclDeforming<Volume>> objects_;
};
#endif

/// Whether nothing was missed.
bool report(const std::string& name, const DeformScene& scene, int stride, bool judged) {
  Ours ours(scene);
  Costs our;
#ifdef SWEPT_HAS_FCL
  Fcls<fcl::AABBd> fclAabb(scene);
  Fcls<fcl::KDOP<double, 16>> fclKdop(scene);
  Costs aabb, kdop;
#endif
  int steps = 0;
  for (int frame = stride / 2; frame + 1 < scene.frames(); frame += stride, ++steps) {
    const Step step(scene, frame);
    ours.measure(step, our);
#ifdef SWEPT_HAS_FCL
    fclAabb.measure(step, aabb);
    fclKdop.measure(step, kdop);
#endif
  }
  const std::size_t triangles = scene.allTriangles().size();
  std::printf(
      "\n%s: %zu objects, %zu triangles, %d of %d steps, ms per step; built anew %zu times\n\n",
      name.c_str(), scene.objects().size(), triangles, steps, scene.frames() - 1, ours.rebuilds());
  const MarkdownTable table({"query", "swept", "FCL AABB", "FCL k-DOP16", "swept / best",
                             "pairs: swept", "pairs: FCL AABB"});
  bool good = true;
  for (int q = 0; q < kQueries; ++q) {
    std::vector<std::string> cells{kNames[q], number(our.ms[q] / steps),       "-", "-",
                                   "-",       number(our.found[q] / steps, 6), "-"};
#ifdef SWEPT_HAS_FCL
    cells[2] = number(aabb.ms[q] / steps);
    cells[3] = number(kdop.ms[q] / steps);
    cells[4] = number(our.ms[q] / std::min(aabb.ms[q], kdop.ms[q]), 2);
    cells[6] = number(aabb.found[q] / steps, 6);
    if ((q == kSelf || q == kPairs) && our.found[q] != aabb.found[q]) good = false;
#endif
    table.row(cells);
  }
  if (judged) {
    for (const int frame : {scene.frames() / 3, 2 * scene.frames() / 3})
      good = judgeStep(scene, frame, 100) && good;
  }
  return good;
}

/// Bytes that `make` leaves on the heap in what it returns, per triangle.
template <typename Make>
double bytesEach(std::size_t triangles, const Make& make) {
  const double before = heapBytes();
  const auto made = make();
  return (heapBytes() - before) / static_cast<double>(triangles);
}

/// ms on the clock, the least of 20 turns, which go to and fro.
std::vector<double> refitTimes(const DeformScene& scene, const Step& step,
                               const std::vector<unsigned>& threads) {
  DeformingMesh mesh = DeformingMesh::build(step.allFrom, scene.allTriangles());
  std::vector<double> least(threads.size(), std::numeric_limits<double>::infinity());
  for (int turn = 0; turn < 20; ++turn) {
    for (std::size_t k = 0; k < threads.size(); ++k) {
      const auto start = std::chrono::steady_clock::now();
      mesh.moveTo(step.allTo, threads[k]);
      const std::chrono::duration<double, std::milli> took =
          std::chrono::steady_clock::now() - start;
      least[k] = std::min(least[k], took.count());
      mesh.moveTo(step.allFrom);
    }
  }
  return least;
}

void sizesRow(const DeformScene& scene, const MarkdownTable& table) {
  const std::size_t triangles = scene.allTriangles().size();
  const Points points = scene.allAt(0);
  const auto corners = scene.allTriangles();
  const Step step(scene, scene.frames() / 3);
  Costs our;
  Ours(scene).measure(step, our);
  const auto cells = [&](const std::string& name, const Costs& costs, double bytes,
                         const std::string& threads) {
    table.row({std::to_string(triangles), name, number(costs.ms[kRefit]), threads,
               number(costs.ms[kSelf]), number(costs.ms[kSelfContinuous]), number(bytes)});
  };
  const std::vector<double> refits = refitTimes(scene, step, {1, 2});
  const std::string threads = number(refits[0]) + ", " + number(refits[1]);
  cells("swept", our, bytesEach(triangles, [&] { return DeformingMesh::build(points, corners); }),
        threads);
#ifdef SWEPT_HAS_FCL
  Costs fcl;
  Fcls<fcl::AABBd>(scene).measure(step, fcl);
  cells("FCL AABB", fcl,
        bytesEach(triangles,
                  [&] {
                    return FclDeforming<fcl::AABBd>({points, corners});
                  }),
        "-");
#endif
}

void sizes() {
  constexpr int kDetail = 10;
  const MarkdownTable table({"triangles", "", "refit, ms", "on 1 and 2 threads, by the clock",
                             "discrete, itself, ms", "continuous, itself, ms",
                             "bytes per triangle"});
  for (const int side : {2, 4, 6, 8, 11}) sizesRow(ShatterScene(side, kDetail), table);
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  using namespace swept::benchmark;
  const std::string scene = argc > 1 ? argv[1] : "";
  const bool known = scene.empty() || scene == "balls" || scene == "shatter" || scene == "large" ||
                     (scene == "sizes" && argc == 2);
  // Of two frames the one in the middle is measured.
  const auto given = argc > 2 ? countOf(argv[2], 50) : std::nullopt;
  if (!known || argc > 3 || (argc > 2 && !given)) {
    std::fputs("usage: deform_benchmark [balls|shatter|large [N] | sizes], N from 1 to 50\n",
               stderr);
    return 2;
  }
  const auto chosen = [&](const char* name) { return scene.empty() || scene == name; };
  const auto stride = [&](int usual) { return given ? static_cast<int>(*given) : usual; };
  if (scene == "sizes") {
    sizes();
    return 0;
  }
  bool good = true;
  if (chosen("balls")) good = report("balls", BallsScene(), stride(10), true) && good;
  if (chosen("shatter")) good = report("shatter", ShatterScene(6, 9), stride(6), true) && good;
  if (chosen("large")) good = report("large", ShatterScene(11, 10), stride(15), false) && good;
  return good ? 0 : 1;
}
