// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "certify/workspace_data.hpp"
#include "kinematics/joint_path.hpp"

namespace swept::detail {

/// Moving obstacles share a clock with the robot: a configuration's last value is the time. Full
/// configurations (see KinematicModel) append the poses of the obstacles.
///
/// Between two waypoints an obstacle moves on a straight line. So a motion is split where an
/// obstacle passes a waypoint.

/// The configuration itself without moving obstacles, else `full` after filling it.
std::span<const double> fullConfiguration(const CheckerModel& model, std::span<const double> q,
                                          std::vector<double>& full);

/// A part [begin, end] of a motion on which no obstacle changes its way.
struct WaypointSegment {
  double begin = 0.0;
  double end = 1.0;
  const JointPath& path;  ///< of the robot's joints and the obstacles' (see KinematicModel)

  double timeOf(double t) const { return begin + t * (end - begin); }
};

/// The parts of a motion in order; calls `visit(const WaypointSegment&)` until it returns false.
class WaypointSegments {
 public:
  /// `path`: of configurations, with a time that is linear in t.
  WaypointSegments(const CheckerModel& model, const JointPath& path, WorkspaceData& workspace);

  template <typename Visitor>
  void forEach(const Visitor& visit) {
    if (workspace_.from.empty()) {
      visit(WaypointSegment{.path = path_});
      return;
    }
    for (std::size_t i = 0; i + 1 < workspace_.crossings.size(); ++i)
      if (!visitBetween(workspace_.crossings[i], workspace_.crossings[i + 1], visit)) return;
  }

 private:
  template <typename Visitor>
  bool visitBetween(const WaypointCrossing& begin, const WaypointCrossing& end,
                    const Visitor& visit) {
    fill(begin, workspace_.from);
    fill(end, workspace_.to);
    const KinematicModel& kinematics = model_.kinematics;
    // A straight path between the configurations at the ends rounds less than a part of the whole
    // path does.
    if (path_.asStraight() != nullptr) {
      const StraightPath segment(kinematics, workspace_.from, workspace_.to);
      return visit(WaypointSegment{begin.t, end.t, segment});
    }
    const PathSegment segment(kinematics, path_, begin.t, end.t, workspace_.from, workspace_.to);
    return visit(WaypointSegment{begin.t, end.t, segment});
  }
  void addCrossings(double begin, double end);
  void fill(const WaypointCrossing& crossing, std::vector<double>& full) const;

  const CheckerModel& model_;
  const JointPath& path_;
  WorkspaceData& workspace_;
};

}  // namespace swept::detail
