// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

/// Random robots with kinematics of their own, in extended precision. Nothing here sees swept.
namespace constraints {

using Real = long double;
using Vec = Eigen::Matrix<Real, 3, 1>;
using Mat = Eigen::Matrix<Real, 3, 3>;

/// x -> turn x + place.
struct Pose {
  Mat turn = Mat::Identity();
  Vec place = Vec::Zero();

  Pose operator*(const Pose& other) const {
    return {turn * other.turn, turn * other.place + place};
  }
  Pose inverse() const { return {turn.transpose(), -(turn.transpose() * place)}; }
};

/// Rodrigues' formula, about a unit axis.
Mat turnAbout(const Vec& axis, Real angle);

class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index) : engine_(seed * 0x9E3779B97F4A7C15ULL + index) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
  double logUniform(double low, double high);
  Eigen::Vector3d direction();

 private:
  std::mt19937_64 engine_;
};

enum class Type : std::uint8_t { Revolute, Continuous, Prismatic, Fixed, Planar, Floating };

/// Joint i moves link i + 1.
struct RobotJoint {
  Type type = Type::Revolute;
  int parent = 0;  ///< link
  Eigen::Vector3d place = Eigen::Vector3d::Zero(), rpy = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double lower = 0.0, upper = 0.0;
  int master = -1;  ///< joint that it mimics
  double multiplier = 1.0, offset = 0.0;
  int first = -1;  ///< of its values
};

struct RandomRobot {
  std::vector<RobotJoint> joints;
  int values = 0;
  double size = 1.0;  ///< m, of the farthest frame at zero, about

  std::string urdf() const;
  std::string linkName(int link) const { return "l" + std::to_string(link); }
  std::string jointName(int joint) const { return "j" + std::to_string(joint); }
  Pose poseOf(int link, const std::vector<Real>& q) const;
  /// Values on the way from one configuration to another, as Checker defines it.
  std::vector<Real> between(const std::vector<double>& from, const std::vector<double>& to,
                            Real t) const;
};

RandomRobot makeRobot(Random& random);

}  // namespace constraints
