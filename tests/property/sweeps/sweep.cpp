// SPDX-License-Identifier: BSD-3-Clause
#include "sweep.hpp"

#include <algorithm>

namespace sweeps {
namespace {

/// A rotation that takes the x axis to a unit vector.
Matrix3d frame(const Vector3d& x) {
  const Vector3d y = x.unitOrthogonal();
  return (Matrix3d() << x, y, x.cross(y)).finished();
}

class Maker {
 public:
  Maker(std::uint64_t seed, std::uint64_t index) : random_(seed, index) {
    const auto pair = static_cast<int>(index % (std::uint64_t{kKinds} * kKinds));
    sweep_.size = random_.decades(-3.0, 3.0);
    // Mostly of like sizes, sometimes a speck or a plain.
    sizeA_ = sweep_.size * random_.decades(random_.chance(0.15) ? -4.0 : -1.0, 0.0);
    sizeB_ = sweep_.size * random_.decades(random_.chance(0.15) ? -4.0 : -1.0, 0.0);
    sweep_.a = makeBody(static_cast<Kind>(pair / kKinds), sizeA_, random_);
    sweep_.b = makeBody(static_cast<Kind>(pair % kKinds), sizeB_, random_);
    sweep_.pathA = path(sizeA_);
    sweep_.pathB = path(sizeB_);
    sweep_.t = random_.chance(0.9) ? random_.uniform(0.0, 1.0) : random_.below(2);
    options();
  }

  Sweep make() {
    constexpr std::array kScenes{Scene::Grazing, Scene::Grazing,  Scene::Crossing, Scene::Crossing,
                                 Scene::Through, Scene::NearMiss, Scene::NearMiss, Scene::Apart,
                                 Scene::Apart,   Scene::Swaying,  Scene::Anywhere};
    sweep_.scene = kScenes[random_.below(static_cast<int>(kScenes.size()))];
    switch (sweep_.scene) {
      case Scene::Through:
        through();
        break;
      case Scene::Anywhere:
        anywhere();
        break;
      case Scene::Apart:
        apart();
        break;
      case Scene::Swaying:
        swaying();
        break;
      case Scene::Grazing:
      case Scene::Crossing:
      case Scene::NearMiss:
        meeting();
        break;
    }
    sweep_.pathA.finish();
    sweep_.pathB.finish();
    return std::move(sweep_);
  }

 private:
  Path path(double size) {
    const double length = sweep_.size * random_.decades(-1.0, 1.5);
    return makePath(static_cast<PathKind>(random_.below(kPathKinds)), length, size, random_);
  }

  void options() {
    swept::ContinuousOptions& o = sweep_.options;
    const double size = sweep_.size;
    o.margin = random_.chance(0.5) ? 0.0 : size * random_.decades(-5.0, -0.5);
    o.tolerance = size * random_.decades(-7.0, -3.0);
    if (random_.chance(0.1)) o.timeTolerance = random_.decades(-6.0, -2.0);
    o.maxIntervals = 1 << 14;
    if (random_.chance(0.05)) o.maxIntervals = static_cast<int>(random_.decades(0.0, 2.0));
  }

  Touch extreme(const Body& body, double size) {
    Touch touch = touchOn(body, size, random_);
    for (int i = 0; i < 50 && !touch.extreme; ++i) touch = touchOn(body, size, random_);
    return touch;
  }

  /// Both bodies where their touches are `gap` apart along the normals, which oppose each other.
  void face(const Touch& onA, const Touch& onB, double gap) {
    const Matrix3d turnA = random_.rotation();
    normal_ = (turnA * onA.normal).normalized();
    const double spin = random_.chance(0.2) ? 0.0 : random_.uniform(-3.0, 3.0);
    const Matrix3d turnB = Eigen::AngleAxisd(spin, normal_).toRotationMatrix() * frame(-normal_) *
                           frame(onB.normal).transpose();
    const double far = random_.chance(0.25) ? random_.decades(0.0, 2.0) : 1.0;
    const Vector3d point = sweep_.size * far * random_.inCube();
    poseA_.linear() = turnA;
    poseA_.translation() = point - turnA * onA.point;
    poseB_.linear() = turnB;
    poseB_.translation() = point + gap * normal_ - turnB * onB.point;
  }

  void place() {
    sweep_.pathA.place(poseA_, sweep_.t);
    sweep_.pathB.place(poseB_, sweep_.t);
  }

  /// Of the point of B with respect to that of A.
  Vector3d approach(const Touch& onA, const Touch& onB) {
    Path a = sweep_.pathA, b = sweep_.pathB;
    a.finish();
    b.finish();
    return b.velocity(onB.point, sweep_.t) - a.velocity(onA.point, sweep_.t);
  }

  void meeting() {
    const Touch onA = extreme(sweep_.a, sizeA_), onB = extreme(sweep_.b, sizeB_);
    const double size = sweep_.size;
    if (sweep_.scene == Scene::NearMiss) {
      sweep_.depth = random_.chance(0.5) ? -sweep_.options.tolerance * random_.decades(-2.0, 1.0)
                                         : -size * random_.decades(-11.0, -1.0);
    } else if (random_.chance(0.7)) {
      sweep_.depth = std::min(sizeA_, sizeB_) * random_.decades(-11.0, -4.0);
    }
    face(onA, onB, sweep_.options.margin - sweep_.depth);
    place();
    if (!sweep_.pathA.drifts() && !sweep_.pathB.drifts()) return;
    const Vector3d velocity = approach(onA, onB);
    const double sideways = (velocity - normal_.dot(velocity) * normal_).norm();
    const double wanted =
        sweep_.scene == Scene::Crossing ? sideways * random_.decades(-0.5, 1.0) : 0.0;
    const Vector3d change = (-wanted - normal_.dot(velocity)) * normal_;
    if (sweep_.pathB.drifts())
      sweep_.pathB.drift(change, sweep_.t);
    else
      sweep_.pathA.drift(-change, sweep_.t);
    sweep_.closing = wanted;
    const bool straight = !sweep_.pathA.turns() && !sweep_.pathB.turns();
    if (straight && wanted > 0.0 && onA.extreme && onB.extreme) {
      sweep_.speed = std::hypot(wanted, sideways);
    }
  }

  void through() {
    const auto any = [&](const Body& body, double size) {
      return random_.chance(0.5) ? touchIn(body, size, random_) : touchOn(body, size, random_);
    };
    face(any(sweep_.a, sizeA_), any(sweep_.b, sizeB_), 0.0);
    if (random_.chance(0.5) && !sweep_.b.flat()) poseB_.linear() = random_.rotation();
    place();
  }

  void anywhere() {
    for (Isometry3d* pose : {&poseA_, &poseB_}) {
      pose->linear() = random_.rotation();
      pose->translation() = 2.0 * sweep_.size * random_.inCube();
    }
    place();
  }

  void apart() {
    const Touch onA = extreme(sweep_.a, sizeA_), onB = extreme(sweep_.b, sizeB_);
    const swept::ContinuousOptions& o = sweep_.options;
    const double least = (o.margin + o.tolerance) * (1.0 + 1e-6);
    const double gap = random_.chance(0.5) ? least : least * random_.uniform(1.0, 3.0);
    face(onA, onB, gap + 1e-10 * sweep_.size);
    const bool flats = sweep_.a.flat() && sweep_.b.flat();
    const int way = random_.below(3);
    if (way == 0 || (way == 2 && sweep_.a.flat())) {
      slide(sweep_.pathA);
      slide(sweep_.pathB);
      place();
    } else if (way == 1) {
      carry();
    } else {
      // As far out as A's farthest point is from the middle of its turn.
      const double out = normal_.dot(poseA_.linear() * onA.point);
      poseB_.translation() += (sweep_.a.reach - out) * normal_;
      orbit();
    }
    sweep_.mustBeFree = onA.extreme && onB.extreme && !flats;
  }

  /// What holds at the ends and in the middle says nothing of the times between.
  void swaying() {
    const Touch onA = extreme(sweep_.a, sizeA_), onB = extreme(sweep_.b, sizeB_);
    const swept::ContinuousOptions& o = sweep_.options;
    face(onA, onB, (o.margin + o.tolerance) * random_.uniform(1.0, 3.0));
    sway(sweep_.pathB);
    if (random_.chance(0.5)) sway(sweep_.pathA);
    sweep_.t = 0.5;
    place();
    sweep_.t = random_.uniform(0.0, 1.0);
  }

  /// A cubic that is at one pose at 0, 1/2 and 1.
  void sway(Path& path) {
    const bool turns = random_.chance(0.8);
    const Vector3d turn =
        turns ? random_.decades(-3.0, 0.3) * random_.direction() : Vector3d::Zero().eval();
    const Vector3d move = sweep_.size * random_.decades(-3.0, 0.5) * random_.direction();
    path = {};
    path.kind = PathKind::Bezier;
    const swept::ControlPose there{Vector3d::Zero(), Vector3d::Zero()};
    path.control = {there, {move, turn}, {-move, -turn}, there};
  }

  /// Makes it turn about the normal and go across it only.
  void slide(Path& path) const {
    const auto across = [&](const Vector3d& v) { return Vector3d(v - normal_.dot(v) * normal_); };
    path.turn = path.turn.norm() * normal_;
    path.move = path.kind == PathKind::Screw ? Vector3d::Zero().eval() : across(path.move);
    for (swept::ControlPose& c : path.control) {
      c = {across(c.position), c.rotation.norm() * normal_};
    }
  }

  /// Both as one rigid body.
  void carry() {
    Path& a = sweep_.pathA;
    if (!a.uniform()) a = makePath(PathKind::Turning, sweep_.size, sizeA_, random_);
    sweep_.pathB = a;
    if (a.turns()) {
      sweep_.pathB.reference = poseB_.inverse(Eigen::Isometry) * (poseA_ * a.reference);
    }
    place();
  }

  /// A turns on the spot, B goes around it.
  void orbit() {
    for (Path* path : {&sweep_.pathA, &sweep_.pathB}) {
      if (path->kind != PathKind::Interpolation && path->kind != PathKind::Screw) {
        *path = makePath(PathKind::Turning, sweep_.size, sweep_.size, random_);
      }
      path->move.setZero();
    }
    sweep_.pathA.reference.setZero();
    sweep_.pathB.reference = poseB_.inverse(Eigen::Isometry) * poseA_.translation();
    place();
  }

  Random random_;
  Sweep sweep_;
  double sizeA_ = 1.0, sizeB_ = 1.0;     ///< m
  Vector3d normal_ = Vector3d::UnitX();  ///< from A to B, at t
  Isometry3d poseA_ = Isometry3d::Identity(), poseB_ = Isometry3d::Identity();  ///< at t
};

}  // namespace

double Sweep::magnitude() const {
  return size * 1e-3 + options.margin + pathA.magnitude(a.reach) + pathB.magnitude(b.reach);
}

Sweep makeSweep(std::uint64_t seed, std::uint64_t index) {
  return Maker(seed, index).make();
}

}  // namespace sweeps
