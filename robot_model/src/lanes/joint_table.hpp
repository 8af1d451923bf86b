// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace swept::detail {

struct CheckerModel;
struct LaneBodyPair;
struct LaneModel;

/// For two bodies whose relative pose depends on one or two joints that turn: the cells of joint
/// values in which all pairs of their geometry are proven apart.
///
/// Neighbours but one along an arm come within millimetres of each other in most of their range,
/// and little else in it changes; proving that once is worth more than proving it in each motion.
struct JointTable {
  static constexpr int kMostJoints = 2;
  struct Axis {
    int body = 0;        ///< whose joint it is
    float lower = 0.0F;  ///< rad
    float upper = 0.0F;
    float cellsPerUnit = 0.0F;
    int cells = 1;
  };
  std::array<Axis, kMostJoints> axes;
  int joints = 0;  ///< 0: no table
  /// Cells not proven, with smaller or equal indices: [i * (axes[1].cells + 1) + j] counts those of
  /// [0, i) x [0, j).
  std::vector<std::uint32_t> open;

  using Values = std::array<float, kMostJoints>;

  struct Cell {
    /// Bit k: not proven is the k-th of `pairs`; with more than kPairBits of them, the last bit
    /// stands for all from there on.
    std::uint8_t openPairs = 0;
    bool touching = false;  ///< some pair is in contact in the middle
    /// Two balls inside the bodies that meet in the middle: where a contact is certain, or likely.
    std::int32_t nodeA = -1;  ///< of LaneModel::nodes; -1: none is known
    std::int32_t nodeB = -1;
  };
  static constexpr std::size_t kPairBits = 8;
  std::vector<Cell> cells;  ///< [i * axes[1].cells + j]
  struct Geometries {
    int a = 0;  ///< index into CheckerModel::robotGeometry
    int b = 0;
  };
  std::vector<Geometries> pairs;

  /// The cell with these values; null outside.
  const Cell* cellAt(const Values& values) const;
  /// Whether all cells that meet the box are proven. False outside of the table and for NaN.
  bool free(const Values& lower, const Values& upper) const;
  /// The open pairs of all cells that meet the box, which has to be inside of the table.
  std::uint8_t openPairs(const Values& lower, const Values& upper) const;

  /// Indices of the cells that meet a box: from begin, up to but without end.
  struct Range {
    std::array<int, kMostJoints> begin{0, 0};
    std::array<int, kMostJoints> end{1, 1};
  };
  /// False outside of the table and for NaN.
  bool find(const Values& lower, const Values& upper, Range& range) const;
};

/// Of two bodies of the model; null if they cannot have one, or none that is worth building. The
/// work it takes goes off the budget.
std::shared_ptr<const JointTable> buildJointTable(const CheckerModel& model, const LaneModel& lanes,
                                                  const LaneBodyPair& bodies, int& budget);

}  // namespace swept::detail
