// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "../core/mesh_samples.hpp"
#include "swept/robot_model/checker.hpp"
#include "version_arms.hpp"

/// Levers whose ends go side by side, at the same speed, and bend towards each other: nothing but
/// what bounds how much the ways bend says that they meet.
namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::uniform;

enum class End { Ball, Box };

std::string endOf(End end) {
  return end == End::Ball ? test::sphere(0.03125) : test::box(0.0625, 0.0625, 0.0625);
}

std::string jointAt(const std::string& name, const std::string& parent, const std::string& child,
                    double x, int limit = 30) {
  const std::string most = std::to_string(limit);
  return test::urdfJoint(name, "revolute", parent, child,
                         "<origin xyz='" + std::to_string(x) +
                             " 0 0'/><axis xyz='0 0 1'/><limit lower='-" + most + "' upper='" +
                             most + "' effort='1' velocity='1'/>");
}

/// m, of the hub.
struct Lever {
  double joint, length;
};

/// A hub that turns, and on it levers, each with something at its end. With wrists, what is at the
/// end turns about its middle.
std::shared_ptr<const Robot> levers(End end, double hub, const std::vector<Lever>& all, int limit,
                                    bool wrists) {
  std::string urdf = "<robot name='levers'>" + test::urdfLink("base", {}) +
                     test::urdfLink("hub", {}) + jointAt("hub_joint", "base", "hub", hub);
  for (const Lever& lever : all) {
    const std::string name = &lever == &all.front() ? "a" : "b";
    const Vector3d middle(lever.length, 0.0, 0.0);
    urdf += jointAt(name + "_joint", "hub", name, lever.joint, limit);
    urdf += wrists ? test::urdfLink(name, {}) +
                         test::urdfLink(name + "_hand", {{endOf(end), Vector3d::Zero()}}) +
                         jointAt(name + "_wrist", name, name + "_hand", lever.length)
                   : test::urdfLink(name, {{endOf(end), middle}});
  }
  return Robot::parse(urdf + "</robot>", "levers.urdf");
}

/// Exact as a text of six digits.
double coarse(double value) {
  return std::round(64.0 * value) / 64.0;
}

struct Tally {
  int contacts = 0;  ///< but for those at the beginning
  int free = 0;
  int undecided = 0;  ///< within the tolerance of grazing
};

/// Whoever meets somebody stays there for a while, and was apart until then.
void expectFreeUntilContact(const Checker& checker, const std::vector<double>& from,
                            const std::vector<double>& to, Tally& tally) {
  Workspace workspace(checker);
  const MotionCertificate certificate = checker.certifyMotion(from, to, workspace);
  tally.undecided += certificate.verdict == Verdict::Undecided ? 1 : 0;
  tally.free += certificate.verdict == Verdict::Free ? 1 : 0;
  tally.contacts += certificate.freeUntil > 0.01 && certificate.freeUntil < 1.0 ? 1 : 0;
  const auto expectFree = [&](double t) {
    const Eigen::VectorXd q = checker.interpolate(from, to, t);
    ASSERT_NE(checker.checkState(q, workspace), Verdict::Collision)
        << t << " is before " << certificate.freeUntil;
  };
  for (double t = 0.0; t < certificate.freeUntil; t += 0.005) expectFree(t);
  for (double before = 0.125; before > 1e-7; before *= 0.5)
    if (before < certificate.freeUntil) expectFree(certificate.freeUntil - before);
}

/// Within [0, 1], and angles about the one at that time.
struct Turn {
  double at, speed;
  double from(double angle) const { return angle - at * speed; }
  double to(double angle) const { return angle + (1.0 - at) * speed; }
};

/// The end, whether the hub turns, and whether there are wrists. Without these the links have a
/// table of where they meet.
class FirstContact : public testing::TestWithParam<std::tuple<End, bool, bool>> {};

TEST_P(FirstContact, OfTwoLinks) {
  const auto [end, hubTurns, wrists] = GetParam();
  std::mt19937 random(51);
  Tally tally;
  for (int i = 0; i < 400; ++i) {
    const double lengthA = coarse(uniform(random, 0.25, 2.0));
    const double lengthB = coarse(uniform(random, 0.25, 2.0));
    const double apart = 0.0625 + coarse(std::pow(10.0, uniform(random, -1.8, -0.5)));
    const double at = uniform(random, 0.1, 0.9);
    const double speed = std::pow(10.0, uniform(random, -1.0, 1.0));
    const Turn a{at, -speed / lengthA};
    const Turn b{at, uniform(random, 0.9, 1.1) * speed / lengthB};
    const Turn hub{at, hubTurns ? uniform(random, -3.0, 3.0) : 0.0};
    std::vector<double> from{hub.from(0.4), a.from(std::numbers::pi), b.from(0.0)};
    std::vector<double> to{hub.to(0.4), a.to(std::numbers::pi), b.to(0.0)};
    double most = 0.0;
    for (const double q : {from[1], from[2], to[1], to[2]}) most = std::max(most, std::abs(q));
    if (wrists) {
      for (std::vector<double>* ends : {&from, &to})
        *ends = {(*ends)[0], (*ends)[1], 0.3, (*ends)[2], -0.2};
    }
    // a, turned by pi, reaches to the left as far as 0, and b to the right as far as `apart`: past
    // each other, with the ends side by side.
    const auto robot = levers(end, coarse(uniform(random, -1.0, 1.0)),
                              {{lengthA, lengthA}, {apart - lengthB, lengthB}},
                              static_cast<int>(most) + 1, wrists);
    const Checker checker(robot, "all", std::make_shared<const World>());
    expectFreeUntilContact(checker, from, to, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.contacts, 100);
  EXPECT_GT(tally.free, 20);
  EXPECT_LT(tally.undecided, 20);
}

TEST_P(FirstContact, OfALinkAndTheWorld) {
  const auto [end, hubTurns, wrists] = GetParam();
  std::mt19937 random(52);
  Tally tally;
  for (int i = 0; i < 400; ++i) {
    const double length = coarse(uniform(random, 0.25, 2.0));
    const double hubAt = hubTurns ? -coarse(uniform(random, 0.0, 1.0)) : 0.0;
    const Checker alone(levers(end, hubAt, {{-hubAt, length}}, 30, wrists), "all",
                        std::make_shared<const World>());
    // Inside of the circle of the lever's end, or of both turning as one.
    const double inside = uniform(random, -0.02, 0.1);
    const double angle = uniform(random, -1.0, 1.0);
    const Vector3d place((length - inside) * std::cos(angle), (length - inside) * std::sin(angle),
                         0.0);
    World world;
    world.add(
        "post",
        end == End::Ball ? Shape(makeSphere(0.03125)) : Shape(makeBox({0.0625, 0.0625, 0.0625})),
        Isometry3d(Eigen::Translation3d(place)));
    const Checker checker = alone.withWorld(std::make_shared<const World>(std::move(world)));
    const double speed = std::pow(10.0, uniform(random, -0.5, 1.0));
    const Turn a{uniform(random, 0.1, 0.9), uniform(random, 0.0, 1.0) < 0.5 ? speed : -speed};
    const Turn hub{a.at, hubTurns ? 0.2 * a.speed : 0.0};
    std::vector<double> from{hub.from(0.0), a.from(angle)}, to{hub.to(0.0), a.to(angle)};
    if (wrists) {
      from.push_back(0.3);
      to.push_back(0.3);
    }
    expectFreeUntilContact(checker, from, to, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.contacts, 100);
  EXPECT_GT(tally.free, 20);
  EXPECT_LT(tally.undecided, 20);
}

INSTANTIATE_TEST_SUITE_P(Levers, FirstContact,
                         testing::Combine(testing::Values(End::Ball, End::Box), testing::Bool(),
                                          testing::Bool()));

}  // namespace
}  // namespace swept
