// SPDX-License-Identifier: BSD-3-Clause
// A point or a direction of one link is seen from another one: x(u) = R^T (p - o), where R and o
// are the observer's rotation and origin, and u goes from the middle of an interval to any of its
// times and errors (see Bounds). At u = 0 its rate is R^T (velocity of p - velocity of the
// observer's point there): for all s, |s| <= h, and all errors, a sum of segments [-1, 1] w.
//
// For any constant unit vector d, d . x = (R d) . (p - o). With |(R d)'| <= W and |(R d)''| <= W^2
// + B (W: Bounds::spin, B: Bounds::bend), |p - o| <= r, |p'| <= s_p and so on,
//   |x''| <= a_p + a_o + r (W^2 + B) + 2 W (s_p + s_o),
// and for a direction, with V and C of the link that carries it, |x''| <= (V + W)^2 + B + C. So all
// x are in the sum of x(0), the segments, and a ball of half of this.
#include "constraint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "encoding.hpp"
#include "rounding.hpp"

namespace swept::verify {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Times that an interval is halved, and intervals of one constraint and segment, at most.
constexpr int kMostHalvings = 40;
/// rad or m. A joint's value may be off its range by as much, as it may be beyond its limits.
constexpr double kBesideRange = 1e-5;
constexpr std::size_t kMostIntervals = 1'000'000;

/// Where a vector may be: in `middle` + the sum of all [-1, 1] way + a ball of radius `beyond`.
struct Seen {
  Vector3d middle = Vector3d::Zero();
  std::vector<Vector3d> ways = {};
  double beyond = 0.0;

  /// At most so far from `middle` along a unit vector.
  double along(const Vector3d& n) const {
    double most = beyond;
    for (const Vector3d& way : ways) most += std::abs(n.dot(way));
    return most;
  }
  /// The same of a part of the vector, given by a projection.
  double spreadOf(const Matrix3d& part) const {
    double most = beyond;
    for (const Vector3d& way : ways) most += (part * way).norm();
    return most;
  }
  double least(const Matrix3d& part) const { return (part * middle).norm() - spreadOf(part); }
  /// The first way is not added but followed: norms are convex.
  double largest(const Matrix3d& part) const {
    const Vector3d first = part * ways.front();
    const Vector3d from = part * middle;
    return std::max((from + first).norm(), (from - first).norm()) + spreadOf(part) - first.norm();
  }
};

/// Two links in an interval, as each constraint between their frames needs them.
class Observed {
 public:
  Observed(const Model& model, const Motion& motion, int link, int observer, double middle,
           double half)
      : motion_(motion),
        link_(link),
        observer_(observer),
        reference_(commonAncestor(model, link, observer)),
        middle_(middle),
        half_(half),
        carrier_(motion.at(link, reference_, middle, half)),
        seer_(motion.at(observer, reference_, middle, half)) {}

  /// The origin of `frame` in `reference`. `size`: m, what else the numbers are made of.
  Seen point(const Frame& frame, const Eigen::Isometry3d& observer_from_reference,
             double size) const {
    const Vector3d& local = frame.link_from_frame.translation();
    const Vector3d& origin = observer_from_reference.translation();
    const Bounds of = motion_.bounds(link_, reference_, local.norm(), middle_, half_);
    const Bounds by = motion_.bounds(observer_, reference_, origin.norm(), middle_, half_);
    const Vector3d p = carrier_.reference_from_link * local;
    const Vector3d o = seer_.reference_from_link * origin;
    const Matrix3d turn =
        (seer_.reference_from_link.linear() * observer_from_reference.linear()).transpose();
    Seen seen{.middle = turn * (p - o)};
    seen.ways.push_back(turn * (half_ * (carrier_.linear + carrier_.angular.cross(p) -
                                         seer_.linear - seer_.angular.cross(p))));
    for (const Placed* placed : {&carrier_, &seer_})
      for (const Play& play : placed->plays) {
        const Vector3d arm = p - play.origin;
        seen.ways.push_back(turn * play.turn.cross(arm));
        seen.ways.push_back(turn * (std::max(play.forward, play.backward) * play.axis));
        seen.beyond += play.slideAnywhere + play.turnAnywhere * arm.norm();
      }
    const double radius = (p - o).norm() + of.speed + by.speed;
    seen.beyond +=
        0.5 * (of.acceleration + by.acceleration + radius * (by.spin * by.spin + by.bend) +
               2.0 * by.spin * (of.speed + by.speed)) +
        rounding(of, by, of.extent + by.extent + local.norm() + size);
    return seen;
  }

  /// A unit vector in the frame of the link, as the observer's frame sees it.
  Seen direction(const Vector3d& direction, const Matrix3d& observer_from_reference) const {
    const Vector3d d = carrier_.reference_from_link.linear() * direction;
    const Matrix3d turn =
        (seer_.reference_from_link.linear() * observer_from_reference).transpose();
    const auto [of, by] = turns();
    Seen seen{.middle = turn * d};
    seen.ways.push_back(turn * (half_ * (carrier_.angular - seer_.angular).cross(d)));
    for (const Placed* placed : {&carrier_, &seer_})
      for (const Play& play : placed->plays) {
        seen.ways.push_back(turn * play.turn.cross(d));
        seen.beyond += play.turnAnywhere;
      }
    const double spin = of.spin + by.spin;
    seen.beyond += 0.5 * (spin * spin + of.bend + by.bend) + rounding(of, by, 1.0);
    return seen;
  }

  /// v is the rotation vector of R desired^-1 (see Turned). With a constant spin w, v(s) is within
  /// l k (s |w|)^2 / 2 of v + s J w, J = 1 - [v] / 2 + c [v]^2; where the spin changes, and for
  /// what turns about an unknown axis, R is off by an angle, and v by k times this. k is at most
  /// pi / 2 and l k / 2 at most 1.03 where |v| <= pi, and 2.2 and 2.14 where |v| <= 4. (F. Bullo
  /// and R. Murray, Proportional derivative control on the Euclidean group, 1995.)
  Seen rotationVector(const Turned& own) const {
    const Matrix3d turn =
        (seer_.reference_from_link.linear() * own.reference.link_from_frame.linear()).transpose();
    const Matrix3d rotation = turn * carrier_.reference_from_link.linear() *
                              own.frame.link_from_frame.linear() *
                              own.desired.conjugate().toRotationMatrix();
    const Quaterniond q(rotation);
    const Vector3d part = std::copysign(1.0, q.w()) * q.vec();
    const double sine = part.norm();
    const double angle = 2.0 * std::atan2(sine, std::abs(q.w()));
    const auto [of, by] = turns();
    Seen seen{.middle = sine > 0.0 ? Vector3d(angle / sine * part) : Vector3d::Zero()};
    const Vector3d v = seen.middle;
    // 1 - x cot x for a small x is a difference of large numbers.
    const double x = 0.5 * angle;
    const double c = angle < 0.01 ? 1.0 / 12.0 + angle * angle / 720.0
                                  : (1.0 - x / std::tan(x)) / (angle * angle);
    double all = 0.0, unknown = 0.0;
    const auto add = [&](const Vector3d& spin) {
      const Vector3d across = v.cross(spin);
      seen.ways.push_back(spin - 0.5 * across + c * v.cross(across));
      all += spin.norm();
    };
    add(turn * (half_ * (carrier_.angular - seer_.angular)));
    for (const Placed* placed : {&carrier_, &seer_})
      for (const Play& play : placed->plays) {
        add(turn * play.turn);
        unknown += play.turnAnywhere;
      }
    all += unknown;
    const double spin = of.spin + by.spin;
    unknown += 0.5 * (0.5 * spin * spin + of.bend + by.bend) + rounding(of, by, 1.0);
    const double largest = angle + all + unknown;
    const bool isShort = largest <= kPi;
    seen.beyond = (isShort ? 0.5 * kPi : 2.2) * unknown + (isShort ? 1.03 : 2.14) * all * all;
    if (!(largest <= 4.0)) seen.beyond = kInfinity;
    return seen;
  }

 private:
  /// Of the rotations alone.
  std::pair<Bounds, Bounds> turns() const {
    return {motion_.bounds(link_, reference_, 0.0, middle_, half_),
            motion_.bounds(observer_, reference_, 0.0, middle_, half_)};
  }

  /// ROUNDING.md, "Constraints". `size`: m, or 1 for directions.
  static double rounding(const Bounds& of, const Bounds& by, double size) {
    const double turn = 1.0 + of.turn + by.turn;
    if (!(turn <= kLargest && size <= kLargest)) return kInfinity;
    return kSeenRounding * (of.joints + by.joints + 8) * turn * (1.0 + of.spin + by.spin) * size +
           kUnderflow;
  }

  const Motion& motion_;
  int link_, observer_, reference_;
  double middle_, half_;
  Placed carrier_, seer_;
};

/// Whether a constraint is shown to hold at all times within `half` of `middle`.
class Interval {
 public:
  Interval(const Model& model, const Motion& motion, double middle, double half)
      : model_(model), motion_(motion), middle_(middle), half_(half) {}

  /// NaN shows nothing.
  bool holds(const JointRange& own) const {
    const Joint& joint = model_.joints[own.joint];
    const Course& course = motion_.course(own.joint, own.value);
    const Around<double> here = around(course.curve, middle_, half_);
    const bool turns =
        joint.kind == JointKind::Revolute || (joint.kind == JointKind::Planar && own.value == 2);
    const double spread =
        here.range + (turns ? joint.tolerance.rotation : joint.tolerance.translation) +
        kRounding * (std::max(course.begin, course.end) + here.speed + std::abs(own.position)) +
        kUnderflow;
    double off = here.value - own.position;
    double above = own.above + kBesideRange, below = own.below + kBesideRange;
    if (own.cyclic) {
      if (own.above >= kPi && own.below >= kPi) return true;
      off = std::remainder(off, 2.0 * kPi);
      above = std::min(above, kPi);
      below = std::min(below, kPi);
    }
    return off + spread <= above && off - spread >= -below;
  }

  bool holds(const Regions& own) const {
    const Observed observed = between(own.frame, own.reference);
    return std::ranges::any_of(own.regions, [&](const Regions::Region& region) {
      const double size = own.reference.link_from_frame.translation().norm() +
                          region.reference_from_region.translation().norm();
      return staysIn(
          region,
          observed.point(own.frame, own.reference.link_from_frame * region.reference_from_region,
                         size));
    });
  }

  /// With z the frame's z axis in the desired one, and x the desired x axis in the frame: z = (sin
  /// b, -sin a cos b, cos a cos b) and x = (cos b cos c, -cos b sin c, sin b).
  bool holds(const Turned& own) const {
    if (own.asVector) {
      if (own.most.minCoeff() >= kPi) return true;
      const Seen v = between(own.frame, own.reference).rotationVector(own);
      for (Eigen::Index i = 0; i < 3; ++i)
        if (own.most[i] < kPi &&
            !(std::abs(v.middle[i]) + v.along(Vector3d::Unit(i)) <= own.most[i]))
          return false;
      return true;
    }
    const Matrix3d desired = own.desired.toRotationMatrix();
    const Matrix3d& frame = own.frame.link_from_frame.linear();
    const Matrix3d& reference = own.reference.link_from_frame.linear();
    const Seen z = between(own.frame, own.reference).direction(frame.col(2), reference * desired);
    const Seen x = between(own.reference, own.frame).direction(reference * desired.col(0), frame);
    const bool second =
        own.most.y() >= 0.5 * kPi ||
        std::abs(z.middle.x()) + z.along(Vector3d::UnitX()) <= std::sin(own.most.y());
    return second && angleWithin(own.most.x(), z, 2) && angleWithin(own.most.z(), x, 0);
  }

  bool holds(const Tilted& own) const {
    if (own.most >= kPi) return true;
    const Seen axis = between(own.frame, own.reference)
                          .direction(own.frame.link_from_frame.linear() * own.axis,
                                     own.reference.link_from_frame.linear());
    const double lowest = axis.middle.dot(own.direction) - axis.along(own.direction);
    const Matrix3d across = Matrix3d::Identity() - own.direction * own.direction.transpose();
    // The sine tells small angles apart, and the cosine those near a right angle.
    if (lowest >= std::cos(own.most)) return true;
    return own.most <= 0.5 * kPi ? lowest > 0.0 && axis.largest(across) <= std::sin(own.most)
                                 : axis.least(across) >= std::sin(own.most);
  }

 private:
  Observed between(const Frame& frame, const Frame& reference) const {
    return {model_, motion_, frame.link, reference.link, middle_, half_};
  }

  static bool staysIn(const Regions::Region& region, const Seen& point) {
    const auto within = [&](Eigen::Index i, double half) {
      return std::abs(point.middle[i]) + point.along(Vector3d::Unit(i)) <= half;
    };
    switch (region.type) {
      case Regions::Type::Box:
        return within(0, 0.5 * region.size[0]) && within(1, 0.5 * region.size[1]) &&
               within(2, 0.5 * region.size[2]);
      case Regions::Type::Sphere:
        return point.largest(Matrix3d::Identity()) <= region.size[0];
      case Regions::Type::Cylinder:
        return point.largest(Vector3d(1.0, 1.0, 0.0).asDiagonal()) <= region.size[0] &&
               within(2, 0.5 * region.size[1]);
    }
    return false;
  }

  /// The angle t of a direction (.., -sin t cos b, cos t cos b), whose coordinate `cosine` has the
  /// cosine. Products with the unit vectors (.., -+cos m, sin m) are cos b sin(m +- t): with m <=
  /// pi / 2 both are above zero where |t| < m, and with a larger m one of them is.
  static bool angleWithin(double most, const Seen& direction, Eigen::Index cosine) {
    if (most >= kPi) return true;
    int above = 0;
    for (const double side : {-1.0, 1.0}) {
      Vector3d normal = Vector3d::Zero();
      normal.y() = side * std::cos(most);
      normal[cosine] = std::sin(most);
      above += normal.dot(direction.middle) - direction.along(normal) > 0.0 ? 1 : 0;
    }
    return above >= (most <= 0.5 * kPi ? 2 : 1);
  }

  const Model& model_;
  const Motion& motion_;
  double middle_, half_;
};

class Halving {
 public:
  Halving(const std::function<bool(double, double)>& holds, const std::string& place)
      : holds_(holds), place_(place) {}

  std::size_t run() {
    show(0.0, 1.0, 0);
    return intervals_;
  }

 private:
  void show(double begin, double end, int halvings) {
    const double middle = 0.5 * (begin + end);
    if (holds_(middle, 0.5 * (end - begin))) {
      ++intervals_;
      return;
    }
    if (!holds_(middle, 0.0))
      throw Refusal(place_ + ": not shown at " + numberText(middle, 6) + " of the segment");
    if (halvings == kMostHalvings || intervals_ == kMostIntervals)
      throw Refusal(place_ + ": not shown around " + numberText(middle, 6) + " of the segment");
    show(begin, middle, halvings + 1);
    show(middle, end, halvings + 1);
  }

  const std::function<bool(double, double)>& holds_;
  const std::string& place_;
  std::size_t intervals_ = 0;
};

}  // namespace

std::size_t showByHalving(const std::function<bool(double, double)>& holds,
                          const std::string& place) {
  return Halving(holds, place).run();
}

std::size_t checkConstraint(const Model& model, const Motion& motion, const Constraint& constraint,
                            const std::string& place) {
  const auto holds = [&](double middle, double half) {
    const Interval interval(model, motion, middle, half);
    return std::visit([&](const auto& own) { return interval.holds(own); }, constraint.what);
  };
  return showByHalving(holds, place);
}

}  // namespace swept::verify
