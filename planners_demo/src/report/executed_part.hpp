// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "report/report.hpp"
#include "report/report_worlds.hpp"
#include "report/stopwatch.hpp"
#include "report/turns.hpp"

namespace swept {

/// Collects, world by world, what is proven of the curves that are executed of planned paths.
class ExecutedPart {
 public:
  /// A time is the least of so many passes.
  ExecutedPart(const Robot& robot, const Group& group, int passes);

  /// Whether the group's paths have curves: if not, it is not to be asked.
  bool applies() const { return leftOut_.empty(); }
  /// `paths`: way points as columns, whose straight motions `checkers.truth` proves free.
  void add(const ReportCheckers& checkers, const std::vector<Eigen::MatrixXd>& paths,
           const Stopwatch& stopwatch, const ReportTick& tick);
  ExecutedPaths found() const;

 private:
  struct Tally {
    ExecutedRow row;
    std::vector<double> times;  ///< ns
  };
  std::string leftOut_;
  int passes_;
  std::size_t paths_ = 0, corners_ = 0;
  std::vector<Tally> tallies_;
};

}  // namespace swept
