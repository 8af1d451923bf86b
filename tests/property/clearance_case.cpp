// SPDX-License-Identifier: BSD-3-Clause
#include "clearance_case.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "certify/workspace_data.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d wayAt(const std::vector<swept::MovingObstacle::Waypoint>& way, double time) {
  if (time <= way.front().time) return way.front().world_from_body;
  for (std::size_t i = 1; i < way.size(); ++i) {
    if (time > way[i].time) continue;
    const auto& [begin, first] = way[i - 1];
    const auto& [end, second] = way[i];
    const double t = (time - begin) / (end - begin);
    Isometry3d pose = Isometry3d::Identity();
    pose.translation() = (1.0 - t) * first.translation() + t * second.translation();
    const Eigen::Quaterniond turn(first.linear());
    pose.linear() = turn.slerp(t, Eigen::Quaterniond(second.linear())).toRotationMatrix();
    return pose;
  }
  return way.back().world_from_body;
}

}  // namespace

const ClearanceCase::Body& ClearanceCase::find(const std::string& name, bool ofRobot) const {
  const std::vector<Body>& bodies = ofRobot ? robot_ : world_;
  const auto found = std::ranges::find(bodies, name, &Body::name);
  if (found == bodies.end()) throw std::runtime_error("no body " + name);
  return *found;
}

std::vector<double> ClearanceCase::full(const std::vector<double>& q) const {
  std::vector<double> values(arm_->variables().size());
  for (std::size_t i = 0; i < place_.size(); ++i)
    values[static_cast<std::size_t>(place_[i])] = q[i];
  return values;
}

Isometry3d ClearanceCase::poseOf(const Body& body, const std::vector<double>& q,
                                 const std::vector<Isometry3d>& links) const {
  if (!body.link.empty()) return links[static_cast<std::size_t>(arm_->link(body.link))];
  const auto way = ways_.find(body.name);
  return way == ways_.end() ? Isometry3d::Identity() : wayAt(way->second, q.back());
}

template <typename Measure>
ClearanceCase::Least ClearanceCase::least(const std::vector<double>& q, std::optional<bool> self,
                                          const Measure& measure) const {
  std::vector<Isometry3d> links;
  arm_->poses(full(q), links);
  Least least;
  for (const swept::Checker::Pair& pair : checker_->checkedPairs()) {
    if (self && pair.selfPair != *self) continue;
    const Body& a = find(pair.bodyA, true);
    const Body& b = find(pair.bodyB, pair.selfPair);
    const Isometry3d a_from_b = poseOf(a, q, links).inverse() * poseOf(b, q, links);
    for (std::size_t i = 0; i < a.parts.size(); ++i)
      for (std::size_t k = 0; k < b.parts.size(); ++k) {
        const Part& first = a.parts[i];
        const Part& second = b.parts[k];
        const double gap = (a_from_b * second.center - first.center).norm();
        if (gap - first.radius - second.radius > std::max(0.0, least.upper)) continue;
        const auto found =
            measure(first.shape, second.shape,
                    first.body_from_shape.inverse() * a_from_b * second.body_from_shape);
        least.lower = std::min(least.lower, found.lower);
        if (!(found.upper < least.upper)) continue;
        least.upper = found.upper;
        least.bodyA = pair.bodyA;
        least.bodyB = pair.bodyB;
        least.outOfReach =
            !pair.selfPair && !ways_.contains(pair.bodyB) &&
            !listed_.contains({a.name, static_cast<int>(i), b.name, static_cast<int>(k)});
      }
  }
  return least;
}

ClearanceCase::Least ClearanceCase::distanceAt(const std::vector<double>& q,
                                               std::optional<bool> self) const {
  return least(q, self, [](const auto& a, const auto& b, const Isometry3d& a_from_b) {
    return swept::distance(a, b, a_from_b);
  });
}

ClearanceCase::Least ClearanceCase::signedDistanceAt(const std::vector<double>& q) const {
  return least(q, std::nullopt, [](const auto& a, const auto& b, const Isometry3d& a_from_b) {
    return swept::signedDistance(a, b, a_from_b);
  });
}

double ClearanceCase::distanceOf(const std::string& bodyA, const std::string& bodyB, bool selfPair,
                                 const std::vector<double>& q) const {
  std::vector<Isometry3d> links;
  arm_->poses(full(q), links);
  const Body& a = find(bodyA, true);
  const Body& b = find(bodyB, selfPair);
  const Isometry3d a_from_b = poseOf(a, q, links).inverse() * poseOf(b, q, links);
  double least = std::numeric_limits<double>::infinity();
  for (const Part& first : a.parts)
    for (const Part& second : b.parts)
      least = std::min(least, swept::distance(first.shape, second.shape,
                                              first.body_from_shape.inverse() * a_from_b *
                                                  second.body_from_shape)
                                  .upper);
  return least;
}

std::vector<double> ClearanceCase::between(const std::vector<double>& from,
                                           const std::vector<double>& to, double t) const {
  const std::vector<double> whole = arm_->between(full(from), full(to), t);
  std::vector<double> q;
  for (const int i : place_) q.push_back(whole[static_cast<std::size_t>(i)]);
  if (!ways_.empty()) q.push_back(from.back() + t * (to.back() - from.back()));
  return q;
}

void ClearanceCase::findListed() {
  const auto model = swept::detail::compileChecker(
      loaded_, checker_->group(), std::make_shared<const swept::World>(built_), options_);
  for (std::size_t i = 0; i < model->worldPairs.size(); ++i) {
    const swept::detail::GeometryPair pair = model->pair(i);
    const auto& geometry = model->robotGeometry[static_cast<std::size_t>(pair.a)];
    const auto& other = model->worldGeometry[static_cast<std::size_t>(pair.b)];
    listed_.emplace(model->nameOfA(pair), geometry.piece, model->nameOfB(pair), other.part);
  }
}
