// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/inverse_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "kinematics/degrees_of_freedom.hpp"
#include "kinematics/full_state.hpp"
#include "kinematics/lever_arms.hpp"
#include "kinematics/motion_model.hpp"
#include "kinematics/rigid_transform.hpp"
#include "robot/joint_types.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/limits.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace detail {

/// The moving frames between the model's and a tool's, and the meaning of the group's variables.
struct ToolChain {
  std::shared_ptr<const Robot> robot;
  const Group* group = nullptr;
  KinematicModel kinematics;
  std::vector<int> path;                                             ///< bodies, root first
  Eigen::Isometry3d body_from_tool = Eigen::Isometry3d::Identity();  ///< of the last body
  DegreesOfFreedom freedom;
  double scale = 1.0;  ///< m that count as much as a radian
};

}  // namespace detail

namespace {

using detail::Degree;
using detail::MovingBody;
using detail::ToolChain;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Jacobian = detail::PointJacobian;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kShortestQuaternion = 1e-6;  // compileJoint refuses shorter ones
constexpr const char* kUnusable =
    "a value is not finite, a quaternion has no direction, or a prismatic value is outside its "
    "limits";

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("InverseKinematics: " + what);
}

void requireSize(std::size_t size, std::size_t expected, const std::string& what) {
  if (size == expected) return;
  refuse(what + " has " + std::to_string(size) + " values instead of " + std::to_string(expected));
}

void requireRigid(const Isometry3d& pose, const std::string& what) {
  if (!detail::isRigid(pose)) refuse(what + " is not a rigid transform");
}

/// Metres are compared with radians at the longest lever arm of the chain.
double scaleOf(const detail::LeverArms& levers) {
  const double longest = *std::max_element(levers.arms.begin(), levers.arms.end());
  return longest > 0.0 && std::isfinite(longest) ? longest : 1.0;
}

/// Walks along the chain and passes on each joint's frame and that of its body. False for
/// configurations that compileJoint refuses.
template <typename Visit>
bool walk(const ToolChain& chain, std::span<const double> q, const Visit& visit) {
  detail::BodyState state;
  detail::JointMotion still;
  for (std::size_t i = 0; i < chain.path.size(); ++i) {
    const MovingBody& body = chain.kinematics.bodies[chain.path[i]];
    if (!detail::compileJoint(chain.kinematics, body, q, q, still)) return false;
    const Isometry3d world_from_joint = state.world_from_body * body.parent_from_joint;
    state = detail::bodyAt(body, still, 0.0, state);
    visit(i, world_from_joint, state.world_from_body);
  }
  return true;
}

bool allFinite(std::span<const double> q) {
  return std::all_of(q.begin(), q.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

PoseError poseError(const Isometry3d& actual, const Isometry3d& wanted) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return poseError(actual, wanted); });
  }
  return {(wanted.translation() - actual.translation()).norm(),
          detail::rotationVector(wanted.linear() * actual.linear().transpose()).norm()};
}

InverseKinematics::Workspace::Workspace(const InverseKinematics& kinematics)
    : candidate_(kinematics.chain_->freedom.degreeOf.size()),
      world_from_joint_(kinematics.chain_->path.size()),
      world_from_body_(kinematics.chain_->path.size()),
      jacobian_(6, kinematics.degreesOfFreedom()),
      step_(kinematics.degreesOfFreedom()) {}

InverseKinematics::InverseKinematics(std::shared_ptr<const Robot> robot, std::string_view group,
                                     std::string_view link,
                                     const std::optional<Eigen::VectorXd>& reference,
                                     const Isometry3d& link_from_tool) {
  if (detail::inForeignEnvironment()) {
    *this = inDefaultEnvironment([&] {
      return InverseKinematics(std::move(robot), group, link, reference, link_from_tool);
    });
    return;
  }
  if (!robot) refuse("no robot given");
  const std::string of = "robot '" + robot->name() + "'";
  auto chain = std::make_shared<ToolChain>();
  chain->group = robot->findGroup(group);
  if (chain->group == nullptr) refuse(of + " has no group '" + std::string(group) + "'");
  const std::optional<int> index = robot->findLink(link);
  if (!index) refuse(of + " has no link '" + std::string(link) + "'");
  const Eigen::VectorXd held = reference.value_or(robot->defaultState());
  detail::requireFullState(*robot, held, "InverseKinematics", "the reference");
  requireRigid(link_from_tool, "the tool");

  chain->robot = std::move(robot);
  chain->kinematics = detail::compileKinematics(*chain->robot, *chain->group, held);
  chain->body_from_tool = chain->kinematics.body_from_link[*index] * link_from_tool;
  const detail::LeverArms levers =
      detail::leverArms(chain->kinematics, chain->kinematics.bodyOfLink[*index],
                        chain->body_from_tool.translation(), 0.0);
  if (levers.path.empty()) {
    refuse("group '" + chain->group->name + "' does not move link '" + std::string(link) + "'");
  }
  chain->path = levers.path;
  chain->scale = scaleOf(levers);
  chain->freedom = detail::degreesOfFreedom(*chain->robot, *chain->group);
  chain_ = std::move(chain);
}

InverseKinematics::InverseKinematics(std::shared_ptr<const ToolChain> chain)
    : chain_(std::move(chain)) {}

InverseKinematics InverseKinematics::within(ConfigurationView lower,
                                            ConfigurationView upper) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, lower, upper] { return within(lower, upper); });
  }
  requireSize(lower.size(), chain_->freedom.degreeOf.size(), "the lower limit");
  requireSize(upper.size(), chain_->freedom.degreeOf.size(), "the upper limit");
  auto chain = std::make_shared<ToolChain>(*chain_);
  if (const auto variable = chain->freedom.limit(lower, upper)) {
    refuse("the limits leave no value to variable '" +
           robot().variables()[group().variables[*variable]].name + "'");
  }
  return InverseKinematics(std::move(chain));
}

const Robot& InverseKinematics::robot() const {
  return *chain_->robot;
}

const Group& InverseKinematics::group() const {
  return *chain_->group;
}

int InverseKinematics::dimension() const {
  return static_cast<int>(chain_->freedom.degreeOf.size());
}

int InverseKinematics::degreesOfFreedom() const {
  return static_cast<int>(chain_->freedom.degrees.size());
}

std::optional<Isometry3d> InverseKinematics::findPose(ConfigurationView q) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return findPose(q); });
  }
  requireSize(q.size(), chain_->freedom.degreeOf.size(), "the configuration");
  if (!allFinite(q)) return {};
  Isometry3d world_from_body;
  const auto keep = [&](std::size_t, const Isometry3d&, const Isometry3d& body) {
    world_from_body = body;
  };
  if (!walk(*chain_, q, keep)) return {};
  return world_from_body * chain_->body_from_tool;
}

Isometry3d InverseKinematics::pose(ConfigurationView q) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return pose(q); });
  }
  const std::optional<Isometry3d> found = findPose(q);
  if (!found) refuse(kUnusable);
  return *found;
}

namespace {

/// The Jacobian of the tool from the frames along its chain.
void fillJacobian(const ToolChain& chain, const std::vector<Isometry3d>& world_from_joint,
                  const std::vector<Isometry3d>& world_from_body, Jacobian& jacobian) {
  const Vector3d p = world_from_body.back() * chain.body_from_tool.translation();
  jacobian.setZero();
  for (std::size_t i = 0; i < chain.path.size(); ++i) {
    detail::addJointColumns(chain.freedom, chain.kinematics.bodies[chain.path[i]],
                            world_from_joint[i].linear(), world_from_body[i].translation(), p, 1.0,
                            jacobian);
  }
}

void requireSeed(const ToolChain& chain, std::span<const double> q) {
  requireSize(q.size(), chain.freedom.degreeOf.size(), "the seed");
  if (!allFinite(q)) refuse("the seed has a value that is not finite");
  for (const int first : chain.freedom.quaternions) {
    if (!(Eigen::Map<const Eigen::Vector4d>(&q[first]).norm() > kShortestQuaternion)) {
      refuse("the seed has a quaternion without direction");
    }
  }
}

void requirePositive(double value, std::string_view of, std::string_view unit) {
  if (value > 0.0) return;
  refuse("the " + std::string(of) + " is " + detail::formatNumber(value) + std::string(unit) +
         "; it must be above 0");
}

void requireSensible(const InverseKinematicsOptions& options) {
  requirePositive(options.positionTolerance, "position tolerance", " m");
  requirePositive(options.orientationTolerance, "orientation tolerance", " rad");
  requirePositive(options.firstDamping, "first damping", "");
  if (options.maxIterations < 0) {
    refuse("the number of iterations is " + std::to_string(options.maxIterations) +
           "; it must be at least 0");
  }
}

}  // namespace

Jacobian InverseKinematics::jacobian(ConfigurationView q) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return jacobian(q); });
  }
  requireSize(q.size(), chain_->freedom.degreeOf.size(), "the configuration");
  Workspace workspace(*this);
  const auto keep = [&](std::size_t i, const Isometry3d& joint, const Isometry3d& body) {
    workspace.world_from_joint_[i] = joint;
    workspace.world_from_body_[i] = body;
  };
  if (!allFinite(q) || !walk(*chain_, q, keep)) refuse(kUnusable);
  fillJacobian(*chain_, workspace.world_from_joint_, workspace.world_from_body_,
               workspace.jacobian_);
  return workspace.jacobian_;
}

/// Descends from one seed in the squared error, where lengths are divided by the chain's scale.
///
/// A step is J^T (J J^T + damping 1)^-1 e over the free degrees: those that are not at a limit
/// beyond which the error would fall. It is cut off at the limits. Steps that do not lower the
/// error are undone and damped more. With enough damping they follow the projected gradient, so
/// that only a stationary point has no step that lowers the error.
class InverseKinematics::Search {
 public:
  Search(const ToolChain& chain, const Isometry3d& wanted, std::span<double> q,
         const InverseKinematicsOptions& options, Workspace& workspace)
      : chain_(chain), wanted_(wanted), q_(q), options_(options), workspace_(workspace) {
    const double position = std::isfinite(options.positionTolerance) ? 1.0 : 0.0;
    const double rotation = std::isfinite(options.orientationTolerance) ? 1.0 : 0.0;
    counts_ << position, position, position, rotation, rotation, rotation;
    chain_.freedom.putInPlace(q_);
    error_ = errorAt(q_);
  }

  bool run() {
    double damping = std::max(options_.firstDamping, kLeastDamping);
    bool moved = true;
    for (int i = 0; i < options_.maxIterations && !arrived(); ++i) {
      if (moved) linearise();
      propose(damping);
      const Vector6 next = errorAt(workspace_.candidate_);
      moved = next.squaredNorm() < error_.squaredNorm();
      if (moved) {
        std::copy(workspace_.candidate_.begin(), workspace_.candidate_.end(), q_.begin());
        error_ = next;
        damping = std::max(damping * kTrustMore, kLeastDamping);
      } else {
        damping *= kTrustLess;
        if (damping > kMostDamping) break;
      }
    }
    return arrived();
  }

 private:
  // Relative to squared lever arms of at most about 1 each. Less damping than the minimum would
  // only amplify rounding where the chain has lost a direction; with more than the maximum, steps
  // are shorter than 1e-8 of the error.
  static constexpr double kLeastDamping = 1e-8;
  static constexpr double kMostDamping = 1e8;
  static constexpr double kTrustMore = 0.1;
  static constexpr double kTrustLess = 5.0;

  /// Also leaves the frames along the chain in the workspace.
  Vector6 errorAt(std::span<const double> q) {
    const auto keep = [this](std::size_t i, const Isometry3d& joint, const Isometry3d& body) {
      workspace_.world_from_joint_[i] = joint;
      workspace_.world_from_body_[i] = body;
    };
    walk(chain_, q, keep);  // refuses nothing that a limit allows
    const Isometry3d actual = workspace_.world_from_body_.back() * chain_.body_from_tool;
    Vector6 error;
    error << (wanted_.translation() - actual.translation()) / chain_.scale,
        detail::rotationVector(wanted_.linear() * actual.linear().transpose());
    return error.cwiseProduct(counts_);
  }

  bool arrived() const {
    return error_.head<3>().norm() * chain_.scale <= options_.positionTolerance &&
           error_.tail<3>().norm() <= options_.orientationTolerance;
  }

  /// The scaled Jacobian at q_, whose frames are in the workspace; columns that are not free are 0.
  void linearise() {
    Jacobian& jacobian = workspace_.jacobian_;
    fillJacobian(chain_, workspace_.world_from_joint_, workspace_.world_from_body_, jacobian);
    jacobian.topRows<3>() /= chain_.scale;
    for (std::size_t i = 0; i < chain_.freedom.degrees.size(); ++i) {
      const Degree& degree = chain_.freedom.degrees[i];
      auto column = jacobian.col(static_cast<Eigen::Index>(i));
      column = column.cwiseProduct(counts_).eval();
      if (degree.slides) column *= chain_.scale;
      if (degree.turn) continue;
      const double wish = column.dot(error_);
      if (degree.isHeld(q_[degree.variable], wish)) {
        column.setZero();
      }
    }
  }

  void propose(double damping) {
    const Jacobian& jacobian = workspace_.jacobian_;
    Matrix6 normal = damping * Matrix6::Identity();
    for (Eigen::Index i = 0; i < jacobian.cols(); ++i) {
      normal.noalias() += jacobian.col(i) * jacobian.col(i).transpose();
    }
    const Vector6 pull = normal.ldlt().solve(error_);
    for (Eigen::Index i = 0; i < jacobian.cols(); ++i) {
      workspace_.step_[i] = jacobian.col(i).dot(pull);
    }
    chain_.freedom.move(q_, workspace_.step_, chain_.scale, workspace_.candidate_);
  }

  const ToolChain& chain_;
  const Isometry3d& wanted_;
  const std::span<double> q_;
  const InverseKinematicsOptions& options_;
  Workspace& workspace_;
  Vector6 counts_;  ///< 1, or 0 for components without a tolerance
  Vector6 error_;   ///< rad; at q_
};

bool InverseKinematics::solve(const Isometry3d& model_from_tool, ConfigurationSpan q,
                              const InverseKinematicsOptions& options, Workspace& workspace) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, q] { return solve(model_from_tool, q, options, workspace); });
  }
  requireRigid(model_from_tool, "the target");
  requireSeed(*chain_, q);
  requireSensible(options);
  if (workspace.world_from_body_.size() != chain_->path.size() ||
      workspace.candidate_.size() != chain_->freedom.degreeOf.size() ||
      workspace.step_.size() != degreesOfFreedom()) {
    refuse("the workspace is of another object");
  }
  return Search(*chain_, model_from_tool, q, options, workspace).run();
}

}  // namespace swept
