// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "oracle/arm.hpp"
#include "random_pieces.hpp"
#include "swept/robot_model/checker.hpp"

/// A robot whose links have several pieces, made at random with what is around it, seen twice: by a
/// Checker, and piece by piece with poses of the oracle's. Pieces of the world are put where pieces
/// of the robot barely get, or do not get, so that for many the nearest piece is out of reach.
class ClearanceCase {
 public:
  ClearanceCase(std::uint64_t seed, const std::filesystem::path& folder);

  const swept::Checker& checker() const { return *checker_; }

  /// The least distance of all pieces of all checked pairs of bodies.
  struct Least {
    double lower = std::numeric_limits<double>::infinity();  ///< m
    double upper = std::numeric_limits<double>::infinity();  ///< m
    std::string bodyA, bodyB;                                ///< the pair that has it
    bool outOfReach = false;  ///< the pieces that have it are no pair that verdicts look at
  };
  /// `self`: of pairs with `selfPair` like this alone.
  Least distanceAt(const std::vector<double>& q, std::optional<bool> self = {}) const;
  /// Negative where bodies overlap.
  Least signedDistanceAt(const std::vector<double>& q) const;
  /// m. Of one pair of bodies.
  double distanceOf(const std::string& bodyA, const std::string& bodyB, bool selfPair,
                    const std::vector<double>& q) const;

  /// A configuration, often one at which something is near.
  std::vector<double> state();
  /// Another one, near the first or anywhere.
  std::vector<double> stateAfter(const std::vector<double>& q);
  /// At t on the motion, by the oracle.
  std::vector<double> between(const std::vector<double>& from, const std::vector<double>& to,
                              double t) const;

 private:
  struct Part {
    swept::Shape shape;
    Eigen::Isometry3d body_from_shape;
    double radius;           ///< m, of the ball around the shape
    Eigen::Vector3d center;  ///< m, of that ball, in the body's frame
  };
  struct Body {
    std::string name;
    std::string link;  ///< that carries it; empty: of the world
    std::vector<Part> parts;
  };
  /// Of a body of the world that moves.
  using Way = std::vector<swept::MovingObstacle::Waypoint>;

  void makeRobot(const std::filesystem::path& folder);
  std::string linkText(const std::string& name, double reach);
  std::string jointText(int index, const std::string& parent, const std::string& child);
  void makeWorld();
  void makeAttached();
  void makeRules();
  void makeChecker();
  void scaleParts();
  void findListed();
  Eigen::Vector3d besideARobotPiece(const std::vector<double>& q, double radius,
                                    Eigen::Vector3d& direction);
  static Part partOf(const RandomPiece& piece);
  std::vector<double> randomState();
  std::vector<double> full(const std::vector<double>& q) const;
  Eigen::Isometry3d poseOf(const Body& body, const std::vector<double>& q,
                           const std::vector<Eigen::Isometry3d>& links) const;
  const Body& find(const std::string& name, bool ofRobot) const;
  template <typename Measure>
  Least least(const std::vector<double>& q, std::optional<bool> self, const Measure& measure) const;

  swept::test::SplitMix random_;
  RandomPieces pieces_;
  std::vector<Body> robot_, world_;
  std::map<std::string, Way> ways_;
  swept::World built_;
  swept::CheckerOptions options_;
  std::shared_ptr<const swept::Robot> loaded_;
  std::optional<swept::Checker> checker_;
  std::unique_ptr<oracle::Arm> arm_;
  std::vector<int> place_;                  ///< of the group's values among the oracle's variables
  std::vector<std::vector<double>> seeds_;  ///< full states at which something is near
  /// Bodies and parts of the pairs with the world that verdicts look at.
  std::set<std::tuple<std::string, int, std::string, int>> listed_;
};
