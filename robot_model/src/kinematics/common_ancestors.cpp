// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/common_ancestors.hpp"

namespace swept::detail {

CommonAncestors::CommonAncestors(const KinematicModel& model)
    : model_(model), depths_(model.bodies.size(), 0), common_(model.bodies.size(), 0) {
  for (std::size_t i = 1; i < depths_.size(); ++i)
    depths_[i] = depths_[model_.bodies[i].parent] + 1;
}

void CommonAncestors::setFirst(int body) {
  if (body == first_) return;
  first_ = body;
  common_.assign(common_.size(), -1);
  common_[0] = 0;
  for (int i = body; i > 0; i = model_.bodies[i].parent) common_[i] = i;
  // Parents have smaller indices than their children.
  for (std::size_t i = 1; i < common_.size(); ++i)
    if (common_[i] < 0) common_[i] = common_[model_.bodies[i].parent];
}

}  // namespace swept::detail
