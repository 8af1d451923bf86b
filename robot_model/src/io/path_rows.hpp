// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/group_columns.hpp"
#include "io/input_source.hpp"
#include "io/point_remarks.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Reads the rows of a table whose columns have names of joints and variables. Puts each into the
/// order of a group's variables and judges it.
class PathRows {
 public:
  /// `reference`: a value for each of the robot's variables, for those outside of the group.
  PathRows(const InputSource& source, const Robot& robot, const Group& group,
           const Eigen::VectorXd& reference)
      : source_(source), robot_(robot), group_(group), columns_(robot, group, reference) {}

  /// The columns of the rows that follow. `fail` is for what is missing.
  void setColumns(std::span<const std::string> names, const FailAtColumn& failAt,
                  const FailAt& fail);
  const GroupColumns& columns() const { return columns_; }

  /// Adds a row with a value for each column, each finite. `line`: for warnings. `mayJump`: an
  /// angle without limits does not say which way the motion from the row before turns.
  void add(std::span<const double> values, int line, const FailAt& fail, bool mayJump);

  /// Warns of values that were moved to limits, and of turns of more than half.
  void tellRemarks() const;
  const std::vector<std::vector<double>>& states() const { return states_; }
  std::vector<std::vector<double>> take() { return std::move(states_); }

 private:
  void noteTurns(std::span<const double> q, int line);

  const InputSource& source_;
  const Robot& robot_;
  const Group& group_;
  GroupColumns columns_;
  std::vector<std::vector<double>> states_;
  std::vector<double> before_;  ///< the last row as it was given
  PointRemarks taken_, turns_;
};

}  // namespace swept::detail
