// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kinematics/motion_model.hpp"

namespace swept::detail {

/// The last body that carries both of two bodies. All pairs with one common body are found
/// together, in time proportional to the number of bodies. Going up from each pair would take n
/// times as long for all pairs of a chain of n bodies.
class CommonAncestors {
 public:
  /// `model` must outlive this.
  explicit CommonAncestors(const KinematicModel& model);

  /// Sets the first body of the following pairs.
  void setFirst(int body);
  int first() const { return first_; }
  /// The common ancestor of the first body and this one.
  int with(int body) const { return common_[body]; }

  /// Number of joints between the model frame and a body.
  int depth(int body) const { return depths_[body]; }
  /// Number of joints between the first body and this one.
  int jointsTo(int body) const {
    return depths_[first_] + depths_[body] - 2 * depths_[common_[body]];
  }

 private:
  const KinematicModel& model_;
  std::vector<int> depths_;  ///< per body
  std::vector<int> common_;  ///< likewise
  int first_ = 0;
};

}  // namespace swept::detail
