// SPDX-License-Identifier: BSD-3-Clause
#include "certify/schedule_tube.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "robot/joint_types.hpp"

namespace swept::detail {

TrackingTolerance widened(const Checker& checker, const std::vector<double>& off) {
  TrackingTolerance tracking = checker.options().tracking;
  const Robot& robot = checker.robot();
  const Group& group = checker.group();
  for (std::size_t v = 0; v < off.size(); ++v) {
    if (off[v] == 0.0) continue;
    const int variable = group.variables[v];
    const Joint& joint =
        robot.joints()[static_cast<std::size_t>(robot.variables()[variable].joint)];
    const int place = variable - joint.firstVariable;
    const std::optional<int> quaternion = quaternionPlace(joint.type);
    if (quaternion && place >= *quaternion)
      throw std::invalid_argument("certifySchedule: the orientation of the floating joint '" +
                                  joint.name + "' changes, which has no bound here");
    JointTolerance& own =
        tracking.joints.try_emplace(joint.name, static_cast<const JointTolerance&>(tracking))
            .first->second;
    (isLength(joint.type, place) ? own.translation : own.rotation) += off[v];
  }
  return tracking;
}

Checker inTube(const Checker& checker, const std::vector<double>& off) {
  constexpr double kToleranceShare = 0.25;  // m per rad and m that all values may be off together
  CheckerOptions options = checker.options();
  options.tracking = widened(checker, off);
  const double width = std::accumulate(off.begin(), off.end(), 0.0);
  options.tolerance = std::max(options.tolerance, kToleranceShare * width);
  const auto borrowed = [](const auto& owned) {
    return std::shared_ptr<std::remove_reference_t<decltype(owned)>>(std::shared_ptr<void>(),
                                                                     &owned);
  };
  return {borrowed(checker.robot()), checker.group().name, borrowed(checker.world()), options};
}

void dropResting(const PiecewisePolynomial& curve, std::vector<double>& off) {
  for (std::size_t v = 0; v < off.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    bool rests = true;
    for (std::size_t i = 0; i < curve.pieces() && rests; ++i)
      rests = (curve.coefficients(i).row(row).array() == curve.coefficients(0)(row, 0)).all();
    if (rests) off[v] = 0.0;
  }
}

}  // namespace swept::detail
