// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cover/cells.hpp"
#include "cover/solid.hpp"
#include "swept/core/sphere_cover.hpp"

namespace swept::detail {

struct LevelAim {
  double overhang;     ///< m
  double largestCell;  ///< m, of those with surface
};

/// Grows the tree of a cover level by level. A node owns the cells whose content its ball contains;
/// its children share them.
///
/// A ball around a candidate c of radius depth(c) + delta reaches at most delta beyond the shape.
/// So with inscribed balls as candidates, a level of overhang delta is a set cover of its cells.
/// Deep balls lie flat against the surface, so few are needed.
class CoverBuilder {
 public:
  CoverBuilder(const Shape& shape, const SphereCoverOptions& options);
  SphereCover build();

 private:
  struct Node {
    Candidate place;
    double radius;  ///< m, without inflation
    double beyond;  ///< m, how far the ball reaches beyond the shape and its pockets
    int level;
    int firstChild = 0;
    int childCount = 0;
    std::vector<Cell> cells;
    std::vector<Candidate> pool;
  };
  /// A candidate and the radius of the ball it stands for.
  struct Ball {
    Candidate place;
    double radius;  ///< m
  };

  /// How the children share a node's content.
  struct Division {
    std::vector<Cell> cells;
    std::vector<Ball> balls;
    std::vector<int> chosen;                 ///< of the balls: the children
    std::vector<int> owner;                  ///< per cell: index into `chosen`
    std::size_t placed = 0;                  ///< number of first cells that have an owner
    std::vector<std::vector<int>> usefulTo;  ///< per ball: owners of cells that it contains
  };

  bool addLevel(int level, const LevelAim& aim);
  std::vector<Node> childrenOf(Node& node, int level, const LevelAim& aim);
  std::vector<Cell> refine(std::vector<Cell> pending, double mostDepth, const LevelAim& aim,
                           Division& division);
  static void chooseFor(Division& division, std::size_t first);
  void placeSolids(std::vector<Cell> pending, double delta, Division& division);
  void suggest(const Cell& cell, double mostDepth, double delta, std::vector<Ball>& balls);
  bool isCovered(const Cell& cell, double delta, bool divisible, std::vector<Ball>& balls);
  SphereCover::Node finished(const Node& node) const;
  std::vector<CoverBall> innerBalls() const;
  void findInsides(SphereCover& cover) const;

  const SphereCoverOptions options_;
  const Solid solid_;
  Cells cells_;
  double rootRadius_ = 0.0;  ///< m
  std::vector<Node> nodes_;
  std::vector<Candidate> seen_;  ///< proven, for the inner balls
  Contacts contacts_;
};

}  // namespace swept::detail
