// SPDX-License-Identifier: BSD-3-Clause
#include "path.hpp"

#include <algorithm>

namespace sweeps {

using motion_oracle::Quaternion;
using motion_oracle::Vector;
using swept::ControlPose;
using swept::SplineMotion;
using swept::UniformMotion;

namespace {

Isometry3d rounded(const Placement& placed) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = placed.rotation.cast<double>();
  pose.translation() = placed.position.cast<double>();
  return pose;
}

motion_oracle::Curve splineCurve(const Path& path, const Matrix3d& orientation) {
  return path.kind == PathKind::Bezier ? motion_oracle::bezier(orientation, path.control)
                                       : motion_oracle::uniformCubic(orientation, path.control);
}

}  // namespace

void Path::place(const Isometry3d& pose, double t) {
  const Vector there = pose.translation().cast<Real>();
  if (!uniform()) {
    const Placement now = splineCurve(*this, Matrix3d::Identity())(t);
    start.linear() = (now.rotation.transpose() * pose.linear().cast<Real>()).cast<double>();
    const Vector3d shift = (there - now.position).cast<double>();
    for (ControlPose& c : control) c.position += shift;
    return;
  }
  const Vector local = reference.cast<Real>();
  const Quaternion back = motion_oracle::power(-Real(t) * turn.cast<Real>());
  const motion_oracle::Rotation first = back.toRotationMatrix() * pose.linear().cast<Real>();
  const Vector point = pose.linear().cast<Real>() * local + there - Real(t) * move.cast<Real>();
  start.linear() = first.cast<double>();
  start.translation() = (point - first * local).cast<double>();
}

// Of a Bézier curve the control points lie over i / degree, of a uniform B-spline over whole spans.
void Path::drift(const Vector3d& velocity, double t) {
  if (uniform()) {
    move += velocity;
    start.translation() -= t * velocity;
    return;
  }
  const auto count = static_cast<double>(control.size());
  for (std::size_t i = 0; i < control.size(); ++i) {
    const auto k = static_cast<double>(i);
    const double over = kind == PathKind::Bezier ? k / (count - 1.0) : (k - 1.0) / (count - 3.0);
    control[i].position += (over - t) * velocity;
  }
}

void Path::finish() {
  if (!uniform()) {
    curve = splineCurve(*this, start.linear());
    return;
  }
  curve = motion_oracle::turning(start, turn, move, reference);
  end = rounded(curve(1));
  if (kind == PathKind::Interpolation) curve = motion_oracle::slerp(start, end, reference);
  if (kind == PathKind::Screw) curve = motion_oracle::screw(start, end);
}

Isometry3d Path::at(double t) const {
  return rounded(curve(t));
}

Vector3d Path::velocity(const Vector3d& local, double t) const {
  constexpr Real kStep = 1e-5L;
  const Real middle = std::clamp<Real>(t, kStep, 1 - kStep);
  const auto point = [&](Real s) {
    const Placement placed = curve(s);
    return Vector(placed.rotation * local.cast<Real>() + placed.position);
  };
  return ((point(middle + kStep) - point(middle - kStep)) / (2 * kStep)).cast<double>();
}

std::unique_ptr<swept::Motion> Path::motion() const {
  const auto own = [](auto m) -> std::unique_ptr<swept::Motion> {
    return std::make_unique<decltype(m)>(std::move(m));
  };
  switch (kind) {
    case PathKind::Still:
      return own(UniformMotion::still(start));
    case PathKind::Translation:
      return own(UniformMotion::translation(start, move));
    case PathKind::Interpolation:
      return own(UniformMotion::interpolation(start, end, reference));
    case PathKind::Screw:
      return own(UniformMotion::screw(start, end));
    case PathKind::Turning:
      return own(UniformMotion::turning(start, turn, move, reference));
    case PathKind::Bezier:
      return own(SplineMotion::bezier(start.linear(), control));
    case PathKind::Cubic:
      break;
  }
  return own(SplineMotion::uniformCubic(start.linear(), control));
}

Path Path::reversed() const {
  Path back = *this;
  if (uniform()) {
    std::swap(back.start, back.end);
    back.turn = -turn;
    back.move = -move;
  }
  std::reverse(back.control.begin(), back.control.end());
  back.finish();
  return back;
}

Path Path::moved(const Isometry3d& by) const {
  Path there = *this;
  there.start = by * start;
  there.turn = by.linear() * turn;
  there.move = by.linear() * move;
  for (ControlPose& c : there.control) {
    c = {by * c.position, by.linear() * c.rotation};
  }
  there.finish();
  return there;
}

double Path::magnitude(double reach) const {
  double most = start.translation().norm() + move.norm();
  for (const ControlPose& c : control) most = std::max(most, c.position.norm());
  if (kind == PathKind::Screw) most = std::max(most, end.translation().norm() + reference.norm());
  return most + (1.0 + turn.norm()) * (reach + reference.norm());
}

Path makePath(PathKind kind, double length, double size, Random& random) {
  Path path;
  path.kind = kind;
  path.move = length * random.direction();
  path.turn = random.decades(-2.0, std::log10(3.0)) * random.direction();
  path.reference = random.chance(0.3) ? Vector3d::Zero().eval()
                                      : size * random.decades(-1.0, 0.7) * random.direction();
  const int count = random.below(5);
  switch (kind) {
    case PathKind::Still:
      path.move.setZero();
      [[fallthrough]];
    case PathKind::Translation:
      path.turn.setZero();
      path.reference.setZero();
      break;
    case PathKind::Screw: {
      const Vector3d axis = path.turn.normalized();
      path.move = axis.dot(path.move) * axis;
      break;
    }
    case PathKind::Turning:
      if (random.chance(0.5)) path.turn *= random.uniform(6.5, 40.0) / path.turn.norm();
      break;
    case PathKind::Bezier:
    case PathKind::Cubic: {
      const double angle = random.decades(-2.0, 0.5);
      for (int i = 0; i < count + (kind == PathKind::Bezier ? 2 : 4); ++i) {
        const Vector3d position = length * random.inCube();
        path.control.push_back({position, angle * random.inCube()});
      }
      path.turn.setZero();
      path.move.setZero();
      path.reference.setZero();
      break;
    }
    case PathKind::Interpolation:
      break;
  }
  return path;
}

}  // namespace sweeps
