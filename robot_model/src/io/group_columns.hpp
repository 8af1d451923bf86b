// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Throws InputError with the place of the error.
using FailAt = std::function<void(const std::string& message)>;
/// The same for the i-th column.
using FailAtColumn = std::function<void(std::size_t i, const std::string& message)>;

/// The columns of a table by their names: joints and variables in any order, those of a group and
/// others, which have to stay where a reference has them.
class GroupColumns {
 public:
  /// `reference`: a value for each of the robot's variables, for those outside of the group.
  GroupColumns(const Robot& robot, const Group& group, const Eigen::VectorXd& reference);

  /// The columns from now on. Fails for a name that the robot does not have, or a second time. If
  /// all joints of the group are of one robot of a cell, a name may lack that robot's: `elbow` is
  /// `left/elbow`, unless there is an `elbow`.
  void set(std::span<const std::string> names, const FailAtColumn& failAt);
  /// Whether a column may have this name.
  bool knows(const std::string& name) const;
  /// The group's variables that have no column.
  std::vector<std::string> missing() const;
  /// Fails when there are some.
  void requireWholeGroup(const FailAt& fail) const;
  /// Whether one of the columns from `begin` to before `end` is of the group.
  bool haveOfGroup(std::size_t begin, std::size_t end) const;

  /// The group's values in its own order, of a row with a value for each column.
  std::vector<double> ofGroup(std::span<const double> row) const;
  /// Of a row whose values for the group are `q`: the others are those of the reference, and
  /// mimicking joints follow their masters.
  void requireStill(std::span<const double> row, std::span<const double> q,
                    const FailAt& fail) const;
  /// The same of rates: those of joints outside of the group are 0. `rate`: what messages call it.
  void requireStillRates(const std::string& rate, std::span<const double> row,
                         std::span<const double> rates, const FailAt& fail) const;
  /// The row's values of the group equal those of `q`, the others those of the reference. `where`
  /// names `q`.
  void requireLike(std::span<const double> row, std::span<const double> q, const std::string& where,
                   const FailAt& fail) const;
  /// Whether two configurations of the group have the same values, to within tolerance::kLimit.
  bool areAlike(std::span<const double> a, std::span<const double> b) const;

 private:
  /// What a column is: a variable, or a joint that has none.
  struct Column {
    int variable = -1;  ///< the robot's; -1: it is a joint that mimics another, or is fixed
    int joint = -1;
    int place = -1;  ///< in a configuration of the group; -1: outside of it
  };
  Column columnOf(const std::string& name, const FailAt& fail) const;
  /// Of one of the robot's variables; empty outside of the group.
  std::optional<std::size_t> placeOf(int variable) const;

  const Robot& robot_;
  const Group& group_;
  const Eigen::VectorXd& reference_;
  std::string owner_;  ///< `left/`; empty: the group's joints are not of one robot of a cell
  std::vector<Column> columns_;
};

/// `reference`, or the robot's default state. Throws std::invalid_argument for another size.
Eigen::VectorXd referenceOf(const Robot& robot, const std::optional<Eigen::VectorXd>& reference);

/// Names of a group's variables.
std::vector<std::string> variableNames(const Robot& robot, const Group& group);

}  // namespace swept::detail
