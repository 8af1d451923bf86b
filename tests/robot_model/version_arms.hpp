// SPDX-License-Identifier: BSD-3-Clause
// Arms and worlds of which two are the same by construction: one made by rules, attached bodies and
// versions of a checker, the other by its URDF and scene.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "message_of.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept::test {

inline Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// A piece of a link: `<sphere radius="0.1"/>`, where it is in the link's frame.
struct UrdfPiece {
  std::string geometry;
  Eigen::Vector3d at;
};

inline std::string sphere(double radius) {
  return "<sphere radius=\"" + std::to_string(radius) + "\"/>";
}
inline std::string box(double x, double y, double z) {
  return "<box size=\"" + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) +
         "\"/>";
}

inline std::string urdfLink(const std::string& name, const std::vector<UrdfPiece>& pieces) {
  std::string text = "<link name=\"" + name + "\">";
  for (const UrdfPiece& piece : pieces)
    text += "<collision><origin xyz=\"" + std::to_string(piece.at.x()) + " " +
            std::to_string(piece.at.y()) + " " + std::to_string(piece.at.z()) + "\"/><geometry>" +
            piece.geometry + "</geometry></collision>";
  return text + "</link>";
}

inline std::string urdfJoint(const std::string& name, const std::string& type,
                             const std::string& parent, const std::string& child,
                             const std::string& rest) {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + rest + "</joint>";
}

/// Two joints; base, upper, fore and a hand that is fixed to fore. Beside the base is what the arm
/// meets when it folds.
struct ArmGeometry {
  std::vector<UrdfPiece> base{{sphere(0.1), {0, 0, 0}}, {sphere(0.1), {0.1, 0.15, 0.35}}};
  std::vector<UrdfPiece> upper{{sphere(0.06), {0, 0, 0.15}}, {sphere(0.05), {0, 0, 0.3}}};
  std::vector<UrdfPiece> fore{{sphere(0.05), {0, 0, 0.12}}, {sphere(0.04), {0, 0, 0.22}}};
  std::vector<UrdfPiece> hand{{sphere(0.03), {0, 0, 0.0}}};
};

inline std::string armUrdf(const ArmGeometry& geometry, const std::string& more = {}) {
  const std::string limits = R"(<limit lower="-2.6" upper="2.6" effort="1" velocity="1"/>)";
  return R"(<robot name="arm">)" + urdfLink("base", geometry.base) +
         urdfLink("upper", geometry.upper) + urdfLink("fore", geometry.fore) +
         urdfLink("hand", geometry.hand) +
         urdfJoint("yaw", "continuous", "base", "upper",
                   R"(<origin xyz="0 0 0.1"/><axis xyz="0 0.6 0.8"/>)") +
         urdfJoint("elbow", "revolute", "upper", "fore",
                   R"(<origin xyz="0 0.02 0.4"/><axis xyz="0 1 0"/>)" + limits) +
         urdfJoint("wrist", "fixed", "fore", "hand", R"(<origin xyz="0 0 0.3"/>)") + more +
         "</robot>";
}

inline std::shared_ptr<const Robot> parseArm(const std::string& urdf,
                                             const std::string& srdf = {}) {
  return Robot::parse(urdf, "arm.urdf", srdf, srdf.empty() ? "" : "arm.srdf");
}

inline std::string armSrdf(const std::vector<std::pair<std::string, std::string>>& disabled) {
  std::string text = "<robot name=\"arm\">";
  for (const auto& [a, b] : disabled)
    text += "<disable_collisions link1=\"" + a + "\" link2=\"" + b + "\" reason=\"test\"/>";
  return text + "</robot>";
}

inline std::vector<double> randomConfiguration(const Checker& checker, std::mt19937& random) {
  std::vector<double> q;
  for (const int v : checker.group().variables) {
    const Variable& variable = checker.robot().variables()[v];
    const double low = variable.cyclic ? -3.1 : variable.lower;
    const double high = variable.cyclic ? 3.1 : variable.upper;
    q.push_back(std::uniform_real_distribution<double>(low, high)(random));
  }
  return q;
}

/// How often two checkers gave an answer.
struct Agreement {
  int free = 0;
  int collision = 0;
  int undecided = 0;
  int differing = 0;  ///< one Free, the other Collision, of motions or states

  void expectRepresentative(int least) const {
    EXPECT_EQ(differing, 0);
    EXPECT_GE(free, least);
    EXPECT_GE(collision, least);
    EXPECT_LE(50 * undecided, free + collision) << "too many are left undecided";
  }
};

inline void compare(Verdict a, Verdict b, Agreement& agreement) {
  if (a == Verdict::Undecided || b == Verdict::Undecided) {
    ++agreement.undecided;
  } else if (a != b) {
    ++agreement.differing;
  } else {
    ++(a == Verdict::Free ? agreement.free : agreement.collision);
  }
}

/// Random motions and their ends, by each in its own way.
inline Agreement agreementOf(const Checker& a, const Checker& b, int motions, unsigned seed) {
  std::mt19937 random(seed);
  Workspace ofA(a);
  Workspace ofB(b);
  Agreement agreement;
  for (int i = 0; i < motions; ++i) {
    const std::vector<double> from = randomConfiguration(a, random);
    std::vector<double> to = randomConfiguration(a, random);
    const double share = i % 3 == 0 ? 1.0 : 0.2;
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k] + share * (to[k] - from[k]);
    compare(a.checkState(from, ofA), b.checkState(from, ofB), agreement);
    const MotionQuery query = i % 2 == 0 ? MotionQuery::VerdictOnly : MotionQuery::FirstContact;
    const MotionCertificate first = a.certifyMotion(from, to, ofA, query);
    const MotionCertificate second = b.certifyMotion(from, to, ofB, query);
    compare(first.verdict, second.verdict, agreement);
  }
  return agreement;
}

inline std::shared_ptr<const World> shared(World world) {
  return std::make_shared<const World>(std::move(world));
}

/// Boxes, balls and rods around the arm.
inline World clutter(unsigned seed, int bodies = 10) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.7, 0.7);
  std::uniform_real_distribution<double> size(0.04, 0.13);
  World world;
  for (int i = 0; i < bodies; ++i) {
    Eigen::Isometry3d pose = at(place(random), place(random), 0.4 + 0.6 * place(random));
    // Nothing sits on the base from the start.
    if (pose.translation().norm() < 0.35) pose.translation().z() += 0.5;
    const std::string name = "body" + std::to_string(i);
    if (i % 3 == 0) world.add(name, Box{{size(random), size(random), size(random)}}, pose);
    if (i % 3 == 1) world.add(name, Sphere{size(random)}, pose);
    if (i % 3 == 2) world.add(name, Capsule{0.5 * size(random), 2.0 * size(random)}, pose);
  }
  return world;
}

}  // namespace swept::test
