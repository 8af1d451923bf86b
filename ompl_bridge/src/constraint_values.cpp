// SPDX-License-Identifier: BSD-3-Clause
#include "constraint_values.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "swept/core/floating_point_environment.hpp"

namespace swept::detail {

ConstraintValues::ConstraintValues(const Checker& checker) : projection_(checker) {
  const Robot& robot = checker.robot();
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (const int index : checker.group().variables) {
    const Variable& variable = robot.variables()[static_cast<std::size_t>(index)];
    const Joint& joint = robot.joints()[static_cast<std::size_t>(variable.joint)];
    const bool slides = joint.type == JointType::Prismatic;
    slides_.emplace_back(slides ? variable.lower : -kNone, slides ? variable.upper : kNone);
  }
  const auto look = [&] { return movedRows(checker); };
  rows_ = detail::inForeignEnvironment() ? inDefaultEnvironment(look) : look();
}

std::vector<Eigen::Index> ConstraintValues::movedRows(const Checker& checker) {
  constexpr int kLooks = 32;
  constexpr double kReach = std::numbers::pi;  // rad or m, of variables without limits
  Eigen::MatrixXd slopes(projection_.rows(), projection_.degreesOfFreedom());
  Eigen::VectorXd most = Eigen::VectorXd::Zero(projection_.rows());
  Workspace workspace(projection_);
  std::vector<double> q(static_cast<std::size_t>(dimension()));
  for (int look = 0; look < kLooks; ++look) {
    for (std::size_t i = 0; i < q.size(); ++i) {
      const Variable& variable =
          checker.robot().variables()[static_cast<std::size_t>(checker.group().variables[i])];
      const double lower = std::max(variable.lower, -kReach);
      const double upper = std::min(variable.upper, kReach);
      // Evenly spread over the limits, each variable by a step of its own.
      const double step = std::sqrt(2.5 + static_cast<double>(i)) * (look + 1.0);
      q[i] = lower + (step - std::floor(step)) * (upper - lower);
    }
    projection_.jacobian(q, slopes, workspace);
    most = most.cwiseMax(slopes.rowwise().norm());
  }
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < most.size(); ++row)
    if (most[row] > 0.0) rows.push_back(row);
  return rows;
}

std::vector<double> ConstraintValues::usable(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  if (!x.allFinite()) return {};
  std::vector<double> q(x.begin(), x.end());
  for (std::size_t i = 0; i < q.size(); ++i)
    q[i] = std::clamp(q[i], slides_[i].first, slides_[i].second);
  return q;
}

void ConstraintValues::residuals(const Eigen::Ref<const Eigen::VectorXd>& x,
                                 Eigen::Ref<Eigen::VectorXd> out) {
  const std::vector<double> q = usable(x);
  out.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (q.empty()) return;
  withWorkspace([&](Workspace& workspace) {
    Eigen::VectorXd all(projection_.rows());
    projection_.residuals(q, all, workspace);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      out[static_cast<Eigen::Index>(i)] = all[rows_[i]];
    return true;
  });
}

void ConstraintValues::jacobian(const Eigen::Ref<const Eigen::VectorXd>& x,
                                Eigen::Ref<Eigen::MatrixXd> out) {
  const std::vector<double> q = usable(x);
  out.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (q.empty()) return;
  withWorkspace([&](Workspace& workspace) {
    Eigen::MatrixXd all(projection_.rows(), projection_.degreesOfFreedom());
    projection_.jacobian(q, all, workspace);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      out.row(static_cast<Eigen::Index>(i)) = all.row(rows_[i]);
    return true;
  });
}

bool ConstraintValues::project(std::span<double> q) {
  return withWorkspace([&](Workspace& workspace) { return projection_.project(q, {}, workspace); });
}

std::unique_ptr<ConstraintValues::Workspace> ConstraintValues::take() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      std::unique_ptr<Workspace> own = std::move(idle_.back());
      idle_.pop_back();
      return own;
    }
  }
  return std::make_unique<Workspace>(projection_);
}

void ConstraintValues::giveBack(std::unique_ptr<Workspace> workspace) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(workspace));
}

}  // namespace swept::detail
