// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/input_source.hpp"
#include "swept/robot_model/limits.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Throws InputError with the place of the error.
using FailAt = std::function<void(const std::string& message)>;

/// Reads the rows of a table whose columns have names of joints and variables. Puts each into the
/// order of a group's variables and judges it.
class PathRows {
 public:
  /// `reference`: a value for each of the robot's variables, for those outside of the group.
  PathRows(const InputSource& source, const Robot& robot, const Group& group,
           const Eigen::VectorXd& reference)
      : source_(source), robot_(robot), group_(group), reference_(reference) {}

  /// The columns of the rows that follow. `failAt(i, message)` is for the i-th name, `fail` for
  /// what is missing.
  void setColumns(std::span<const std::string> names,
                  const std::function<void(std::size_t, const std::string&)>& failAt,
                  const FailAt& fail);
  /// The same, of a state that may leave joints out: see requireLike().
  void setSomeColumns(std::span<const std::string> names,
                      const std::function<void(std::size_t, const std::string&)>& failAt);

  /// Adds a row with a value for each column, each finite. `line`: for warnings. `mayJump`: an
  /// angle without limits does not say which way the motion from the row before turns.
  void add(std::span<const double> values, int line, const FailAt& fail, bool mayJump);
  /// The values of setSomeColumns(). Those of the group must equal those of `state`, the others
  /// those of the reference. `where` names `state`.
  void requireLike(std::span<const double> values, const std::vector<double>& state,
                   const std::string& where, const FailAt& fail) const;

  /// Warns of values that were moved to limits, and of turns of more than half.
  void tellRemarks() const;
  const std::vector<std::vector<double>>& states() const { return states_; }
  /// Whether two states have the same values, to within tolerance::kLimit.
  bool areAlike(std::size_t a, std::size_t b) const;
  std::vector<std::vector<double>> take() { return std::move(states_); }

 private:
  /// What a column is: a variable, or a joint that has none.
  struct Column {
    int variable = -1;  ///< the robot's; -1: it is a joint that mimics another, or is fixed
    int joint = -1;
    int place = -1;  ///< in a configuration of the group; -1: outside of it
  };
  struct Remark {
    std::string text;
    int line = 0;
    std::size_t further = 0;
  };
  Column columnOf(const std::string& name, const FailAt& fail) const;
  void requireStill(std::span<const double> values, std::span<const double> q,
                    const FailAt& fail) const;
  void noteTurns(std::span<const double> q, int line);
  static void note(std::map<std::string, Remark>& remarks, const std::string& key,
                   const std::string& text, int line);

  const InputSource& source_;
  const Robot& robot_;
  const Group& group_;
  const Eigen::VectorXd& reference_;
  std::vector<Column> columns_;
  std::vector<std::vector<double>> states_;
  std::vector<double> before_;  ///< the last row as it was given
  std::map<std::string, Remark> taken_, turns_;
};

}  // namespace swept::detail
