// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/constraint_projection.hpp"

namespace swept::detail {

/// A ConstraintProjection with workspaces for any number of threads.
class ConstraintValues {
 public:
  explicit ConstraintValues(const Checker& checker);

  int dimension() const { return projection_.dimension(); }
  /// Those that some motion changes: sides of a box that are infinite are none.
  int rows() const { return static_cast<int>(rows_.size()); }
  ///@{
  /// As ConstraintProjection, of rows(), with sliding joints taken to their limits; NaN for what is
  /// not finite.
  void residuals(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> out);
  void jacobian(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::MatrixXd> out);
  bool project(std::span<double> q);
  ///@}

 private:
  using Workspace = ConstraintProjection::Workspace;
  /// Rows of the projection that have a derivative at some of many configurations.
  std::vector<Eigen::Index> movedRows(const Checker& checker);
  /// The configuration that is looked at; empty: `x` is not finite.
  std::vector<double> usable(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  template <typename Task>
  auto withWorkspace(const Task& task) {
    std::unique_ptr<Workspace> own = take();
    auto result = task(*own);
    giveBack(std::move(own));
    return result;
  }
  std::unique_ptr<Workspace> take();
  void giveBack(std::unique_ptr<Workspace> workspace);

  ConstraintProjection projection_;
  std::vector<Eigen::Index> rows_;                 ///< of the projection's
  std::vector<std::pair<double, double>> slides_;  ///< m, of each variable; infinite: it turns
  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> idle_;
};

}  // namespace swept::detail
