// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/knots.hpp"

#include <utility>

namespace swept::detail {

namespace {

/// The durations (s) of the parts of a change of speed, as differences of the points' times.
struct ChangeTimes {
  double rise, steady, fall;

  double duration() const { return rise + steady + fall; }
  /// The speed that is gained with an acceleration of up to 1.
  double gain() const { return 0.5 * rise + steady + 0.5 * fall; }
  /// The length beyond that of the first speed, for a gain of 1.
  double lengthPerGain() const {
    return (rise * rise / 6.0 + steady * (0.5 * rise + 0.5 * steady) +
            fall * (0.5 * rise + steady + fall / 3.0)) /
           gain();
  }
};

ChangeTimes timesOf(const WholeChange& change, Nanoseconds begin) {
  const double risen = seconds(begin + change.ramp);
  const double falls = seconds(begin + change.ramp + change.steady);
  return {risen - seconds(begin), falls - risen, seconds(begin + change.duration()) - falls};
}

/// Writes the points one after the other.
class KnotWriter {
 public:
  KnotWriter(const WayPointPath& path, const CornerSpeeds& speeds, const WholeTimes& times)
      : path_(path), speeds_(speeds), times_(times) {}

  Knots write() {
    put(path_.points.col(0), 0.0, 0.0);
    double speed = 0.0;
    for (part_ = 0; part_ < path_.parts(); ++part_) {
      if (part_ > 0) speed = writeCorner();
      writeStraight(speed);
    }
    return std::move(knots_);
  }

 private:
  /// A point on a straight part, from the nearer of its ends.
  Eigen::VectorXd at(double length) const {
    const auto part = static_cast<Eigen::Index>(part_);
    const double rest = path_.lengths[part_] - length;
    if (length < rest) return path_.points.col(part) + length * path_.directions.col(part);
    return path_.points.col(part + 1) - rest * path_.directions.col(part);
  }

  /// A point now, with speed and acceleration along the straight part.
  void put(const Eigen::VectorXd& position, double speed, double acceleration) {
    const auto direction = path_.directions.col(static_cast<Eigen::Index>(part_));
    // The sum with 0 has no -0.
    const auto assign = [&](double rate, std::vector<double>& values) {
      for (const double share : direction) values.push_back(rate * share + 0.0);
    };
    TrajectoryPoint point;
    point.time = seconds(now_);
    point.positions.assign(position.begin(), position.end());
    assign(speed, point.velocities);
    if (path_.variables.ramps) assign(acceleration, point.accelerations);
    knots_.points.push_back(std::move(point));
  }

  /// `from`: the speed at its begin.
  void writeStraight(double from) {
    const WholeProfile& profile = times_.straights[part_];
    const Nanoseconds cruise = now_ + profile.first.duration();
    const Nanoseconds braking = cruise + profile.cruise;
    const Nanoseconds end = now_ + profile.duration();
    const CornerBlend& next = speeds_.blend(part_ + 1);
    const double to = blendSpeed(next.before, end, end + times_.blends[part_ + 1]);
    const ChangeTimes first = timesOf(profile.first, now_);
    const ChangeTimes last = timesOf(profile.last, braking);
    const double cruising = seconds(braking) - seconds(cruise);
    // Solves length = from T1 + (peak - from) k1 + peak Tc + peak T2 + (to - peak) k2.
    const double k1 = first.lengthPerGain();
    const double k2 = last.lengthPerGain();
    const double peak = (speeds_.straightLength(part_) - from * (first.duration() - k1) - to * k2) /
                        (k1 + cruising + last.duration() - k2);
    double length = writeChange(profile.first, from, peak, speeds_.blend(part_).after);
    put(at(length), peak, 0.0);
    if (profile.cruise > 0) {
      now_ = braking;
      length += peak * cruising;
      put(at(length), peak, 0.0);
    }
    writeChange(profile.last, peak, to, length);
    put(at(path_.lengths[part_] - next.before), to, 0.0);
  }

  /// Its points without the first and the last one. Returns the length at its end.
  double writeChange(const WholeChange& change, double from, double to, double length) {
    const ChangeTimes times = timesOf(change, now_);
    const double peak = (to - from) / times.gain();
    const double risen = from + 0.5 * peak * times.rise;
    if (change.ramp > 0) {
      now_ += change.ramp;
      const double way = length + times.rise * (from + peak * times.rise / 6.0);
      put(at(way), risen, peak);
      if (change.steady > 0) {
        now_ += change.steady;
        put(at(way + times.steady * (risen + 0.5 * peak * times.steady)),
            risen + peak * times.steady, peak);
      }
    }
    now_ += change.ramp > 0 ? change.ramp : change.steady;
    return length + from * times.duration() + (to - from) * times.lengthPerGain();
  }

  /// The speed at the end of a blend that has this length.
  static double blendSpeed(double length, Nanoseconds begin, Nanoseconds end) {
    return begin == end ? 0.0 : 2.0 * length / (seconds(end) - seconds(begin));
  }

  /// The end of the blend before the straight part. Returns the speed there.
  double writeCorner() {
    const CornerBlend& blend = speeds_.blend(part_);
    const Nanoseconds end = now_ + times_.blends[part_];
    knots_.corners.push_back({path_.indices[part_], blend.before, blend.after,
                              speeds_.shape(part_).deviation(blend), seconds(now_), seconds(end)});
    const double speed = blendSpeed(blend.after, now_, end);
    if (blend.stops()) return speed;
    now_ = end;
    put(at(blend.after), speed, 0.0);
    return speed;
  }

  const WayPointPath& path_;
  const CornerSpeeds& speeds_;
  const WholeTimes& times_;
  std::size_t part_ = 0;
  Nanoseconds now_ = 0;
  Knots knots_;
};

}  // namespace

Knots knotsOf(const WayPointPath& path, const CornerSpeeds& speeds, const WholeTimes& times) {
  return KnotWriter(path, speeds, times).write();
}

}  // namespace swept::detail
