// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "line/line_model.hpp"
#include "line/line_stop.hpp"
#include "swept/robot_model/tool_line.hpp"

namespace swept::detail {

/// Follows one line from way point to way point.
///
/// The deviation of a chord grows with the square of its length, so the next one is as long as the
/// last one's allows; one that is too long anyway is made shorter by the same law. A target that
/// inverse kinematics does not reach is approached by halves.
class LineSearch {
 public:
  LineSearch(const LineModel& model, const StraightMotion& line, const ToolLineOptions& options,
             Workspace& workspace, ToolLine& path);

  /// `path` has the start, the goal, the length and the turn.
  void run();

 private:
  enum class Outcome : std::uint8_t { Added, NotSolved, NotStraight, NotFree };

  void follow();
  /// Tries a chord from the last way point, and adds its end if all is proven.
  Outcome attempt(double target);
  void predict(double target);
  double stepFrom(double wished) const;
  void endBefore(const MotionCertificate& found, double target);
  void joinEnd();
  void takeJointStep(bool solved, double step);
  double last() const { return path_.shares.back(); }
  std::span<const double> lastWayPoint() const { return path_.wayPoints.back(); }

  const LineModel& model_;
  const StraightMotion& line_;
  const ToolLineOptions& options_;
  Workspace& workspace_;
  ToolLine& path_;
  InverseKinematics::Workspace solverWorkspace_;
  InverseKinematicsOptions solverOptions_;
  Deviation allowed_;
  DeviationScratch scratch_;
  DeviationProof proof_;               ///< of the last attempt
  MotionCertificate certificate_;      ///< likewise
  std::vector<Deviation> deviations_;  ///< proven, of the chords
  std::vector<double> candidate_;      ///< the end of the last attempt
  std::vector<double> seed_;
  double candidateShare_ = -1.0;  ///< of `candidate_`, if it is a solution
  double leastStep_ = 0.0;        ///< share
  double blocked_ = 2.0;          ///< share that was not solved for
  std::size_t blockedSince_ = 0;  ///< index of the way point then
};

}  // namespace swept::detail
