// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "certify/workspace_data.hpp"

namespace swept::detail {

/// Moving obstacles on a common clock with the robot: a configuration's last value is the time, and
/// whole configurations (see KinematicModel) have the obstacles' poses behind it.
///
/// A motion of all of them between two whole configurations is even, as the robot's is, as long as
/// no obstacle passes a waypoint. So a motion is taken apart where one does.

/// The configuration itself without moving obstacles, else `whole` after filling it.
std::span<const double> fullConfiguration(const CheckerModel& model, std::span<const double> q,
                                          std::vector<double>& whole);

/// A part [begin, end] of a motion on which the obstacles' motions are even.
struct WaypointSegment {
  double begin = 0.0;
  double end = 1.0;
  std::span<const double> from;  ///< whole configurations
  std::span<const double> to;

  double timeOf(double t) const { return begin + t * (end - begin); }
};

/// The parts of a motion in order; calls `visit(const WaypointSegment&)` until it returns false.
class WaypointSegments {
 public:
  WaypointSegments(const CheckerModel& model, std::span<const double> from,
                   std::span<const double> to, WorkspaceData& workspace);

  template <typename Visitor>
  void forEach(const Visitor& visit) {
    if (workspace_.from.empty()) {
      visit(WaypointSegment{.from = from_, .to = to_});
      return;
    }
    WaypointCrossing begin{0.0, from_.back()};
    for (std::size_t i = 0; i <= workspace_.crossings.size(); ++i) {
      const WaypointCrossing end = i < workspace_.crossings.size()
                                       ? workspace_.crossings[i]
                                       : WaypointCrossing{1.0, to_.back()};
      if (!visit(part(begin, end))) return;
      begin = end;
    }
  }

 private:
  WaypointSegment part(const WaypointCrossing& begin, const WaypointCrossing& end);
  void fill(const WaypointCrossing& crossing, std::vector<double>& whole) const;

  const CheckerModel& model_;
  std::span<const double> from_, to_;
  WorkspaceData& workspace_;
};

}  // namespace swept::detail
