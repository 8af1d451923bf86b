// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "geometry/nearest_rotation.hpp"
#include "point_cloud/any_of.hpp"
#include "point_cloud/gaussian.hpp"
#include "point_cloud/group_samples.hpp"
#include "point_cloud/looks.hpp"
#include "point_cloud/near_pairs.hpp"
#include "point_cloud/noisy_cloud_data.hpp"
#include "point_cloud/pair_groups.hpp"
#include "point_cloud/probability_goal.hpp"
#include "point_cloud/quadratic_form.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kDraws = 64;  // of a group at a time

class CloudQuery {
 public:
  CloudQuery(const NoisyCloudData& a, const NoisyCloudData& b, const Isometry3d& a_from_b,
             const ProbabilityGoal& goal)
      : a_(a),
        b_(b),
        a_from_b_(a_from_b),
        goal_(goal),
        near_(a, b, a_from_b),
        usedA_(a.points.size()),
        usedB_(b.points.size()) {}

  CollisionProbability run() {
    isComplete_ = near_.visit([this](std::size_t i, std::size_t j) { return lookAtPair(i, j); });
    effort_.nodes = near_.boxPairs();
    effort_.near = static_cast<int>(pairs_.size());
    const PairGroups groups(pairs_, a_.points.size(), b_.points.size());
    ProbabilityRange all = boundGroups(groups);
    bool more = true;
    for (double accuracy = 0.1; more && !goal_.isReached(all); accuracy *= 0.3) {
      more = improvePairs(accuracy);
      all = boundGroups(groups);
    }
    CollisionProbability result;
    result.lower = all.lower;
    result.upper = all.upper;
    result.probability = all.estimate;
    if (!goal_.threshold && !goal_.isReached(all)) sample(groups, result);
    result.effort = effort_;
    return result;
  }

 private:
  /// The integral of a pair whose noise has no closed form.
  struct Open {
    std::size_t pair;
    EventIntegral integral;
  };

  /// False once the goal is reached, or the effort is spent.
  bool lookAtPair(std::size_t i, std::size_t j) {
    ++effort_.looks;
    NoisyPair pair{i, j, {}};
    if (a_.spreads[i] == 0.0 && b_.spreads[j] == 0.0) {
      pair.range = withoutNoise(i, j);
    } else if (isIsotropic(a_.factor(i)) && isIsotropic(b_.factor(j))) {
      pair.range = isotropic(i, j);
    } else {
      pair.range = anisotropic(i, j);
    }
    pairs_.push_back(pair);
    match(pair);
    return !goal_.isReached({matched_.probability(), 1.0, 1.0}) &&
           effort_.looks < goal_.options.maxLooks;
  }

  /// Pairs without a common point are enough if many pairs are likely.
  void match(const NoisyPair& pair) {
    if (usedA_[pair.a] || usedB_[pair.b]) return;
    constexpr double kOfUse = 1e-3;  // less likely pairs would only block others
    if (pair.range.lower < kOfUse) return;
    usedA_[pair.a] = usedB_[pair.b] = true;
    matched_.add(pair.range.lower);
  }

  ProbabilityRange withoutNoise(std::size_t i, std::size_t j) const {
    Isometry3d one_from_other = a_from_b_;
    one_from_other.translation() = a_from_b_ * b_.points[j] - a_.points[i];
    switch (collide(Sphere{a_.radii[i]}, Sphere{b_.radii[j]}, one_from_other)) {
      case Contact::Touching:
        return {1.0, 1.0, 1.0};
      case Contact::Separate:
        return {0.0, 0.0, 0.0};
      case Contact::Unknown:
        break;
    }
    return {};
  }

  Vector3d meanOf(std::size_t i, std::size_t j) const {
    return a_.points[i] - a_from_b_ * b_.points[j];
  }
  double roundingOf(std::size_t i, std::size_t j) const {
    const double size = a_.points[i].norm() + b_.points[j].norm() + a_from_b_.translation().norm() +
                        a_.radii[i] + b_.radii[j] +
                        kFarthestLook * std::hypot(a_.spreads[i], b_.spreads[j]);
    return 4.0 * tolerance::kSupportRounding * size + kPositionUnderflow;
  }

  /// By the closed form. Rounding of positions changes it by at most the density of the distance,
  /// which is at most that of a normal distribution, at either end.
  ProbabilityRange isotropic(std::size_t i, std::size_t j) const {
    const double s = std::hypot(a_.factor(i)(0, 0), b_.factor(j)(0, 0));
    const double p = ballProbability(meanOf(i, j).norm(), a_.radii[i] + b_.radii[j], s);
    const double error = kProbabilityRounding + roundingOf(i, j) / s;
    return {std::max(0.0, p - error), std::min(1.0, p + error), p};
  }

  /// By a series, or, if that is too long, by an integral that is left open.
  ProbabilityRange anisotropic(std::size_t i, std::size_t j) {
    if (!hasDigits(std::hypot(a_.spreads[i], b_.spreads[j]))) return {};
    const Matrix3d one = a_.factor(i);
    const Matrix3d other = a_from_b_.linear() * b_.factor(j);
    const Matrix3d covariance = one * one.transpose() + other * other.transpose();
    const double radius = a_.radii[i] + b_.radii[j];
    const ProbabilityRange series = withinBall(meanOf(i, j), covariance, radius, roundingOf(i, j));
    constexpr double kNarrow = 1e-9;
    if (series.gap() <= kNarrow) return series;
    EventIntegral::Noise noise;
    noise.mean = meanOf(i, j);
    noise.factor = factorOf(covariance);
    noise.spread = spreadOf(noise.factor);
    noise.rounding = roundingOf(i, j);
    noise.isConvex = true;
    open_.push_back({pairs_.size(), EventIntegral(noise, [radius](const Vector3d& position) {
                       return lookAtBall(position, radius);
                     })});
    return open_.back().integral.range();
  }

  /// Brings the bounds of all pairs this close. False if closer ones are impossible or useless.
  bool improvePairs(double accuracy) {
    double open = 0.0;
    for (Open& one : open_) {
      const int before = one.integral.looks();
      while (one.integral.range().gap() > accuracy &&
             effort_.looks + one.integral.looks() - before < goal_.options.maxLooks) {
        if (!one.integral.refine()) break;
      }
      effort_.looks += one.integral.looks() - before;
      pairs_[one.pair].range = one.integral.range();
      open += one.integral.range().gap();
    }
    constexpr double kShare = 0.1;  // of the accuracy; the rest is what pairs have in common
    return open > kShare * goal_.options.accuracy && effort_.looks < goal_.options.maxLooks &&
           accuracy > kProbabilityRounding;
  }

  ProbabilityRange boundGroups(const PairGroups& groups) {
    groups_.clear();
    AnyOfRanges any;
    for (std::size_t g = 0; g < groups.count(); ++g) {
      groups_.push_back(groupRange(pairs_, groups.group(g)));
      any.add(groups_.back());
    }
    ProbabilityRange range = any.range(near_.far());
    range.lower = std::max(range.lower, matched_.probability());
    if (!isComplete_) range.upper = 1.0;
    range.estimate = std::max(range.estimate, range.lower);
    return range;
  }

  /// Samples the least known groups until the estimate is as accurate as requested.
  void sample(const PairGroups& groups, CollisionProbability& result) {
    std::mt19937_64 random(goal_.options.seed);
    std::vector<GroupSamples> samples;
    std::vector<std::size_t> groupOf;
    for (std::size_t g = 0; g < groups.count(); ++g) {
      if (groups.group(g).size() == 1 || !(groups_[g].gap() > kProbabilityRounding)) continue;
      samples.emplace_back(a_, b_, a_from_b_, pairs_, groups.group(g));
      groupOf.push_back(g);
    }
    while (!samples.empty() && effort_.samples < goal_.options.maxSamples) {
      const std::size_t worst = leastKnown(samples, groupOf);
      const int draws = std::min(kDraws, goal_.options.maxSamples - effort_.samples);
      samples[worst].draw(draws, random);
      effort_.samples += draws;
      ProbabilityRange& range = groups_[groupOf[worst]];
      range.estimate = std::clamp(samples[worst].probability(), range.lower, range.upper);
      if (3.0 * combine(samples, groupOf, result) <= goal_.options.accuracy) break;
    }
  }

  /// Possible error of a group's estimate.
  double errorOf(const GroupSamples& samples, std::size_t group) const {
    const double most = 0.5 * groups_[group].gap();
    return samples.draws() > 0 ? std::min(most, samples.standardError()) : most;
  }

  std::size_t leastKnown(const std::vector<GroupSamples>& samples,
                         const std::vector<std::size_t>& groupOf) const {
    std::size_t worst = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double error = errorOf(samples[k], groupOf[k]) / othersWeight(groupOf[k]);
      if (error > most) {
        most = error;
        worst = k;
      }
    }
    return worst;
  }

  double othersWeight(std::size_t group) const {
    constexpr double kSure = 1e-6;
    return 1.0 - groups_[group].estimate + kSure;
  }

  /// Sets the estimate and its standard error, to first order in those of the groups. Returns the
  /// error, including that of groups that were not sampled.
  double combine(const std::vector<GroupSamples>& samples, const std::vector<std::size_t>& groupOf,
                 CollisionProbability& result) const {
    AnyOf any;
    for (const ProbabilityRange& range : groups_) any.add(range.estimate);
    const double p = any.probability();
    double drawn = 0.0;
    double all = 0.0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double share = (1.0 - p) / othersWeight(groupOf[k]);
      const double error = share * errorOf(samples[k], groupOf[k]);
      all += error * error;
      if (samples[k].draws() > 0) drawn += error * error;
    }
    result.probability = std::clamp(p, result.lower, result.upper);
    result.standardError = std::sqrt(drawn);
    return std::sqrt(all);
  }

  const NoisyCloudData& a_;
  const NoisyCloudData& b_;
  const Isometry3d& a_from_b_;
  const ProbabilityGoal& goal_;
  NearPairs near_;
  bool isComplete_ = false;
  std::vector<bool> usedA_;  ///< points of matched pairs
  std::vector<bool> usedB_;
  AnyOf matched_;  ///< by lower bounds
  std::vector<NoisyPair> pairs_;
  std::vector<Open> open_;
  std::vector<ProbabilityRange> groups_;
  ProbabilityEffort effort_;
};

}  // namespace

CollisionProbability cloudProbability(const NoisyCloudData& a, const NoisyCloudData& b,
                                      const Isometry3d& a_from_b, const ProbabilityGoal& goal) {
  const Isometry3d rigid = rigidPose(a_from_b);
  if (!rigid.matrix().allFinite()) return {};
  return CloudQuery(a, b, rigid, goal).run();
}

}  // namespace swept::detail
