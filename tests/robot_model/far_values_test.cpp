// SPDX-License-Identifier: BSD-3-Clause
// Bases up to 1e9 m away, a million turns, followers whose offset takes back what their master
// gives: nothing is free that is not, and what is free is proven if it is by more than the values
// in use round, 1e-12 of them.
#include "far_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace swept::far_test {
namespace {

TEST(FarValues, OfPlanarBases) {
  const Judge judge(
      robotOf(ball("cart") + joint("j", "planar", "base", "cart", "<axis xyz='0 0 1'/>")));
  Random random(1);
  judgeMany(judge, random, 400, [](Random& draw) {
    const double far = draw.scale(1.0, 1e9), aside = draw.uniform(-far, far);
    const double turn = draw.uniform(-3.0, 3.0);
    return Place{{far, aside, turn},
                 {far, aside, 0},
                 std::abs(far) + std::abs(aside),
                 {far - draw.scale(0.1, 10.0), aside, turn + 0.3}};
  });
}

TEST(FarValues, OfFloatingBases) {
  const Judge judge(robotOf(ball("drone") + joint("j", "floating", "base", "drone", "")));
  Random random(2);
  judgeMany(judge, random, 400, [](Random& draw) {
    const double far = draw.scale(1.0, 1e9), aside = draw.uniform(-far, far), up = 0.5 * aside;
    const Eigen::Quaterniond turn = draw.turn();
    std::vector<double> q{far, aside, up, turn.x(), turn.y(), turn.z(), turn.w()};
    Place place{q, {far, aside, up}, std::abs(far) + 2.0 * std::abs(aside)};
    q[0] -= draw.scale(0.1, 10.0);
    place.from = q;
    return place;
  });
}

TEST(FarValues, OfSlides) {
  const Judge judge(robotOf(ball("tip") + joint("j", "prismatic", "base", "tip", wide("1 0 0"))));
  Random random(3);
  judgeMany(judge, random, 400, [](Random& draw) {
    const double far = draw.scale(1e-3, 1e9);
    return Place{{far}, {far, 0, 0}, std::abs(far), {far - draw.scale(0.1, 10.0)}};
  });
}

/// Two of them in a row, far out and back again.
TEST(FarValues, OfSlidesThatCancel) {
  const Judge judge(robotOf("<link name='cart'/>" + ball("tip") +
                            joint("j", "prismatic", "base", "cart", wide("1 0 0")) +
                            joint("k", "prismatic", "cart", "tip", wide("1 0 0"))));
  Random random(8);
  judgeMany(judge, random, 400, [](Random& draw) {
    const double out = draw.scale(1.0, 1e9), back = draw.uniform(-1.0, 1.0) - out;
    return Place{{out, back},
                 {Digits(out) + Digits(back), 0, 0},
                 2.0 * out,
                 {out, back - draw.scale(0.1, 10.0)}};
  });
}

/// A ball 1 m from the axis, after up to 1e6 turns.
template <typename Angle>
void judgeTurns(const std::string& elements, unsigned seed, const Angle& angleOf) {
  const Judge judge(robotOf(elements));
  Random random(seed);
  judgeMany(judge, random, 300, [&](Random& draw) {
    const double turns = draw.scale(0.1, 1e6) * (draw.chance(0.5) ? 1.0 : -1.0);
    const double value = 2.0 * std::numbers::pi * turns;
    double used = 0.0;
    const Digits angle = angleOf(value, used);
    Place place{{value}, {cos(angle), sin(angle), 0}, used};
    const Eigen::Vector3d out(static_cast<double>(cos(angle)), static_cast<double>(sin(angle)),
                              0.0);
    place.ahead = Eigen::Vector3d::UnitZ().cross(out);
    const double back = value - draw.scale(0.01, 0.3);
    if (used <= std::abs(value) + 1.0) place.from = {back};
    return place;
  });
}

TEST(FarValues, OfTurns) {
  for (const std::string type : {"continuous", "revolute"}) {
    judgeTurns(
        ball("tip", "1 0 0") + joint("j", type, "base", "tip",
                                     type == "revolute" ? wide("0 0 1") : "<axis xyz='0 0 1'/>"),
        4, [](double value, double& used) {
          used = std::abs(value) + 1.0;
          return Digits(value);
        });
  }
}

TEST(FarValues, OfTurnsThatAnOffsetTakesBack) {
  for (const double factor : {3.0, -7.0, 1e3}) {
    std::ostringstream mimic;
    mimic.precision(17);
    mimic << "<mimic joint='j' multiplier='" << factor << "' offset='" << -factor * 1e6 << "'/>";
    judgeTurns("<link name='dial'/>" + ball("tip", "1 0 0") +
                   joint("j", "revolute", "base", "dial", wide("0 0 1")) +
                   joint("k", "revolute", "base", "tip", wide("0 0 1") + mimic.str()),
               5, [factor](double value, double& used) {
                 used = std::abs(factor * value) + std::abs(factor * 1e6) + 1.0;
                 return Digits(factor) * Digits(value) - Digits(factor * 1e6);
               });
  }
}

TEST(FarValues, OfSlidesThatAnOffsetTakesBack) {
  for (const double factor : {3.0, -0.7, 1e5}) {
    for (const double master : {10.0, 1e4, 1e8}) {
      const double offset = -factor * master;
      std::ostringstream mimic;
      mimic.precision(17);
      mimic << "<mimic joint='j' multiplier='" << factor << "' offset='" << offset << "'/>";
      const Judge judge(
          robotOf("<link name='knob'/>" + ball("tip") +
                  joint("j", "prismatic", "base", "knob", wide("0 0 1")) +
                  joint("k", "prismatic", "base", "tip", wide("1 0 0") + mimic.str())));
      Random random(6);
      judgeMany(judge, random, 60, [&](Random& draw) {
        const double q = master + draw.uniform(-1.0, 1.0) / std::abs(factor);
        const Digits at = Digits(factor) * Digits(q) + Digits(offset);
        const double used = std::abs(factor * q) + std::abs(offset);
        return Place{{q}, {at, 0, 0}, used, {q - draw.scale(0.1, 1.0) / factor}};
      });
    }
  }
}

}  // namespace
}  // namespace swept::far_test
