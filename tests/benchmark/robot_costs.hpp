// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "motion_samples.hpp"

/// One row of a table: what motions of one robot cost, in all of its worlds.
namespace swept::benchmark {

using Checkers = std::vector<std::shared_ptr<const Checker>>;

constexpr std::size_t kFree = 300;       ///< motions of a length wanted
constexpr std::size_t kColliding = 100;  ///< of 1 rad
constexpr int kMostTried = 4000;
constexpr double kSeconds = 0.25;  ///< s, for motions of a kind, in all worlds
constexpr int kFclPasses = 2;
const std::vector<double> kLengths{0.1, 1.0, 4.0};  ///< rad
constexpr std::size_t kMiddle = 1;                  ///< of kLengths: 1 rad

inline std::string whole(double value) {
  return std::to_string(std::lround(value));
}

/// The usual stack on the same motions, ns each. Only with FCL, for which a cloud
/// is an octree.
inline MotionCosts measurePeer(const Checker& checker, const std::vector<BenchMotion>& motions,
                               const BenchClock& clock) {
  MotionCosts costs;
  for (const FclResult& result : measureFcl(checker, motions, kFclPasses, clock))
    costs.nanoseconds.push_back(result.nanoseconds);
  return costs;
}

struct RobotCosts {
  std::vector<MotionCosts> free;  ///< by length
  MotionCosts colliding;          ///< 1 rad
  MotionCosts peer;               ///< free ones of 1 rad; empty without FCL
  int tried = 0, triedFree = 0, undecided = 0;

  double freeMean() const { return free[kMiddle].mean(); }  ///< ns, of 1 rad

  static std::vector<std::string> head(std::vector<std::string> first) {
    for (const char* column :
         {"free 0.1 rad", "free 1 rad", "free 4 rad", "colliding 1 rad",
          "of 1 rad: free, undecided", "free 1 rad, of first row", "FCL + OMPL us", "swept / FCL"})
      first.emplace_back(column);
    return first;
  }
  /// `reference`: ns, a free motion of 1 rad in the first row.
  std::vector<std::string> row(std::vector<std::string> first, double reference) const {
    for (const MotionCosts& costs : free) first.push_back(costs.text());
    first.push_back(colliding.text());
    first.push_back(whole(100.0 * triedFree / tried) + " %, " +
                    number(100.0 * undecided / tried, 2) + " %");
    first.push_back(number(freeMean() / reference));
    const bool compared = !peer.nanoseconds.empty();
    first.push_back(compared ? number(1e-3 * peer.mean()) : "-");
    first.push_back(compared ? number(freeMean() / peer.mean(), 2) : "-");
    return first;
  }
};

/// As many motions in each world.
inline RobotCosts costsOf(const Checkers& checkers, std::uint64_t seed, const BenchClock& clock) {
  RobotCosts costs;
  costs.free.resize(kLengths.size());
  const std::size_t worlds = checkers.size();
  const double seconds = kSeconds / static_cast<double>(worlds);
  const auto share = [&](std::size_t all) { return (all + worlds - 1) / worlds; };
  for (const auto& checker : checkers) {
    std::mt19937_64 random(seed);
    for (std::size_t i = 0; i < kLengths.size(); ++i) {
      const bool middle = i == kMiddle;
      const MotionSamples samples =
          sampleMotions(*checker, kLengths[i], share(kFree), middle ? share(kColliding) : 0,
                        static_cast<int>(share(kMostTried)), random);
      measureMotions(*checker, samples.free, seconds, clock, costs.free[i]);
      if (!middle) continue;
      measureMotions(*checker, samples.colliding, seconds, clock, costs.colliding);
      costs.tried += samples.tried;
      costs.triedFree += samples.triedFree;
      costs.undecided += samples.undecided;
      if (!builtWithFcl()) continue;
      const MotionCosts peer = measurePeer(*checker, samples.free, clock);
      costs.peer.nanoseconds.insert(costs.peer.nanoseconds.end(), peer.nanoseconds.begin(),
                                    peer.nanoseconds.end());
    }
  }
  return costs;
}

}  // namespace swept::benchmark
