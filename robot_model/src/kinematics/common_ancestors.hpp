// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kinematics/motion_model.hpp"

namespace swept::detail {

/// The last body that carries both of two. All that have one body in common are found together, in
/// time proportional to the number of bodies: going up from each pair takes, for a chain of n
/// bodies, n times as long for all its pairs.
class CommonAncestors {
 public:
  /// `model` must outlive this.
  explicit CommonAncestors(const KinematicModel& model);

  /// The first body of the pairs that are asked about from now on.
  void setFirst(int body);
  int first() const { return first_; }
  /// Of the first body and this one.
  int with(int body) const { return common_[body]; }

  /// Joints between the model frame and a body.
  int depth(int body) const { return depths_[body]; }
  /// Joints between the first body and this one.
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
