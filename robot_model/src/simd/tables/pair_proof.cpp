// SPDX-License-Identifier: BSD-3-Clause
#include "simd/tables/pair_proof.hpp"

#include <algorithm>
#include <cmath>

#include "model/pair_model.hpp"
#include "rounding/error_model.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/solid_depth.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// m. Regions in which points travel more than this are not compared exactly. One such comparison
/// counts as many distances of balls, and so does each of its steps.
constexpr double kExactTravel = 0.02;
constexpr int kExactWork = 50;
constexpr int kStepWork = 8;
/// Relative to the travel of points where balls are not proven apart: others may travel as much.
constexpr double kMoreTravel = 1.25;
/// Relative to the travel of points: accuracy of distances.
constexpr double kTolerance = 0.25;
/// Relative to the travel of points: balls that overlap by more than this have a contact in most of
/// a region.
constexpr double kMeetingTravel = 0.5;
/// Number of pairs of balls that the search for close points splits.
constexpr int kMostLooks = 24;

using InnerBall = PairSeparationTable::InnerBall;

template <typename Ball>
Vector3d centerOf(const Ball& ball) {
  return {ball.center[0], ball.center[1], ball.center[2]};
}

}  // namespace

PairSeparationTable::InnerBall innerBall(const SimdNode& node) {
  return {{node.center[0], node.center[1], node.center[2]}, node.inside};
}

PairSeparationTable::InnerBall innerBallAround(const PairModel& model, const SimdModel& simd,
                                               int geometry, const Eigen::Vector3d& center) {
  const RobotGeometry& body = model.robotGeometry[static_cast<std::size_t>(geometry)];
  PairSeparationTable::InnerBall ball;
  for (int k = 0; k < 3; ++k) ball.center[k] = static_cast<float>(center[k]);
  const Eigen::Vector3d inShape = body.body_from_shape.inverse() *
                                  (simd.bodyFromLane[static_cast<std::size_t>(body.body)] * center);
  const double depth = solidDepth(body.shape, inShape);
  const double magnitude = center.norm() + inShape.norm();
  ball.inside = static_cast<float>(
      std::max(0.0, (depth - kInnerBallShare * magnitude) * (1.0 - kInnerBallShare)));
  return ball;
}

PairProof::PairProof(const PairModel& model, const SimdModel& simd, const SimdBodyPair& bodies,
                     const TableMotion& motion)
    : model_(model), simd_(simd), motion_(motion) {
  whole_ = motion_.combine(widest(simd_.rootOfBody[bodies.bodyA], true),
                           widest(simd_.rootOfBody[bodies.bodyB], false));
}

/// m; of the centres of the balls of a tree from the axis next to their body.
double PairProof::widest(std::int32_t node, bool ofA) const {
  const SimdNode& ball = simd_.nodes[node];
  double most = ofA ? motion_.leverOfA(centerOf(ball)) : motion_.leverOfB(centerOf(ball));
  for (std::int32_t i = 0; i < ball.childCount; ++i)
    most = std::max(most, widest(ball.firstChild + i, ofA));
  return most;
}

void PairProof::choose(const PairSeparationTable::Geometries& pair) {
  if (pair.a == geometryA_ && pair.b == geometryB_) return;
  geometryA_ = pair.a;
  geometryB_ = pair.b;
  margin_ = pair.margin;
  slack_ = margin_ + kTableShare * static_cast<double>(simd_.reach);
  stopped_ = {-1, -1};
  meetingOfA_ = meetingOfB_ = {};
  guess_.setZero();
}

PairProof::Balls PairProof::roots() const {
  return {simd_.rootOfGeometry[geometryA_], simd_.rootOfGeometry[geometryB_]};
}

bool PairProof::apartByBalls(const Place& place) {
  meeting_ = 0.0;
  certain_ = false;
  // Where the last region was stopped is where this one probably is.
  const Balls last = stopped_;
  return (last.a < 0 || apart(place, last)) && apart(place, roots());
}

PairProof::Look PairProof::lookAt(const Place& place, const Balls& balls) const {
  const SimdNode& a = simd_.nodes[balls.a];
  const SimdNode& b = simd_.nodes[balls.b];
  const Vector3d atA = centerOf(a);
  const Vector3d inB = centerOf(b);
  const Vector3d atB = place.a_from_b * inB;
  return {a, b, atA, inB, atB, (atB - atA).norm()};
}

PairProof::Split PairProof::split(const Balls& balls) const {
  const SimdNode& a = simd_.nodes[balls.a];
  const SimdNode& b = simd_.nodes[balls.b];
  const bool ofA = a.childCount > 0 && (b.childCount == 0 || a.radius >= b.radius);
  const SimdNode& parent = ofA ? a : b;
  return {balls, ofA, parent.firstChild, parent.childCount};
}

/// False as soon as two balls that are small compared to the travel are not proven apart;
/// `stopped_` are these. `gap_`, which is at most the distance of the geometries in the middle
/// minus the slack, proves those whose points travel less.
bool PairProof::apart(const Place& place, const Balls& balls) {
  --work;
  const auto [a, b, atA, inB, atB, between] = lookAt(place, balls);
  const double gap =
      between - static_cast<double>(a.radius) - static_cast<double>(b.radius) - slack_;
  if (gap > TableMotion::travel(place, whole_)) return true;
  const Levers levers = motion_.levers(atA, inB);
  const double travel = motion_.approach(place, atA, atB, between, levers);
  if (gap > travel || staysWithinGap(place, atA, inB, a.radius, b.radius)) return true;
  const bool solid = a.inside > 0.0F && b.inside > 0.0F;
  if (solid && noteMeeting(place, innerBall(a), innerBall(b))) {
    stopped_ = balls;
    return false;
  }
  const Split next = split(balls);
  const bool fine = static_cast<double>(a.beyond + b.beyond) < 0.5 * travel;
  if (next.count == 0 || fine || work <= 0) {
    stopped_ = balls;
    return false;
  }
  for (std::int32_t i = 0; i < next.count; ++i)
    if (!apart(place, next.child(i))) return false;
  return true;
}

bool PairProof::staysWithinGap(const Place& place, const Vector3d& a, const Vector3d& b,
                               float radiusA, float radiusB) const {
  if (!(gap_ > 0.0)) return false;
  const Levers levers =
      motion_.levers(a, b, static_cast<double>(radiusA), static_cast<double>(radiusB));
  return TableMotion::travel(place, levers) < gap_;
}

/// Whether balls inside the links meet for all values in the region.
bool PairProof::noteMeeting(const Place& place, const InnerBall& a, const InnerBall& b) {
  const Vector3d atA = centerOf(a);
  const Vector3d inB = centerOf(b);
  const double between = (place.a_from_b * inB - atA).norm();
  const double overlap = static_cast<double>(a.inside + b.inside) - between - slack_;
  if (overlap > meeting_) {
    meeting_ = overlap;
    meetingOfA_ = a;
    meetingOfB_ = b;
  }
  const bool always = overlap > TableMotion::travel(place, motion_.levers(atA, inB));
  certain_ = certain_ || always;
  return always;
}

/// If those that met in the last region also meet in this one, no others are needed.
void PairProof::noteLastMeeting(const Place& place) {
  if (!(meetingOfA_.inside > 0.0F) || meeting_ > 0.0) return;
  noteMeeting(place, InnerBall(meetingOfA_), InnerBall(meetingOfB_));
}

void PairProof::findMeeting(const Place& place, const Compared& found) {
  if (meeting_ > kMeetingTravel * TableMotion::travel(place, whole_)) return;
  const SimdModel::InnerBalls& ofA = simd_.innerBalls[geometryA_];
  const SimdModel::InnerBalls& ofB = simd_.innerBalls[geometryB_];
  double most = meeting_ > 0.0 ? meeting_ : -static_cast<double>(simd_.reach);
  Vector3d between = Vector3d::Zero();
  Vector3d middleA = Vector3d::Zero();
  Vector3d middleB = Vector3d::Zero();
  for (std::int32_t b = ofB.first; b < ofB.first + ofB.count; ++b) {
    const SimdNode& ballB = simd_.nodes[b];
    const Vector3d at = place.a_from_b * centerOf(ballB);
    for (std::int32_t a = ofA.first; a < ofA.first + ofA.count; ++a) {
      const SimdNode& ballA = simd_.nodes[a];
      const Vector3d towards = at - centerOf(ballA);
      const double reach = static_cast<double>(ballA.inside + ballB.inside) - slack_;
      const double squared = towards.squaredNorm();
      if (!(reach > most && squared < (reach - most) * (reach - most))) continue;
      const double distance = std::sqrt(squared);
      most = reach - distance;
      const double share = (static_cast<double>(ballA.inside) - 0.5 * most) / distance;
      between = centerOf(ballA) + std::clamp(share, 0.0, 1.0) * towards;
      middleA = centerOf(ballA);
      middleB = at;
      if (!(most > meeting_)) continue;
      meeting_ = most;
      meetingOfA_ = innerBall(ballA);
      meetingOfB_ = innerBall(ballB);
    }
  }
  // Covers have few balls near the surface, where bodies that are hardly in contact meet.
  if (meeting_ > 0.0 || ofA.count == 0 || ofB.count == 0) return;
  if (found.touching && !found.point.isZero(0.0)) findAround(place, found.point, middleA, middleB);
  if (!(meeting_ > 0.0)) findAround(place, between, middleA, middleB);
}

/// The balls around a point (m, A's lane frame). A point on the surface of either body is moved
/// towards the middle of that body, by at most the room that the other body has around it.
void PairProof::findAround(const Place& place, const Vector3d& point, const Vector3d& middleA,
                           const Vector3d& middleB) {
  work -= 2 * kExactWork;
  const Eigen::Isometry3d b_from_a = place.a_from_b.inverse();
  InnerBall a = innerBallAround(model_, simd_, geometryA_, point);
  InnerBall b = innerBallAround(model_, simd_, geometryB_, b_from_a * point);
  const auto moved = [&](const InnerBall& other, const Vector3d& middle) -> Vector3d {
    const Vector3d towards = middle - point;
    return point + 0.5 * static_cast<double>(other.inside) * towards.normalized();
  };
  if (a.inside > 0.0F && !(b.inside > 0.0F))
    b = innerBallAround(model_, simd_, geometryB_, b_from_a * moved(a, middleB));
  if (b.inside > 0.0F && !(a.inside > 0.0F))
    a = innerBallAround(model_, simd_, geometryA_, moved(b, middleA));
  if (a.inside > 0.0F && b.inside > 0.0F) noteMeeting(place, a, b);
}

TableMotion::Levers PairProof::closeLevers(const Place& place) {
  close_ = {0.0, 0.0};
  looks_ = kMostLooks;
  findLevers(place, roots());
  return close_;
}

void PairProof::findLevers(const Place& place, const Balls& balls) {
  --work;
  const auto [a, b, atA, inB, atB, between] = lookAt(place, balls);
  const double radiusA = static_cast<double>(a.radius);
  const double radiusB = static_cast<double>(b.radius);
  const Levers levers = motion_.levers(atA, inB);
  if (between - radiusA - radiusB - slack_ > motion_.approach(place, atA, atB, between, levers))
    return;
  Levers all = motion_.levers(atA, inB, radiusA, radiusB);
  for (int k = 0; k < 2; ++k) all[k] = std::max(close_[k], all[k]);
  if (all == close_) return;
  const Split next = split(balls);
  if (next.count == 0 || --looks_ < 0) {
    close_ = all;
    return;
  }
  for (std::int32_t i = 0; i < next.count; ++i) findLevers(place, next.child(i));
}

PairProof::Compared PairProof::compare(const Place& place, double contact, double travel) {
  const RobotGeometry& a = model_.robotGeometry[geometryA_];
  const RobotGeometry& b = model_.robotGeometry[geometryB_];
  DistanceOptions options;
  options.enough = travel + slack_;
  options.contact = contact;
  options.tolerance = kTolerance * (travel + slack_);
  options.guess = guess_;
  const DistanceResult found = distance(
      a.shape, b.shape, a.body_from_shape.inverse() * place.bodies * b.body_from_shape, options);
  work -= kExactWork + kStepWork * found.iterations;
  guess_ = found.normal;
  const Vector3d point = a.body_from_shape * found.pointA;
  return {true, found.upper <= margin_, found.lower - slack_,
          simd_.bodyFromLane[a.body].transpose() * point};
}

PairProof::Compared PairProof::compareWhereStopped(const Place& place, bool single) {
  noteLastMeeting(place);
  if (meeting_ > 0.0) return {true, true, 0.0, Vector3d::Zero()};
  const SimdNode& a = simd_.nodes[stopped_.a];
  const SimdNode& b = simd_.nodes[stopped_.b];
  const Levers levers = motion_.levers(centerOf(a), centerOf(b), static_cast<double>(a.radius),
                                       static_cast<double>(b.radius));
  const double travel = TableMotion::travel(place, levers);
  if (!(travel <= kExactTravel)) return {};
  // Contact matters only where it is recorded.
  const double contact = single ? margin_ : travel + slack_;
  return compare(place, contact, kMoreTravel * travel);
}

bool PairProof::apartWithin(const Place& place, double gap) {
  if (!(gap > 0.0)) return false;
  gap_ = gap;
  const Balls last = stopped_;
  const bool proven = apart(place, last) && apart(place, roots());
  gap_ = 0.0;
  return proven;
}

}  // namespace swept::detail
