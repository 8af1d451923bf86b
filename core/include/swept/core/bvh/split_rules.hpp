// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <functional>
#include <span>

#include "swept/core/arithmetic.hpp"

namespace swept {

/// The box of a primitive while the tree is built.
struct SplitItem {
  Eigen::Vector3d lower;  ///< m
  Eigen::Vector3d upper;  ///< m
  int primitive;          ///< its index

  double center(int axis) const { return 0.5 * lower[axis] + 0.5 * upper[axis]; }  ///< m
  Eigen::Vector3d center() const { return 0.5 * lower + 0.5 * upper; }             ///< m
};

/// A rule that divides a node's primitives. It reorders the items and returns how many of them,
/// from the first, go to the left child. 0 or all of them means "cannot divide"; they are then
/// halved. It is called with at least two items, whose boxes are finite.
template <typename Rule>
concept SplitRule = std::copy_constructible<Rule> &&
    requires(const Rule& rule, std::span<SplitItem> items) {
  { rule(items) } -> std::same_as<std::size_t>;
};

/// Any split rule: the tree calls it once per inner node.
using SplitFunction = std::function<std::size_t(std::span<SplitItem>)>;

/// Splits at the mean of the centres, along the axis with the largest extent of the centres.
struct MeanSplit {
  /// See `SplitRule`.
  std::size_t operator()(std::span<SplitItem> items) const;
};

/// Splits in halves at the median of the centres, along the axis with the largest extent of the
/// centres.
struct MedianSplit {
  /// See `SplitRule`.
  std::size_t operator()(std::span<SplitItem> items) const;
};

/// Splits at the mean of the centres along their direction of most spread (Gottschalk, Lin, Manocha
/// 1996).
struct PrincipalAxisSplit {
  /// See `SplitRule`.
  std::size_t operator()(std::span<SplitItem> items) const;
};

/// Minimises the sum over both sides of surface area times number of primitives, over cuts at equal
/// bins along the axis with the largest extent of the centres (Wald 2007).
struct SurfaceAreaSplit {
  /// See `SplitRule`.
  std::size_t operator()(std::span<SplitItem> items) const;
};

}  // namespace swept
