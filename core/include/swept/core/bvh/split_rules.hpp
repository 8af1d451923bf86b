// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <functional>
#include <span>

#include "swept/core/arithmetic.hpp"

namespace swept {

/// A primitive while the tree is built: its box.
struct SplitItem {
  Eigen::Vector3d lower;  ///< m
  Eigen::Vector3d upper;  ///< m
  int primitive;          ///< its index

  double center(int axis) const { return 0.5 * lower[axis] + 0.5 * upper[axis]; }  ///< m
  Eigen::Vector3d center() const { return 0.5 * lower + 0.5 * upper; }             ///< m
};

/// How a node's primitives are parted: reorders the items and returns how many of them, from the
/// first, go to the left child. 0 or all of them means "I cannot part these"; they are then halved.
/// Called with at least two items, whose boxes are finite.
template <typename Rule>
concept SplitRule = std::copy_constructible<Rule> &&
    requires(const Rule& rule, std::span<SplitItem> items) {
  { rule(items) } -> std::same_as<std::size_t>;
};

/// Any split rule: the tree calls it once per inner node.
using SplitFunction = std::function<std::size_t(std::span<SplitItem>)>;

/// At the mean of the centres along the axis where these extend farthest.
struct MeanSplit {
  /// As `SplitRule` says.
  std::size_t operator()(std::span<SplitItem> items) const;
};

/// Halves, by the median of the centres along the axis where these extend farthest.
struct MedianSplit {
  /// As `SplitRule` says.
  std::size_t operator()(std::span<SplitItem> items) const;
};

/// At the mean of the centres along their direction of most spread (Gottschalk, Lin, Manocha 1996).
struct PrincipalAxisSplit {
  /// As `SplitRule` says.
  std::size_t operator()(std::span<SplitItem> items) const;
};

/// Least sum over the two sides of surface area times number of primitives, over cuts at equal bins
/// along the axis where the centres extend farthest (Wald 2007).
struct SurfaceAreaSplit {
  /// As `SplitRule` says.
  std::size_t operator()(std::span<SplitItem> items) const;
};

}  // namespace swept
