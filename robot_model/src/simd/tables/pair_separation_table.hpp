// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace swept::detail {

/// For two bodies whose relative pose depends on one or two turning joints: the cells of joint
/// values in which all pairs of their geometry are proven apart. For two that are proven apart for
/// all values of all joints within their limits: a single cell, with no joint.
///
/// Links two joints apart on an arm come within millimetres of each other in most of their range,
/// and their relative pose depends on little else. Proving that once is better than proving it in
/// each motion.
struct PairSeparationTable {
  static constexpr int kMostJoints = 2;
  /// Number of parts of a cell along each joint: they refine a cell that is partly proven.
  static constexpr int kParts = 8;
  struct Axis {
    int body = 0;        ///< whose joint it is
    float lower = 0.0F;  ///< rad
    float upper = 0.0F;
    float partsPerUnit = 0.0F;
    int cells = 1;
  };
  std::array<Axis, kMostJoints> axes;
  int joints = 0;  ///< 0: never in contact
  /// Cells not proven, with smaller or equal indices: [i * (axes[1].cells + 1) + j] counts those of
  /// [0, i) x [0, j).
  std::vector<std::uint32_t> open;

  using Values = std::array<float, kMostJoints>;

  struct Cell {
    /// Bit k: the k-th of `pairs` is not proven; with more than kPairBits of them, the last bit
    /// stands for all from there on.
    std::uint8_t openPairs = 0;
    bool touching = false;    ///< some pair is in contact in the middle
    bool coarse = false;      ///< work ran out: the unproven parts were not tried as finely as this
    std::int32_t parts = -1;  ///< of an open cell: index into openParts; -1: all of them are open
    std::int32_t meeting = -1;  ///< index into meetings; -1: none is known
  };
  static constexpr std::size_t kPairBits = 8;
  std::vector<Cell> cells;  ///< [i * axes[1].cells + j]
  /// Bit (i * kParts + j): part i along the first joint, j along the second, is not proven.
  std::vector<std::uint64_t> openParts;
  struct Geometries {
    int a = 0;  ///< index into PairModel::robotGeometry
    int b = 0;
    double margin = 0.0;  ///< m, which they are proven to keep
  };
  using Pairs = std::vector<Geometries>;
  Pairs pairs;

  /// A ball in a body's solid.
  struct InnerBall {
    float center[3] = {};  ///< m, frame of SimdNode::center
    float inside = 0.0F;   ///< m, the radius
  };
  /// Balls that meet in the middle of a cell: around it contact is certain, or likely.
  struct Meeting {
    InnerBall a;
    InnerBall b;
    std::int32_t pair = 0;  ///< of `pairs`
  };
  std::vector<Meeting> meetings;

  /// Table of two bodies that are never in contact.
  static PairSeparationTable allApart(Pairs pairs);

  /// The cell with these values; null outside and if it is coarse.
  const Cell* cellAt(const Values& values) const;
  /// Whether all cells, or parts of them, that meet the box are proven. False outside the table and
  /// for NaN.
  bool free(const Values& lower, const Values& upper) const;
  /// The open pairs of all cells with open parts that meet the box, which must be inside the table.
  std::uint8_t openPairs(const Values& lower, const Values& upper) const;

 private:
  /// Indices of the parts that meet a box: from begin, up to but without end.
  struct Range {
    std::array<int, kMostJoints> begin{0, 0};
    std::array<int, kMostJoints> end{1, 1};
  };
  /// False outside the table and for NaN.
  bool find(const Values& lower, const Values& upper, Range& range) const;
  /// Whether none is open in the rectangle of cells.
  bool allProven(const Range& parts) const;
  /// Pairs of an open cell if one of its open parts is among these.
  std::uint8_t openAmong(const Range& parts, int i, int j) const;
};

}  // namespace swept::detail
