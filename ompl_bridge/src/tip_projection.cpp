// SPDX-License-Identifier: BSD-3-Clause
#include "tip_projection.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"

namespace swept::detail {

namespace {

namespace ob = ompl::base;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Each set-up of a space asks for the size of the cells, whether or not a planner needs cells.
/// OMPL takes a twentieth of the extents of 100 states, with a tenth added, which is most of the
/// time of a set-up. The extents of 20 states are smaller by a fifth (Panda, UR5), so a fifteenth
/// of them is about the same size.
class GroupProjection : public ob::ProjectionEvaluator {
 public:
  using ProjectionEvaluator::ProjectionEvaluator;

  void defaultCellSizes() override {
    constexpr int kStates = 20;
    constexpr double kCells = 15.0;
    const ob::StateSamplerPtr sampler = space_->allocStateSampler();
    ob::State* const state = space_->allocState();
    Eigen::VectorXd low = Eigen::VectorXd::Constant(getDimension(), kUnbounded);
    Eigen::VectorXd high = -low, projection = low;
    for (int i = 0; i < kStates; ++i) {
      sampler->sampleUniform(state);
      project(state, projection);
      low = low.cwiseMin(projection);
      high = high.cwiseMax(projection);
    }
    space_->freeState(state);
    cellSizes_.clear();
    for (const double extent : high - low) {
      // A tip that does not move along an axis has one cell there, of any size.
      cellSizes_.push_back(extent > 0.0 ? extent / kCells : 1.0);
    }
  }
};

class TipPosition : public GroupProjection {
 public:
  TipPosition(const ob::StateSpace& space, InverseKinematics kinematics, StateConversion conversion)
      : GroupProjection(&space),
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
class FirstValues : public GroupProjection {
 public:
  using GroupProjection::GroupProjection;

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
  return std::make_shared<FirstValues>(&space);
}

}  // namespace swept::detail
