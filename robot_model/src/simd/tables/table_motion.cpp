// SPDX-License-Identifier: BSD-3-Clause
#include "simd/tables/table_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/pair_model.hpp"
#include "rounding/error_model.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Along each joint, of a table for one and for two.
constexpr std::array<int, 3> kCells{1, 1024, 192};

}  // namespace

std::optional<TableMotion> TableMotion::between(const PairModel& model, const SimdModel& simd,
                                                const SimdBodyPair& bodies, int coarseness) {
  TableMotion motion(model, simd, bodies);
  const int reference = simd.references[bodies.reference].body;
  motion.collect(bodies.bodyA, reference, motion.pathA_);
  motion.collect(bodies.bodyB, reference, motion.pathB_);
  motion.path_ = motion.pathA_;
  motion.path_.insert(motion.path_.end(), motion.pathB_.begin(), motion.pathB_.end());
  if (motion.path_.empty() || motion.path_.size() > PairSeparationTable::kMostJoints ||
      !motion.setAxes(coarseness))
    return std::nullopt;
  motion.jointA_ = motion.pathA_.size() == 2 ? 1 : 0;
  motion.jointB_ = motion.pathB_.empty() || motion.path_.size() == 1 ? 0 : 1;
  motion.axisA_ = motion.axisIn(bodies.bodyA, motion.path_[motion.jointA_]);
  motion.axisB_ = motion.axisIn(bodies.bodyB, motion.path_[motion.jointB_]);
  return motion;
}

void TableMotion::collect(int body, int reference, std::vector<int>& path) const {
  for (; body != reference && body > 0; body = model_.kinematics.bodies[body].parent)
    path.push_back(body);
  std::ranges::reverse(path);
}

bool TableMotion::setAxes(int coarseness) {
  for (std::size_t k = 0; k < path_.size(); ++k) {
    const MovingBody& body = model_.kinematics.bodies[path_[k]];
    const double beyond =
        model_.tube.empty() ? 0.0 : model_.tube[static_cast<std::size_t>(path_[k])].rotation;
    double lower = body.lower - beyond;
    double upper = body.upper + beyond;
    // A full turn is all there is.
    if (body.type == JointType::Continuous) {
      upper = std::numbers::pi;
      lower = -upper;
    }
    const bool fits =
        turns(body.type) && lower >= -kTableWidest && upper <= kTableWidest && upper > lower;
    if (!fits) return false;
    // All turns are like the first.
    const int most = kCells[path_.size()] / (path_.size() == 2 ? coarseness : 1);
    const double turn = 2.0 * std::numbers::pi;
    const bool winds = upper - lower > turn;
    turn_[k] =
        winds ? std::max(1, static_cast<int>(std::lround(most * turn / (upper - lower)))) : 0;
    const double width = winds ? turn / turn_[k] : (upper - lower) / most;
    PairSeparationTable::Axis& axis = axes_[k];
    axis.body = path_[k];
    axis.lower = static_cast<float>(lower);
    axis.upper = static_cast<float>(upper);
    axis.cells = winds ? static_cast<int>(std::ceil((upper - lower) / width)) : most;
    if (!winds) turn_[k] = axis.cells;
    axis.partsPerUnit = static_cast<float>(PairSeparationTable::kParts / width);
    low_[k] = lower;
    step_[k] = width / PairSeparationTable::kParts;
  }
  return true;
}

/// A joint's axis in the frame that the balls of one of the two bodies next to it are in.
TableMotion::Line TableMotion::axisIn(int body, int joint) const {
  const MovingBody& moving = model_.kinematics.bodies[joint];
  Line axis{Vector3d::Zero(), moving.axis};
  if (joint != body) {
    axis.point = moving.parent_from_joint.translation();
    axis.direction = moving.parent_from_joint.linear() * moving.axis;
  }
  const Eigen::Matrix3d lane_from_body = simd_.bodyFromLane[body].transpose();
  return {lane_from_body * axis.point, lane_from_body * axis.direction};
}

Isometry3d TableMotion::pose(const std::vector<int>& path, const double* values) const {
  Isometry3d result = Isometry3d::Identity();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const MovingBody& body = model_.kinematics.bodies[path[i]];
    result = result * body.parent_from_joint;
    result.rotate(Eigen::AngleAxisd(values[i], body.axis));
  }
  return result;
}

TableMotion::Place TableMotion::placeOf(const Parts& parts) const {
  std::array<double, 2> middle{};
  Place place;
  for (std::size_t k = 0; k < path_.size(); ++k) {
    middle[k] = low_[k] + 0.5 * step_[k] * (parts.begin[k] + parts.end[k]);
    place.half[k] = 0.5 * step_[k] * (parts.end[k] - parts.begin[k]) + kTableValueError;
  }
  place.bodies =
      pose(pathA_, middle.data()).inverse() * pose(pathB_, middle.data() + pathA_.size());
  place.a_from_b = simd_.bodyFromLane[bodies_.bodyA].transpose() * place.bodies;
  place.a_from_b.rotate(simd_.bodyFromLane[bodies_.bodyB]);
  place.axisB = {place.a_from_b * axisB_.point, place.a_from_b.linear() * axisB_.direction};
  return place;
}

double TableMotion::travelTo(const Parts& parts, int i, int j, const Levers& levers) const {
  const std::array<int, 2> part{i, j};
  double sum = 0.0;
  for (std::size_t k = 0; k < path_.size(); ++k) {
    const int twice = std::abs(2 * part[k] + 1 - parts.begin[k] - parts.end[k]);
    sum += (0.5 * step_[k] * (twice + 1) + kTableValueError) * levers[k];
  }
  return sum * (1.0 + 1e-9);
}

double TableMotion::approach(const Place& place, const Vector3d& a, const Vector3d& b,
                             double distance, const Levers& levers) const {
  const double whole = travel(place, levers);
  if (!(distance > 0.0)) return whole;
  const Vector3d along = (b - a) / distance;
  std::array<double, 2> rate{};
  rate[jointB_] = std::abs(along.dot(place.axisB.direction.cross(b - place.axisB.point)));
  if (path_.size() == 2)
    rate[jointA_] = std::abs(along.dot(axisA_.direction.cross(a - axisA_.point)));
  double sum = 0.0;
  for (int k = 0; k < 2; ++k) {
    const double h = place.half[k];
    sum += h * std::min(levers[k], rate[k] + 0.5 * h * levers[k]);
  }
  return std::min(whole, sum * (1.0 + 1e-9));
}

}  // namespace swept::detail
