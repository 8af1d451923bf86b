// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/schedule_checker.hpp"
#include "timed_polyline.hpp"

namespace swept::detail {

/// The values of a robot's own variables.
struct OwnSpace {
  Eigen::ArrayXd lower, upper;  ///< rad or m; of a cyclic variable a turn
  Eigen::Array<bool, Eigen::Dynamic, 1> cyclic;
  Eigen::ArrayXd range;  ///< rad or m: longest step of a tree, by variable
  RateBounds bounds;     ///< of every motion
  RateBounds planned;    ///< the same, with something to spare

  /// The way from one configuration to another; of a cyclic variable the shorter one.
  Eigen::VectorXd way(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;
};

/// A goal, and since when the robot may stay there.
struct TimedGoal {
  Eigen::VectorXd q;
  double restFrom = 0.0;  ///< s: proven free from here on, whatever moves
};

/// RRT-Connect in configurations and time (J. Kuffner and S. LaValle, 2000; in time, with goals at
/// many times: F. Grothe et al., ST-RRT*: Asymptotically-Optimal Bidirectional Motion Planning
/// through Space-Time, 2022). Each edge is a straight motion from rest to rest, as a controller can
/// execute it, and is proven beside the curves of others. So is whatever it finds.
class SpaceTimeSearch {
 public:
  SpaceTimeSearch(const ScheduleChecker& checker, const OwnSpace& space, unsigned seed);

  /// The knots of a way from rest at the start to rest at one of the goals, no later than `latest`
  /// (s), or none if `stop` returned true first.
  std::vector<TimedKnot> run(const TimedKnot& start, std::vector<TimedGoal> goals, double latest,
                             const std::function<bool()>& stop);
  /// The goal that the way leads to, after run().
  std::size_t goal() const { return goal_; }

 private:
  static constexpr std::size_t kRoot = std::numeric_limits<std::size_t>::max();
  struct Node {
    TimedKnot at;
    std::size_t parent = kRoot;
    std::size_t goal = 0;  ///< in the tree of goals, of its root
  };
  struct Tree {
    double direction = 1.0;  ///< of time, away from the root
    std::vector<Node> nodes = {};
  };
  struct Window {
    double first = 0.0, last = 0.0;  ///< s
  };

  double uniform();
  std::size_t index(std::size_t count);
  bool isFree(const TimedKnot& from, const TimedKnot& to);
  bool connects(const Tree& tree, const Node& node, const TimedKnot& to);
  void addRoot();
  std::optional<TimedKnot> sample();
  std::optional<std::size_t> nearest(const Tree& tree, const TimedKnot& to) const;
  std::optional<std::size_t> step(Tree& tree, std::size_t from, const TimedKnot& to, bool whole);
  std::optional<std::size_t> extend(Tree& tree);
  std::optional<std::size_t> reach(Tree& tree, const TimedKnot& to);
  std::vector<TimedKnot> path(std::size_t first, std::size_t last) const;

  const ScheduleChecker& checker_;
  const OwnSpace& space_;
  Workspace workspace_;
  std::mt19937 random_;
  std::vector<TimedGoal> goals_;
  Window arrival_;  ///< in which goals are wanted
  Tree forward_, backward_;
  std::size_t goal_ = 0;
};

}  // namespace swept::detail
