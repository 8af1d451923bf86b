// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace swept::verify {

/// The time of a segment on the clock of what moves: `clock` + (1 - t) `from` + t `to`, t from 0 to
/// 1.
struct ClockSpan {
  double clock = 0.0;           ///< s, what the clock shows at the trajectory's time 0
  double from = 0.0, to = 0.0;  ///< s, of the trajectory's points

  double timeAt(double t) const { return clock + (from + t * (to - from)); }
};

/// How a body of the world moves: its poses at times of a clock. Between two of them its origin
/// moves straight and its orientation by slerp along the shorter arc, both at constant speed.
/// Before the first and after the last it stands.
class Obstacle {
 public:
  struct Waypoint {
    double time;                     ///< s
    Eigen::Vector3d position;        ///< m
    Eigen::Quaterniond orientation;  ///< of any length but zero
  };
  /// Times increase, orientations next to each other are less than half a turn apart, and no number
  /// is above kFarthest.
  explicit Obstacle(const std::vector<Waypoint>& waypoints);

  /// Pose and velocity at a share of a segment: the point p of the body has velocity
  /// linear + angular x p, per unit of t.
  struct Placed {
    Eigen::Isometry3d world_from_body = Eigen::Isometry3d::Identity();
    Eigen::Vector3d linear = Eigen::Vector3d::Zero();
    Eigen::Vector3d angular = Eigen::Vector3d::Zero();
  };
  Placed at(const ClockSpan& span, double t) const;

  /// Bounds for all points within `reach` of the body's origin, for t within `half` of `middle`. A
  /// point p is at most half of `deviation` from p(middle) + (t - middle) p'(middle), whatever way
  /// points are passed. `extent` and `turn` count the sizes of the terms of lengths and angles.
  struct Bounds {
    double deviation = 0.0;  ///< m
    double extent = 0.0;     ///< m
    double turn = 0.0;       ///< rad
    double spin = 0.0;       ///< rad, at most turned in `half`
  };
  Bounds bounds(const ClockSpan& span, double reach, double middle, double half) const;

  double begin() const { return pieces_.front().begin; }  ///< s, the first waypoint's time
  double end() const { return pieces_.back().begin; }     ///< s, the last one's

 private:
  /// From a waypoint to the next; the last one stands.
  struct Piece {
    double begin = 0.0;                                            ///< s
    Eigen::Vector3d position = Eigen::Vector3d::Zero();            ///< m, at the begin
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< likewise
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();            ///< m/s
    Eigen::Vector3d axis = Eigen::Vector3d::UnitX();               ///< of the turn, unit
    double rate = 0.0;                                             ///< rad/s, about it
    double duration = 0.0;                                         ///< s; 0: it stands
    Eigen::Vector3d way = Eigen::Vector3d::Zero();                 ///< m, to the next waypoint
    double angle = 0.0;                                            ///< rad, likewise
  };
  struct Velocity {
    Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< m/s, of the body's origin
    Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< rad/s
  };
  /// One past the piece at a time; 0: before the first waypoint.
  std::size_t after(double time) const;
  /// Of one past a piece.
  Velocity velocityOf(std::size_t after) const;

  std::vector<Piece> pieces_;  ///< one for each waypoint
  double farthest_ = 0.0;      ///< m, of waypoints: the sums of the sizes of coordinates
  double speed_ = 0.0;         ///< m/s, the largest
  double spin_ = 0.0;          ///< rad/s, the largest
  double latest_ = 0.0;        ///< s: the largest size of a waypoint's time
};

/// Reads `waypoints` of a body: {"time": s, "position": [x, y, z], "orientation": [x, y, z, w]}.
/// Throws Refusal for none, times that do not increase, orientations about half a turn apart (which
/// way round is not told), and other keys.
Obstacle readObstacle(const nlohmann::ordered_json& json, const std::string& where);

}  // namespace swept::verify
