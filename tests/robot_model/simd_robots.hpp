// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <variant>
#include <vector>

#include "certify/workspace_data.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd/tables/pair_separation_tables.hpp"
#include "swept/core/axis_frame.hpp"

/// Random robots for tests of the SIMD tier, and their kinematics once more in extended precision.
namespace swept::simd_test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  /// As many small ones as large ones, by order of magnitude.
  double scale(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  Eigen::Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Eigen::Vector3d direction() {
    std::normal_distribution<double> normal;
    return Eigen::Vector3d(normal(engine_), normal(engine_), normal(engine_)).normalized();
  }
  Eigen::Quaterniond turn() {
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond(normal(engine_), normal(engine_), normal(engine_), normal(engine_))
        .normalized();
  }
  Eigen::Isometry3d pose(double size) {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    result.linear() = turn().toRotationMatrix();
    result.translation() = vector(size);
    return result;
  }

 private:
  std::mt19937 engine_;
};

struct ChainOptions {
  std::vector<JointType> types;  ///< planar and floating ones first
  double link = 0.4;             ///< m, between joints
  double slides = 1.0;           ///< times that: limits of prismatic joints
  double branches = 0.0;         ///< share of bodies that hang on any earlier one
  double mimics = 0.2;           ///< share of turning joints that mimic one
  double squared = 0.3;          ///< share of joints whose axis is at right angles to the last
  bool straight = false;         ///< all in a row, about parallel axes: errors add up
};

inline int variablesOf(JointType type) {
  return type == JointType::Planar ? 3 : type == JointType::Floating ? 7 : 1;
}

inline bool turns(JointType type) {
  return type == JointType::Revolute || type == JointType::Continuous;
}

inline void addBody(Random& random, const ChainOptions& options, JointType type,
                    detail::KinematicModel& model) {
  const int count = static_cast<int>(model.bodies.size());
  detail::MovingBody body;
  body.parent =
      count > 1 && random.chance(options.branches) ? 1 + random.below(count - 1) : count - 1;
  // What slides freely stands in front of all others.
  if (variablesOf(type) > 1) body.parent = 0;
  body.type = type;
  body.parent_from_joint = random.pose(options.link);
  body.axis = random.direction();
  if (random.chance(options.squared)) {
    body.parent_from_joint.linear().setIdentity();
    body.axis = model.bodies[body.parent].axis.unitOrthogonal();
  }
  if (options.straight) {
    body.parent_from_joint = Eigen::Translation3d(options.link, 0.0, 0.0);
    body.axis = Eigen::Vector3d::UnitZ();
  }
  body.planarBasis = axisFrame(body.axis);
  const double range = type == JointType::Prismatic ? options.slides * options.link
                                                    : std::numeric_limits<double>::infinity();
  body.lower = -range;
  body.upper = range;
  body.variable = model.dimension;
  const auto masters = [&] {
    std::vector<int> found;
    for (const detail::MovingBody& other : model.bodies)
      if (turns(other.type)) found.push_back(other.variable);
    return found;
  }();
  if (turns(type) && !masters.empty() && random.chance(options.mimics)) {
    body.variable = masters[random.below(static_cast<int>(masters.size()))];
    body.multiplier = random.uniform(-2.0, 2.0);
    body.offset = random.uniform(-1.0, 1.0);
  } else {
    for (int i = 0; i < variablesOf(type); ++i)
      model.cyclic.push_back(type == JointType::Continuous ||
                             (type == JointType::Planar && i == 2));
    model.dimension += variablesOf(type);
  }
  model.bodies.push_back(body);
}

/// One ball about a random centre.
inline std::shared_ptr<const SphereCover> ballCover(Random& random, double size) {
  auto cover = std::make_shared<SphereCover>();
  SphereCover::Node node{};
  node.ball.center = random.vector(size).cast<float>();
  node.ball.radius = static_cast<float>(random.uniform(0.0, size));
  node.inside = -1.0F;
  cover->nodes.push_back(node);
  return cover;
}

/// A model's geometry is shared between versions, so a changed one is a new one.
template <typename Change>
void changeGeometry(detail::CheckerModel& model, const Change& change) {
  std::vector<detail::RobotGeometry> geometry(model.robotGeometry.begin(),
                                              model.robotGeometry.end());
  change(geometry);
  model.robotGeometry = detail::SharedArray(std::move(geometry));
}

/// The straight motion between two configurations in single precision.
class StraightSimdMotion {
 public:
  StraightSimdMotion(const detail::SimdModel& model, const detail::KinematicModel& kinematics,
                     std::span<const double> from, std::span<const double> to,
                     detail::SimdScratch& scratch)
      : path_(kinematics, from, to),
        joints_(kinematics.bodies.size()),
        motion_(model, kinematics, path_, joints_, scratch) {}

  bool compile() {
    if (!motion_.compile()) return false;
    motion_.bound();
    motion_.boundLinks();
    return true;
  }
  detail::SimdMotion& get() { return motion_; }

 private:
  detail::StraightPath path_;
  std::vector<detail::JointMotion> joints_;
  detail::SimdMotion motion_;
};

/// What a Checker compiles of such a model, tables too.
inline detail::SimdModel simdModelOf(const detail::PairModel& model) {
  detail::SimdModel simd = detail::compileSimdModel(model);
  detail::addTables(model, nullptr, simd);
  return simd;
}

/// Bodies with one or several balls each, as the checker would compile them, with no world.
inline detail::CheckerModel robotOf(Random& random, const ChainOptions& options) {
  detail::CheckerModel model;
  model.kinematics.bodies.emplace_back();
  for (const JointType type : options.types) addBody(random, options, type, model.kinematics);
  std::vector<detail::RobotGeometry> all;
  for (std::size_t body = 1; body < model.kinematics.bodies.size(); ++body) {
    const int pieces = random.chance(0.3) ? 3 : 1;
    for (int i = 0; i < pieces; ++i) {
      detail::RobotGeometry geometry;
      geometry.body = static_cast<int>(body);
      geometry.shape = Sphere{1.0};
      geometry.body_from_shape = random.pose(options.link);
      geometry.cover = ballCover(random, options.link);
      const CoverBall& ball = geometry.cover->nodes.front().ball;
      geometry.center = geometry.body_from_shape * ball.center.cast<double>();
      geometry.radius = static_cast<double>(ball.radius);
      geometry.levers =
          detail::leverArms(model.kinematics, geometry.body, geometry.center, geometry.radius);
      all.push_back(geometry);
    }
  }
  model.robotGeometry = detail::SharedArray(std::move(all));
  return model;
}

/// The last body that carries both.
inline int commonAncestor(const detail::KinematicModel& model, int a, int b) {
  while (a != b) {
    int& later = a > b ? a : b;
    later = model.bodies[later].parent;
  }
  return a;
}

/// Values of all variables: turning ones up to `turn` (rad), sliding ones up to `slide` (m).
inline std::vector<double> configuration(Random& random, const detail::KinematicModel& model,
                                         double turn, double slide) {
  std::vector<double> q(model.dimension, 0.0);
  for (const detail::MovingBody& body : model.bodies) {
    double* at = body.variable < 0 ? nullptr : q.data() + body.variable;
    if (body.type == JointType::Fixed) continue;
    if (body.type == JointType::Prismatic) {
      at[0] = random.uniform(body.lower, body.upper);
    } else if (turns(body.type)) {
      at[0] = random.uniform(-turn, turn);
    } else {
      for (int i = 0; i < (body.type == JointType::Planar ? 2 : 3); ++i)
        at[i] = random.uniform(-slide, slide);
      if (body.type == JointType::Planar) at[2] = random.uniform(-turn, turn);
      const Eigen::Quaterniond turned = random.turn();
      if (body.type == JointType::Floating)
        for (int i = 0; i < 4; ++i) at[3 + i] = turned.coeffs()[i];
    }
  }
  return q;
}

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Pose = Eigen::Transform<Real, 3, Eigen::Isometry>;

inline Real cyclicWay(double from, double to) {
  const Real way = static_cast<Real>(to) - static_cast<Real>(from);
  return std::abs(way) <= std::numbers::pi_v<Real>
             ? way
             : std::remainder(way, 2 * std::numbers::pi_v<Real>);
}

/// A moving body in its parent, at t on the motion.
inline Pose jointPose(const detail::KinematicModel& model, const detail::MovingBody& body,
                      std::span<const double> from, std::span<const double> to, Real t) {
  const double* a = from.data() + body.variable;
  const double* b = to.data() + body.variable;
  const bool cyclic = model.cyclic[body.variable] != 0;
  const auto straight = [&](int i) {
    const auto begin = static_cast<Real>(a[i]);
    return begin + t * (static_cast<Real>(b[i]) - begin);
  };
  const Real single = cyclic ? static_cast<Real>(a[0]) + t * cyclicWay(a[0], b[0]) : straight(0);
  const Real value = static_cast<Real>(body.multiplier) * single + static_cast<Real>(body.offset);
  Pose pose(body.parent_from_joint.cast<Real>());
  const Vector axis = body.axis.cast<Real>().normalized();
  if (turns(body.type)) {
    pose.rotate(Eigen::AngleAxis<Real>(value, axis));
  } else if (body.type == JointType::Prismatic) {
    pose.translate(value * body.axis.cast<Real>());
  } else if (body.type == JointType::Planar) {
    pose.translate(body.planarBasis.cast<Real>() * Vector(straight(0), straight(1), 0));
    const Real angle = static_cast<Real>(a[2]) + t * cyclicWay(a[2], b[2]);
    pose.rotate(Eigen::AngleAxis<Real>(angle, body.planarBasis.col(2).cast<Real>().normalized()));
  } else {
    pose.translate(Vector(straight(0), straight(1), straight(2)));
    const auto turnOf = [](const double* q) {
      return Eigen::Quaternion<Real>(q[6], q[3], q[4], q[5]).normalized();
    };
    pose.rotate(turnOf(a).slerp(t, turnOf(b)));
  }
  return pose;
}

/// A point of `body` in the frame of `reference`, which carries it.
inline Vector exactPoint(const detail::KinematicModel& model, std::span<const double> from,
                         std::span<const double> to, Real t, int body, int reference,
                         const Vector& point) {
  Vector p = point;
  for (int b = body; b != reference; b = model.bodies[b].parent)
    p = jointPose(model, model.bodies[b], from, to, t) * p;
  return p;
}

/// A ball's centre in its body's frame, as the lane model has it.
inline Vector centerOf(const detail::SimdModel& lanes, int body, const detail::SimdNode& node) {
  const Eigen::Vector3d center(static_cast<double>(node.center[0]),
                               static_cast<double>(node.center[1]),
                               static_cast<double>(node.center[2]));
  return lanes.bodyFromLane[body].cast<Real>() * center.cast<Real>();
}

/// A piece of the world as the checker compiles it.
inline detail::WorldGeometry worldGeometry(const Shape& shape,
                                           const Eigen::Isometry3d& world_from_shape) {
  detail::WorldGeometry geometry;
  geometry.shape = shape;
  geometry.world_from_shape = world_from_shape;
  const Aabb box = boundingBox(shape);
  const bool bounded = (box.upper - box.lower).allFinite();
  const Eigen::Vector3d middle =
      bounded ? Eigen::Vector3d(0.5 * (box.lower + box.upper)) : Eigen::Vector3d::Zero();
  Eigen::Isometry3d world_from_box = world_from_shape;
  world_from_box.translation() = world_from_shape * middle;
  geometry.box_from_world = world_from_box.inverse();
  geometry.halfExtents = box.upper - middle;
  geometry.magnitude = world_from_box.translation().norm();
  if (bounded) geometry.magnitude += geometry.halfExtents.norm();
  if (const auto* plane = std::get_if<Plane>(&shape)) geometry.magnitude += std::abs(plane->offset);
  if (const auto* half = std::get_if<HalfSpace>(&shape))
    geometry.magnitude += std::abs(half->offset);
  return geometry;
}

}  // namespace swept::simd_test
