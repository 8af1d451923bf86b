// SPDX-License-Identifier: BSD-3-Clause
#include "case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace constraints {

namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Quaterniond smallTurn(Random& random, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, random.direction()));
}

Eigen::Isometry3d frameIn(Random& random) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  if (random.chance(0.5)) return frame;
  frame.translation() = 0.3 * random.uniform(0.0, 1.0) * random.direction();
  frame.linear() = smallTurn(random, random.uniform(0.0, 3.0)).toRotationMatrix();
  return frame;
}

std::vector<double> randomState(const RandomRobot& robot, Random& random) {
  std::vector<double> q(static_cast<std::size_t>(robot.values));
  for (const RobotJoint& joint : robot.joints) {
    if (joint.first < 0) continue;
    const auto first = static_cast<std::size_t>(joint.first);
    switch (joint.type) {
      case Type::Planar:
        for (std::size_t k = 0; k < 3; ++k) q[first + k] = random.uniform(-3.0, 3.0);
        break;
      case Type::Floating: {
        for (std::size_t k = 0; k < 3; ++k) q[first + k] = random.uniform(-3.0, 3.0);
        const Eigen::Quaterniond turn = smallTurn(random, random.uniform(0.0, 3.0));
        for (std::size_t k = 0; k < 4; ++k)
          q[first + 3 + k] = turn.coeffs()[static_cast<Eigen::Index>(k)];
        break;
      }
      case Type::Revolute:
      case Type::Continuous:
      case Type::Prismatic:
        q[first] = random.uniform(joint.lower, joint.upper);
        break;
      case Type::Fixed:
        break;
    }
  }
  return q;
}

/// Some way from a state, sliding values within their limits.
std::vector<double> goOn(const RandomRobot& robot, const std::vector<double>& from, double length,
                         Random& random) {
  std::vector<double> to = from;
  for (const RobotJoint& joint : robot.joints) {
    if (joint.first < 0 || random.chance(0.2)) continue;
    const auto first = static_cast<std::size_t>(joint.first);
    const int count = joint.type == Type::Planar ? 3 : joint.type == Type::Floating ? 3 : 1;
    for (int k = 0; k < count; ++k) {
      double& value = to[first + static_cast<std::size_t>(k)];
      value += length * random.uniform(-1.0, 1.0);
      if (joint.type == Type::Prismatic) value = std::clamp(value, joint.lower, joint.upper);
    }
    if (joint.type != Type::Floating) continue;
    const Eigen::Quaterniond before(to[first + 6], to[first + 3], to[first + 4], to[first + 5]);
    const Eigen::Quaterniond turned = smallTurn(random, length * random.uniform(0.0, 1.0)) * before;
    for (std::size_t k = 0; k < 4; ++k)
      to[first + 3 + k] = turned.coeffs()[static_cast<Eigen::Index>(k)];
  }
  return to;
}

/// A tolerance beside a change of about `scale`: some ask for nothing, some for everything.
double toleranceFor(double scale, Random& random) {
  if (random.chance(0.02)) return 0.0;
  if (random.chance(0.25)) return random.chance(0.5) ? kPi : 4.0;
  return std::min(3.1, scale * random.logUniform(0.1, 4.0));
}

class CaseMaker {
 public:
  CaseMaker(std::uint64_t seed, std::uint64_t index) : random_(seed, index) {}

  Case make() {
    made_.robot = makeRobot(random_);
    length_ = random_.logUniform(0.01, 2.0);
    made_.from = randomState(made_.robot, random_);
    made_.to = goOn(made_.robot, made_.from, length_, random_);
    if (random_.chance(0.3)) addCurve();
    if (random_.chance(0.3)) addTube();
    const Real near = random_.chance(0.5) ? Real(0) : Real(random_.uniform(0.0, 1.0));
    near_ = made_.at(near);
    const int count = random_.chance(0.8) ? 1 : 2;
    for (int i = 0; i < count; ++i) {
      const auto kind = static_cast<Kind>(random_.below(kKinds));
      if (i == 0) made_.kind = kind;
      add(kind);
    }
    return made_;
  }

 private:
  int links() const { return static_cast<int>(made_.robot.joints.size()) + 1; }

  swept::ConstraintFrame toolFrame() {
    const int link = random_.chance(0.7) ? links() - 1 : random_.below(links());
    return {.body = made_.robot.linkName(link), .body_from_frame = frameIn(random_)};
  }
  swept::ConstraintFrame referenceFrame() {
    if (random_.chance(0.6)) return {.body_from_frame = frameIn(random_)};
    return {.body = made_.robot.linkName(random_.below(links())),
            .body_from_frame = frameIn(random_)};
  }

  Pose poseOf(const swept::ConstraintFrame& frame) const {
    const int link = frame.body.empty() ? 0 : std::stoi(frame.body.substr(1));
    return made_.robot.poseOf(link, near_) * Pose{frame.body_from_frame.linear().cast<Real>(),
                                                  frame.body_from_frame.translation().cast<Real>()};
  }

  void add(Kind kind) {
    switch (kind) {
      case Kind::Joint:
        return addJoint();
      case Kind::Box:
      case Kind::Sphere:
      case Kind::Cylinder:
        return addPosition(kind);
      case Kind::Euler:
      case Kind::RotationVector:
        return addOrientation(kind);
      case Kind::Axis:
        return addAxis();
    }
  }

  void addJoint() {
    std::vector<std::size_t> moving;
    for (std::size_t i = 0; i < made_.robot.joints.size(); ++i)
      if (made_.robot.joints[i].type != Type::Fixed) moving.push_back(i);
    const std::size_t index =
        moving[static_cast<std::size_t>(random_.below(static_cast<int>(moving.size())))];
    const RobotJoint& joint = made_.robot.joints[index];
    swept::JointConstraint own{.joint = made_.robot.jointName(static_cast<int>(index))};
    const RobotJoint& source =
        joint.master < 0 ? joint : made_.robot.joints[static_cast<std::size_t>(joint.master)];
    auto place = static_cast<std::size_t>(source.first);
    if (joint.type == Type::Planar || joint.type == Type::Floating) {
      static constexpr const char* kPlanar[] = {"/x", "/y", "/theta"};
      static constexpr const char* kFloating[] = {"/trans_x", "/trans_y", "/trans_z"};
      const int k = random_.below(3);
      place += static_cast<std::size_t>(k);
      own.joint += joint.type == Type::Planar ? kPlanar[k] : kFloating[k];
    }
    own.position = static_cast<double>(joint.multiplier * near_[place] + joint.offset) +
                   0.3 * length_ * random_.uniform(-1.0, 1.0);
    if (joint.type == Type::Continuous && random_.chance(0.5)) own.position += 2.0 * kPi;
    own.above = toleranceFor(length_, random_);
    own.below = toleranceFor(length_, random_);
    if (joint.type == Type::Prismatic) own.position = std::clamp(own.position, -0.9, 0.9);
    if (joint.type == Type::Revolute && joint.master < 0)
      own.position = std::clamp(own.position, -2.9, 2.9);
    made_.constraint.joints.push_back(own);
  }

  void addPosition(Kind kind) {
    swept::PositionConstraint own{
        .frame = toolFrame(), .reference = referenceFrame(), .regions = {}};
    const Vec place = (poseOf(own.reference).inverse() * poseOf(own.frame)).place;
    const int count = random_.chance(0.8) ? 1 : 2;
    for (int i = 0; i < count; ++i) {
      swept::ConstraintRegion region;
      region.type = static_cast<swept::ConstraintRegion::Type>(static_cast<int>(kind) - 1);
      for (double& size : region.size) {
        size = length_ * random_.logUniform(0.1, 5.0);
        if (random_.chance(0.1)) size = std::numeric_limits<double>::infinity();
        if (random_.chance(0.02)) size = 0.0;
      }
      if (random_.chance(0.5))
        region.reference_from_region.linear() =
            smallTurn(random_, random_.uniform(0.0, 3.0)).toRotationMatrix();
      region.reference_from_region.translation() =
          place.cast<double>() + 0.2 * length_ * random_.uniform(0.0, 1.0) * random_.direction();
      own.regions.push_back(region);
    }
    made_.constraint.positions.push_back(own);
  }

  void addOrientation(Kind kind) {
    swept::OrientationConstraint own{.frame = toolFrame(), .reference = referenceFrame()};
    const Mat turn = (poseOf(own.reference).inverse() * poseOf(own.frame)).turn;
    const Eigen::Matrix3d now = turn.cast<double>();
    own.orientation = Eigen::Quaterniond(now);
    if (random_.chance(0.8))
      own.orientation =
          own.orientation * smallTurn(random_, random_.chance(0.8)
                                                   ? 0.3 * length_ * random_.uniform(0.0, 1.0)
                                                   : random_.uniform(0.0, kPi));
    // The middle angle at a right angle.
    if (random_.chance(0.1))
      own.orientation = own.orientation *
                        Eigen::Quaterniond(Eigen::AngleAxisd(
                            (random_.chance(0.5) ? 0.5 : -0.5) * kPi, Eigen::Vector3d::UnitY()));
    own.orientation.normalize();
    for (double& tolerance : own.tolerance) tolerance = toleranceFor(length_, random_);
    if (kind == Kind::RotationVector)
      own.parameterization = swept::OrientationConstraint::Parameterization::RotationVector;
    made_.constraint.orientations.push_back(own);
  }

  void addAxis() {
    swept::AxisConstraint own{.frame = toolFrame(), .reference = referenceFrame()};
    own.axis = random_.chance(0.5) ? Eigen::Vector3d(Eigen::Vector3d::Unit(random_.below(3)))
                                   : Eigen::Vector3d(2.0 * random_.direction());
    const Vec now =
        poseOf(own.reference).turn.transpose() * poseOf(own.frame).turn * own.axis.cast<Real>();
    own.direction = smallTurn(random_, 0.3 * length_ * random_.uniform(0.0, 1.0)) *
                    Eigen::Vector3d(now.cast<double>());
    own.angle = toleranceFor(length_, random_);
    made_.constraint.axes.push_back(own);
  }

  /// Orientations of floating joints stay, values that slide keep their limits.
  void addCurve() {
    const int pieces = 1 + random_.below(3);
    std::vector<double> knots{0.0};
    std::vector<Eigen::MatrixXd> coefficients;
    std::vector<double> begin = made_.from;
    for (int i = 0; i < pieces; ++i) {
      const int degree = 1 + random_.below(5);
      knots.push_back(knots.back() + random_.logUniform(0.05, 2.0));
      Eigen::MatrixXd own(made_.robot.values, degree + 1);
      std::vector<double> column = begin;
      for (int k = 0; k <= degree; ++k) {
        own.col(k) = Eigen::Map<const Eigen::VectorXd>(column.data(), std::ssize(column));
        if (k == degree) break;
        std::vector<double> next = goOn(made_.robot, column, length_ / degree, random_);
        for (const RobotJoint& joint : made_.robot.joints)
          if (joint.type == Type::Floating)
            for (int n = 3; n < 7; ++n)
              next[static_cast<std::size_t>(joint.first + n)] =
                  column[static_cast<std::size_t>(joint.first + n)];
        column = std::move(next);
      }
      begin = column;
      coefficients.push_back(std::move(own));
    }
    made_.curve.emplace(std::move(knots), std::move(coefficients));
  }

  void addTube() {
    made_.inTube = true;
    const double size = random_.logUniform(1e-4, 0.05);
    made_.tracking.rotation = size;
    made_.tracking.translation = 0.3 * size;
  }

  Random random_;
  Case made_;
  double length_ = 1.0;
  std::vector<Real> near_;
};

}  // namespace

std::vector<Real> Case::at(Real t) const {
  if (!curve) return robot.between(from, to, t);
  const Real time = curve->begin() + t * (Real(curve->end()) - curve->begin());
  std::size_t piece = 0;
  while (piece + 1 < curve->pieces() && time >= curve->knots()[piece + 1]) ++piece;
  const Real u =
      (time - curve->knots()[piece]) / (Real(curve->knots()[piece + 1]) - curve->knots()[piece]);
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> b = curve->coefficients(piece).cast<Real>();
  for (Eigen::Index n = b.cols() - 1; n > 0; --n)
    for (Eigen::Index k = 0; k < n; ++k) b.col(k) = ((1 - u) * b.col(k) + u * b.col(k + 1)).eval();
  std::vector<Real> q(b.col(0).begin(), b.col(0).end());
  return q;
}

double Case::length() const {
  double most = 0.0;
  if (curve) {
    for (std::size_t piece = 0; piece < curve->pieces(); ++piece) {
      const Eigen::MatrixXd& own = curve->coefficients(piece);
      double of = 0.0;
      for (Eigen::Index k = 1; k < own.cols(); ++k)
        of = std::max(of, (own.col(k) - own.col(k - 1)).cwiseAbs().maxCoeff());
      most += of * static_cast<double>(own.cols() - 1);
    }
    return most;
  }
  for (std::size_t i = 0; i < from.size(); ++i) most = std::max(most, std::abs(to[i] - from[i]));
  // The angle between two quaternions is up to some three times what a component changes.
  return 3.0 * most;
}

Case makeCase(std::uint64_t seed, std::uint64_t index) {
  return CaseMaker(seed, index).make();
}

}  // namespace constraints
