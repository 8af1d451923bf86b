// SPDX-License-Identifier: BSD-3-Clause
#include "tip_projection.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"

namespace swept::detail {

namespace {

namespace ob = ompl::base;

class TipPosition : public ob::ProjectionEvaluator {
 public:
  TipPosition(const ob::StateSpace& space, InverseKinematics kinematics, StateConversion conversion)
      : ProjectionEvaluator(&space),
        kinematics_(std::move(kinematics)),
        conversion_(std::move(conversion)) {}

  unsigned int getDimension() const override { return 3; }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> projection) const override {
    std::vector<double> q(static_cast<std::size_t>(conversion_.dimension()));
    conversion_.toConfiguration(state, q);
    const std::optional<Eigen::Isometry3d> pose = kinematics_.findPose(q);
    projection = pose ? Eigen::Vector3d(pose->translation()) : Eigen::Vector3d::Zero();
  }

 private:
  InverseKinematics kinematics_;
  StateConversion conversion_;
};

/// OMPL's own projection for one and two values fails an assertion of its grids.
class FirstValues : public ob::ProjectionEvaluator {
 public:
  explicit FirstValues(const ob::StateSpace& space) : ProjectionEvaluator(&space) {}

  unsigned int getDimension() const override { return std::min(2U, space_->getDimension()); }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> projection) const override {
    for (unsigned int i = 0; i < getDimension(); ++i) {
      projection[i] = *space_->getValueAddressAtIndex(state, i);
    }
  }
};

std::optional<InverseKinematics> tipOf(const Robot& robot, const Group& group) {
  if (group.tipLink < 0) return std::nullopt;
  // Compiled at once; the rest of the robot is not used again.
  const std::shared_ptr<const Robot> borrowed(std::shared_ptr<const Robot>(), &robot);
  try {
    return InverseKinematics(borrowed, group.name, robot.links()[group.tipLink].name);
  } catch (const std::invalid_argument&) {  // the group does not move it
    return std::nullopt;
  }
}

}  // namespace

ob::ProjectionEvaluatorPtr makeProjection(const ob::StateSpace& space, const Robot& robot,
                                          const Group& group) {
  if (auto tip = tipOf(robot, group)) {
    return std::make_shared<TipPosition>(space, std::move(*tip), StateConversion(robot, group));
  }
  return std::make_shared<FirstValues>(space);
}

}  // namespace swept::detail
