// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "kinematics/motion_model.hpp"

/// Kinematics in 50 digits, for what the library computes in 16 and in 7. Numbers that the library
/// starts from are taken as they are.
namespace swept::exact_test {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                             boost::multiprecision::et_off>;

struct Exact3 {
  std::array<Digits, 3> at{};

  const Digits& operator[](std::size_t i) const { return at[i]; }
  Digits& operator[](std::size_t i) { return at[i]; }
};

inline Exact3 operator+(const Exact3& a, const Exact3& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
inline Exact3 operator-(const Exact3& a, const Exact3& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
inline Exact3 operator*(const Digits& s, const Exact3& a) {
  return {{s * a[0], s * a[1], s * a[2]}};
}
inline Digits dot(const Exact3& a, const Exact3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Exact3 cross(const Exact3& a, const Exact3& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
inline Digits norm(const Exact3& a) {
  return sqrt(dot(a, a));
}
inline Exact3 exact(const Eigen::Vector3d& v) {
  return {{Digits(v[0]), Digits(v[1]), Digits(v[2])}};
}
inline Eigen::Vector3d rounded(const Exact3& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}
/// How far the point at s = -1 ... 1 on the segment x +- g is from p, at least.
inline Digits distanceFromSegment(const Exact3& p, const Exact3& x, const Exact3& g) {
  const Exact3 y = x - p;
  const Digits squared = dot(g, g);
  Digits s = squared > 0 ? Digits(-dot(y, g) / squared) : Digits(0);
  if (s > 1) s = 1;
  if (s < -1) s = -1;
  return norm(y + s * g);
}

/// x -> rows x + origin.
struct ExactPose {
  std::array<Exact3, 3> rows{Exact3{{1, 0, 0}}, Exact3{{0, 1, 0}}, Exact3{{0, 0, 1}}};
  Exact3 origin;

  Exact3 turned(const Exact3& x) const {
    return {{dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)}};
  }
  Exact3 turnedBack(const Exact3& x) const {
    return x[0] * rows[0] + x[1] * rows[1] + x[2] * rows[2];
  }
  Exact3 operator*(const Exact3& x) const { return turned(x) + origin; }
  ExactPose operator*(const ExactPose& other) const {
    ExactPose result;
    for (std::size_t i = 0; i < 3; ++i) result.rows[i] = other.turnedBack(rows[i]);
    result.origin = *this * other.origin;
    return result;
  }
};

inline ExactPose exact(const Eigen::Isometry3d& pose) {
  ExactPose result;
  for (int i = 0; i < 3; ++i) result.rows[i] = exact(Eigen::Vector3d(pose.linear().row(i)));
  result.origin = exact(Eigen::Vector3d(pose.translation()));
  return result;
}

inline ExactPose shift(const Exact3& by) {
  ExactPose result;
  result.origin = by;
  return result;
}

/// About an axis of any length.
inline ExactPose turn(const Digits& angle, const Exact3& about) {
  const Digits length = norm(about);
  ExactPose result;
  if (!(length > 0)) return result;
  const Exact3 axis = (1 / length) * about;
  const Digits s = sin(angle), c = cos(angle);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      result.rows[i][j] = (1 - c) * axis[i] * axis[j] + (i == j ? c : Digits(0));
  for (std::size_t i = 0; i < 3; ++i) {
    result.rows[i][(i + 1) % 3] -= s * axis[(i + 2) % 3];
    result.rows[i][(i + 2) % 3] += s * axis[(i + 1) % 3];
  }
  return result;
}

inline Digits pi() {
  return boost::math::constants::pi<Digits>();
}

/// The motion's way of a cyclic value: which way round, the doubles say.
inline Digits cyclicWay(double from, double to) {
  Digits way = Digits(to) - Digits(from);
  if (std::abs(to - from) <= std::numbers::pi) return way;
  return way - 2 * pi() * round(way / (2 * pi()));
}

/// A unit quaternion's turn, from x, y, z, w.
inline ExactPose turnOf(const std::array<Digits, 4>& q) {
  const Exact3 v{{q[0], q[1], q[2]}};
  return turn(2 * atan2(norm(v), q[3]), v);
}

inline std::array<Digits, 4> unit(const double* q) {
  std::array<Digits, 4> result{q[0], q[1], q[2], q[3]};
  Digits squared = 0;
  for (const Digits& value : result) squared += value * value;
  const Digits length = sqrt(squared);
  for (Digits& value : result) value /= length;
  return result;
}

/// By slerp: the first orientation, then a turn at constant speed in the frame of the parent.
inline ExactPose orientation(const double* from, const double* to, const Digits& t) {
  const std::array<Digits, 4> a = unit(from), b = unit(to);
  // b a^-1
  const Exact3 va{{a[0], a[1], a[2]}}, vb{{b[0], b[1], b[2]}};
  Exact3 v = a[3] * vb - b[3] * va - cross(vb, va);
  Digits w = a[3] * b[3] + dot(va, vb);
  if (w < 0) {
    w = -w;
    v = Digits(-1) * v;
  }
  return turn(2 * t * atan2(norm(v), w), v) * turnOf(a);
}

/// A moving body in its parent's frame, at t on a straight motion.
inline ExactPose jointPose(const detail::KinematicModel& model, const detail::MovingBody& body,
                           std::span<const double> from, std::span<const double> to,
                           const Digits& t) {
  const double* a = from.data() + body.variable;
  const double* b = to.data() + body.variable;
  const auto straight = [&](int i) -> Digits {
    return Digits(a[i]) + t * (Digits(b[i]) - Digits(a[i]));
  };
  const auto value = [&]() -> Digits {
    const Digits own =
        model.cyclic[body.variable] != 0 ? Digits(a[0]) + t * cyclicWay(a[0], b[0]) : straight(0);
    return Digits(body.multiplier) * own + Digits(body.offset);
  };
  ExactPose joint = exact(body.parent_from_joint);
  switch (body.type) {
    case JointType::Revolute:
    case JointType::Continuous:
      return joint * turn(value(), exact(body.axis));
    case JointType::Prismatic:
      return joint * shift(value() * exact(body.axis));
    case JointType::Planar: {
      const Exact3 way = straight(0) * exact(Eigen::Vector3d(body.planarBasis.col(0))) +
                         straight(1) * exact(Eigen::Vector3d(body.planarBasis.col(1)));
      return joint * shift(way) *
             turn(Digits(a[2]) + t * cyclicWay(a[2], b[2]),
                  exact(Eigen::Vector3d(body.planarBasis.col(2))));
    }
    case JointType::Floating:
      return joint * shift({{straight(0), straight(1), straight(2)}}) *
             orientation(a + 3, b + 3, t);
    case JointType::Fixed:
      break;
  }
  return joint;
}

/// All bodies in the model frame.
inline std::vector<ExactPose> posesAt(const detail::KinematicModel& model,
                                      std::span<const double> from, std::span<const double> to,
                                      const Digits& t) {
  std::vector<ExactPose> poses(model.bodies.size());
  for (std::size_t i = 1; i < model.bodies.size(); ++i)
    poses[i] = poses[static_cast<std::size_t>(model.bodies[i].parent)] *
               jointPose(model, model.bodies[i], from, to, t);
  return poses;
}

}  // namespace swept::exact_test
