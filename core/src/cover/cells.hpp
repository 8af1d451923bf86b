// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "cover/solid.hpp"

namespace swept::detail {

/// A box and the part of the shape in it.
struct Cell {
  /// A convex part of a triangle, or a point.
  struct Patch {
    int count;     ///< of corners
    int triangle;  ///< -1: a point
  };
  Eigen::Vector3d lower;                 ///< m
  Eigen::Vector3d upper;                 ///< m
  std::vector<Patch> patches;            ///< none: the cell is solid throughout
  std::vector<Eigen::Vector3d> corners;  ///< m, of the patches, one after the other

  std::vector<Eigen::Vector3d> content;  ///< m; the shape in the cell is in the hull of these ...
  double blur = 0.0;                     ///< m, ... grown by this
  Eigen::Vector3d middle;                ///< m, of the content
  double reach = 0.0;                    ///< m, ball around the middle that contains it

  bool isSolid() const { return patches.empty(); }
  double size() const { return (upper - lower).maxCoeff(); }
  /// Whether the ball contains the content.
  bool isIn(const Eigen::Vector3d& center, double radius) const;
  /// m, distance of the middle from some point of the surface in the cell: the least of those
  /// tested.
  double nearest() const;
  /// m, radius of the least ball around `center` that contains the content.
  double farthest(const Eigen::Vector3d& center) const;
};

/// Boxes that divide the space around a shape, and their contents.
///
/// Lemma: the part of a shape S in a box C is in the hull of the surface of S in C together with
/// the corners of C in S. Proof: a linear function over S in C is largest at a point of the
/// surface, or at an interior point of S; the latter is then a local and so the global maximum over
/// C, and the face of C through it on which the function is constant either meets the surface or
/// lies in S, with a corner of C. A box without surface is in S or outside it, as its middle is.
///
/// Rounding: triangles are cut a little beyond the sides of the boxes (`margin_`), so where it is
/// uncertain whether a corner is in S, the surface beside it counts as content. What the cuts
/// themselves round is in Solid::pad().
class Cells {
 public:
  explicit Cells(const Solid& solid);
  Cell root() const;
  /// Appends the halves with content, divided across the longest side.
  void split(const Cell& cell, std::vector<Cell>& out);
  /// Whether halving it again is meaningful in double precision, and work is left.
  bool canSplit(const Cell& cell) const {
    return cell.size() > 1e3 * margin_ && splits_ < kMostSplits;
  }
  /// Fills in content, blur, middle and reach.
  void gather(Cell& cell);

 private:
  using Key = std::array<double, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  std::uint32_t cornersInside(const Cell& cell);
  bool middleIsSolid(const Cell& cell);

  /// For links at a hundredth of their size some ten thousand suffice.
  static constexpr int kMostSplits = 1 << 19;

  const Solid& solid_;
  double margin_;  ///< m
  int splits_ = 0;
  std::unordered_map<Key, bool, Hash> corners_;  ///< of boxes; most belong to several
};

}  // namespace swept::detail
