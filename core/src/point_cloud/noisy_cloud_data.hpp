// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "swept/core/bvh/bv_tree.hpp"

namespace swept::detail {

struct NoisyCloudData {
  std::vector<Eigen::Vector3d> points;   ///< m
  std::vector<double> radii;             ///< m, one per point
  std::vector<Eigen::Matrix3d> factors;  ///< m, F F^T is the covariance; one per point or for all
  std::vector<double> spreads;  ///< m, largest standard deviation along any direction, rounded up
  BvTree<Aabb> tree;            ///< over the points alone
  std::vector<double> nodeRadius;  ///< m, the largest below each node of the tree
  std::vector<double> nodeSpread;  ///< m, the largest below each node of the tree

  const Eigen::Matrix3d& factor(std::size_t i) const {
    return factors[factors.size() == 1 ? 0 : i];
  }
};

/// m. A factor F with F F^T = covariance (m^2, symmetric, positive semidefinite); a multiple of the
/// unit matrix has one.
Eigen::Matrix3d factorOf(const Eigen::Matrix3d& covariance);

/// Whether a factor is a multiple of the unit matrix: the noise is the same in all directions.
bool isIsotropic(const Eigen::Matrix3d& factor);

/// m. Largest standard deviation along any direction, rounded up.
double spreadOf(const Eigen::Matrix3d& factor);

}  // namespace swept::detail
