// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fcl_peer.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"
#include "timing.hpp"

/// Motions of a shape past another one that stands still, what is true of them, and methods that
/// are asked for the first contact.
namespace swept::benchmark {

/// Paths that FCL has motions for.
enum class PathKind { Translation, Linear, Screw };

/// The first contact is after `from` and not after `toc`.
struct Truth {
  bool hit = false;
  double from = 0.0;
  double toc = 1.0;
};

struct Sweep {
  PathKind kind = PathKind::Translation;
  std::shared_ptr<const Motion> motion;
  std::shared_ptr<const Motion> still;
  Truth truth;
  double speed = 0.0;                       ///< m per unit of t, of the fastest point
  std::vector<Eigen::Isometry3d> instants;  ///< for discrete checks; may be empty
#ifdef SWEPT_HAS_FCL
  fcl::MotionBasePtr<double> fclMotion, fclStill;
#endif
};

/// m per unit of t. Chords of a 64th of the motion fall short of the path by less than 1 % as long
/// as it turns by less than a few rad.
inline double fastestPoint(const Motion& motion, std::span<const Eigen::Vector3d> points) {
  constexpr int kParts = 64;
  double most = 0.0;
  Eigen::Isometry3d before = motion.at(0.0);
  for (int i = 1; i <= kParts; ++i) {
    const Eigen::Isometry3d after = motion.at(static_cast<double>(i) / kParts);
    const Eigen::Matrix<double, 3, 4> step = (after.matrix() - before.matrix()).topRows<3>();
    for (const Eigen::Vector3d& point : points)
      most = std::max(most, (step * point.homogeneous()).squaredNorm());
    before = after;
  }
  return kParts * std::sqrt(most);
}

struct Answer {
  bool decided = true;
  bool hit = false;
  double freeUntil = 0.0;
  double toc = 1.0;
};

inline Answer ask(const Shape& still, const Shape& moving, const Sweep& sweep, double tolerance,
                  ContinuousWorkspace& workspace, const Motion& motion) {
  ContinuousOptions options;
  options.tolerance = tolerance;
  const ContinuousResult result =
      continuousCollide(still, *sweep.still, moving, motion, options, workspace);
  return {result.verdict != Verdict::Undecided, result.verdict == Verdict::Collision,
          result.freeUntil, result.contactBy};
}

/// m, at a t of a sweep, from elsewhere.
using DistanceAt = std::function<double(const Sweep&, double)>;

/// How often a method was right.
struct Score {
  int sweeps = 0;
  int missed = 0;     ///< contacts said to be free
  int falseHits = 0;  ///< free motions said to hit
  int undecided = 0;
  int late = 0;     ///< first contacts later than the truth by more than the tolerance
  int unsound = 0;  ///< called free beyond the first contact, or hit before it

  int right() const { return sweeps - missed - falseHits - undecided; }
  int wrong() const { return missed + falseHits + undecided + unsound; }
  /// `slack`: m, how far off the truth may be. `distanceAt`, if given, tells of a contact earlier
  /// than the truth's whether it is one: the truth may have stepped over a shallow graze.
  void add(const Sweep& sweep, const Answer& answer, double tolerance, double slack,
           const DistanceAt& distanceAt = {}) {
    ++sweeps;
    const Truth& truth = sweep.truth;
    if (!answer.decided) {
      ++undecided;
    } else if (truth.hit != answer.hit) {
      ++(truth.hit ? missed : falseHits);
    } else if (truth.hit) {
      const bool early = (truth.from - answer.toc) * sweep.speed > slack &&
                         !(distanceAt && distanceAt(sweep, answer.toc) <= slack);
      late += (answer.toc - truth.toc) * sweep.speed > tolerance + slack;
      unsound += early || (answer.freeUntil - truth.toc) * sweep.speed > slack;
    }
  }
  Score& operator+=(const Score& other) {
    sweeps += other.sweeps;
    missed += other.missed;
    falseHits += other.falseHits;
    undecided += other.undecided;
    late += other.late;
    unsound += other.unsound;
    return *this;
  }
};

/// One way to find the first contact of a sweep.
struct Method {
  std::string name;  ///< the same for two variants of which the faster counts
  std::function<Answer(const Sweep&)> ask;
  bool slow = false;  ///< measured once
};

struct Result {
  std::string name;
  double seconds = 0.0;  ///< for all the sweeps
  std::vector<Answer> answers;
};

/// Each name's faster variant, in the order of the methods.
inline std::vector<Result> compete(const std::vector<Method>& methods,
                                   std::span<const Sweep> sweeps, int turns) {
  std::vector<std::vector<Answer>> answers(methods.size(), std::vector<Answer>(sweeps.size()));
  std::vector<Contestant> fast, slow;
  std::vector<std::size_t> order;
  for (const bool isSlow : {false, true}) {
    for (std::size_t i = 0; i < methods.size(); ++i) {
      if (methods[i].slow != isSlow) continue;
      order.push_back(i);
      (isSlow ? slow : fast).push_back({methods[i].name, [&, i] {
                                          for (std::size_t k = 0; k < sweeps.size(); ++k)
                                            answers[i][k] = methods[i].ask(sweeps[k]);
                                        }});
    }
  }
  takeTurns(fast, turns);
  for (Contestant& contestant : slow) {
    const double start = cpuSeconds();
    contestant.run();
    contestant.seconds = cpuSeconds() - start;
  }
  fast.insert(fast.end(), slow.begin(), slow.end());
  std::vector<Result> results;
  for (std::size_t k = 0; k < fast.size(); ++k) {
    const auto same = [&](const Result& result) { return result.name == fast[k].name; };
    const auto found = std::find_if(results.begin(), results.end(), same);
    const Result mine{fast[k].name, fast[k].seconds, answers[order[k]]};
    if (found == results.end())
      results.push_back(mine);
    else if (mine.seconds < found->seconds)
      *found = mine;
  }
  return results;
}

}  // namespace swept::benchmark
