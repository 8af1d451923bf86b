// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "arm.hpp"

namespace oracle {

/// Judges states of one group of one robot in one world. States are all the robot's variables, in
/// Arm::variables() order.
class Oracle {
 public:
  Oracle(Arm arm, std::vector<Body> world, const std::string& group);

  const Arm& arm() const { return arm_; }
  const std::vector<Body>& world() const { return world_; }
  /// Indices into Arm::variables() of what the group moves.
  const std::vector<int>& moving() const { return moving_; }
  /// Names of the bodies of each checked pair: link and world body, or two links.
  std::vector<std::pair<std::string, std::string>> pairs() const;

  struct Hit {
    std::string bodyA, bodyB;  ///< empty: nothing overlaps
    explicit operator bool() const { return !bodyA.empty(); }
  };
  /// Bodies that overlap wherever rounding has put the corners of meshes (surelyOverlap()).
  Hit hit(const std::vector<double>& q) const;
  /// Least distance over the checked pairs; at least `enough` in both values when it is larger.
  Gap clearance(const std::vector<double>& q, double enough) const;
  /// m, from a point of the model frame to a link or world body at a state.
  double distanceTo(const std::string& body, const std::vector<double>& q, const Vector3d& p) const;

 private:
  struct Pair {
    int a, b;    ///< links, or link and world body
    bool world;  ///< whether b is a world body
  };
  struct Placed {
    const Piece* piece;
    Isometry3d model_from_piece;
    Vector3d center;  ///< m, of the ball around it, model frame
  };
  using Placement = std::vector<std::vector<Placed>>;  ///< per body

  void findPairs();
  bool movesBetween(int linkA, int linkB) const;
  static Placed place(const Piece& piece, const Isometry3d& model_from_body);
  void placeLinks(const std::vector<double>& q, Placement& links) const;

  Arm arm_;
  std::vector<Body> world_;
  std::vector<int> moving_;
  std::vector<int> jointAbove_;  ///< per link; -1 for a root
  std::vector<Pair> pairs_;
  Placement placedWorld_;
};

}  // namespace oracle
