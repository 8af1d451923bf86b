// SPDX-License-Identifier: BSD-3-Clause
#include "obstacle.hpp"

#include <algorithm>
#include <cmath>

namespace swept::verify {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Obstacle::Obstacle(const std::vector<Waypoint>& waypoints) {
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& own = waypoints[i];
    Piece piece;
    piece.begin = own.time;
    piece.position = own.position;
    piece.rotation = own.orientation.normalized();
    if (i + 1 < waypoints.size()) {
      const Waypoint& next = waypoints[i + 1];
      piece.duration = next.time - own.time;
      piece.way = next.position - own.position;
      piece.velocity = piece.way / piece.duration;
      Quaterniond relative = next.orientation.normalized() * piece.rotation.conjugate();
      if (own.orientation.dot(next.orientation) < 0.0) relative.coeffs() = -relative.coeffs();
      if (const double sine = relative.vec().norm(); sine > 0.0) {
        piece.axis = relative.vec() / sine;
        piece.angle = 2.0 * std::atan2(sine, relative.w());
        piece.rate = piece.angle / piece.duration;
      }
    }
    farthest_ = std::max(farthest_, own.position.lpNorm<1>());
    speed_ = std::max(speed_, piece.velocity.norm());
    spin_ = std::max(spin_, piece.rate);
    latest_ = std::max(latest_, std::abs(own.time));
    pieces_.push_back(piece);
  }
}

std::size_t Obstacle::after(double time) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(pieces_, time, {}, &Piece::begin) -
                                  pieces_.begin());
}

Obstacle::Velocity Obstacle::velocityOf(std::size_t after) const {
  if (after == 0) return {};
  const Piece& piece = pieces_[after - 1];
  return {.linear = piece.velocity, .angular = piece.rate * piece.axis};
}

Obstacle::Placed Obstacle::at(const ClockSpan& span, double t) const {
  const double time = span.timeAt(t);
  const std::size_t next = after(time);
  const Piece& piece = pieces_[next == 0 ? 0 : next - 1];
  const bool moves = next > 0 && piece.duration > 0.0;
  const double share = moves ? (time - piece.begin) / piece.duration : 0.0;
  Placed placed;
  placed.world_from_body.translation() = piece.position + share * piece.way;
  placed.world_from_body.linear() =
      Eigen::AngleAxisd(share * piece.angle, piece.axis).toRotationMatrix() *
      piece.rotation.toRotationMatrix();
  const Velocity velocity = velocityOf(next);
  const double seconds = span.to - span.from;
  placed.angular = seconds * velocity.angular;
  placed.linear =
      seconds * velocity.linear - placed.angular.cross(placed.world_from_body.translation());
  return placed;
}

/// The velocity of a point at x from the body's origin, |x| <= reach, is v + w x R x. Where the
/// body has velocities v, w at a time and v0, w0 in the middle, s before or after, it differs by at
/// most |v - v0| + |w - w0| reach + |w0| |R x - R0 x|, and R x has turned by at most |s| times the
/// largest |w|. The integral over s is half of what is returned.
Obstacle::Bounds Obstacle::bounds(const ClockSpan& span, double reach, double middle,
                                  double half) const {
  const Velocity own = velocityOf(after(span.timeAt(middle)));
  const std::size_t first = after(span.timeAt(middle - half));
  const std::size_t last = after(span.timeAt(middle + half));
  double jump = 0.0, swing = 0.0, spin = own.angular.norm();
  for (std::size_t i = first; i <= last; ++i) {
    const Velocity other = velocityOf(i);
    jump = std::max(jump, (other.linear - own.linear).norm());
    swing = std::max(swing, (other.angular - own.angular).norm());
    spin = std::max(spin, other.angular.norm());
  }
  const double seconds = half * (span.to - span.from);
  const double times = std::abs(span.clock) + std::abs(span.from) + std::abs(span.to) + latest_;
  Bounds bounds;
  bounds.spin = seconds * spin;
  bounds.deviation = 2.0 * seconds * (jump + swing * reach) + bounds.spin * bounds.spin * reach;
  bounds.extent = reach + farthest_ + 4.0 * speed_ * times;
  bounds.turn = 4.0 * spin_ * times;
  return bounds;
}

}  // namespace swept::verify
