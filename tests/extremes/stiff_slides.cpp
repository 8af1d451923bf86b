// SPDX-License-Identifier: BSD-3-Clause
#include <boost/math/constants/constants.hpp>

#include "stiff_sample.hpp"

namespace extremes {

namespace {

/// A ball that slides along x towards a plate, or past it.
struct Slide {
  double ball = 0.05;       ///< m
  double thickness = 1e-3;  ///< m
  double to = 10.0;         ///< m, from 0
  double plate = 5.0;       ///< m, its middle
  double beside = 0.0;      ///< m, between the ball's way and the plate's edge; 0: in the way
};

StiffSample sampleOf(const Slide& slide) {
  StiffSample sample;
  const double half = 0.5 * slide.thickness;
  const double wide = 1.0;
  const double y = slide.beside > 0.0 ? slide.ball + slide.beside + wide : 0.0;
  swept::World world;
  world.add("plate", swept::Box{{half, wide, wide}},
            Isometry3d(Eigen::Translation3d(slide.plate, y, 0.0)));
  sample.checker =
      checkerOf(chainWithBall({{"prismatic", Vector3d::UnitX()}}, Vector3d::Zero(), slide.ball),
                std::move(world), 1e-5);
  sample.from = {0.0};
  sample.to = {slide.to};
  sample.distance = [=](const Real& t) {
    const Real x = abs(Real(slide.plate) - t * Real(slide.to)) - half;
    const Real aside = Real(y) - wide;
    if (slide.beside == 0.0) return Real(x - slide.ball);
    return Real((x > 0 ? sqrt(x * x + aside * aside) : aside) - slide.ball);
  };
  const Real met = Real(slide.plate) - half - slide.ball;
  if (slide.beside == 0.0 && met <= slide.to) sample.contact = met / slide.to;
  const Real middle = std::min(Real(1), Real(slide.plate) / slide.to);
  sample.least = sample.distance(middle);
  sample.reach = slide.to;
  sample.path = slide.to;
  return sample;
}

StiffCase thin(const std::string& name, double thickness, double workLimit) {
  return {name, "ordinary turn", workLimit, [thickness](Random& random, int i) {
            Slide slide;
            slide.thickness = thickness;
            // The smallest balls are as thin as the plate.
            slide.ball = std::max(thickness, random.decades(-6.0, -1.0));
            slide.plate = random.uniform(1.0, 9.0);
            if (i % 4 == 0) slide.beside = random.decades(-4.0, -1.0);
            if (i % 4 == 2) slide.to = slide.plate - slide.ball - random.decades(-2.0, -1.0);
            return sampleOf(slide);
          }};
}

/// A hundred links in zigzag, which stretches out to a wall: the tip is 100 l cos(angle) away.
StiffSample zigzag(Random& random, int i) {
  constexpr int kLinks = 100;
  const double link = 0.0625;
  const double ball = 0.03125;
  const double first = random.uniform(1.0, 1.4);
  const double last = random.uniform(0.1, 0.6);
  std::vector<ChainJoint> joints;
  for (int k = 0; k < kLinks; ++k) {
    joints.push_back({"revolute", Vector3d::UnitZ(), Vector3d(k == 0 ? 0.0 : link, 0.0, 0.0)});
  }
  const auto angles = [&](double angle) {
    std::vector<double> q(kLinks, angle);
    for (int k = 1; k < kLinks; ++k) q[k] = k % 2 == 1 ? -2.0 * angle : 2.0 * angle;
    return q;
  };
  const double nearest = random.decades(-3.0, -1.0);
  const double wall = kLinks * link * std::cos(last) + ball + (i % 2 == 0 ? nearest : -nearest);
  swept::World world;
  world.add("wall", swept::HalfSpace{-Vector3d::UnitX(), -wall}, Isometry3d::Identity());
  StiffSample sample;
  sample.checker =
      checkerOf(chainWithBall(joints, Vector3d(link, 0.0, 0.0), ball), std::move(world), 1e-4);
  sample.from = angles(first);
  sample.to = angles(last);
  const Real length = Real(link) * kLinks;
  sample.distance = [=](const Real& t) {
    const Real angle = Real(first) + t * (Real(last) - first);
    return Real(Real(wall) - ball - length * cos(angle));
  };
  sample.least = sample.distance(1);
  if (sample.least <= 0) {
    const Real angle = acos((Real(wall) - ball) / length);
    sample.contact = (Real(first) - angle) / (Real(first) - last);
  }
  sample.reach = kLinks * link;
  sample.path = kLinks * link;
  return sample;
}

/// A base that floats turns by almost pi, or by pi, about z; beside it there are posts, to either
/// side, as a turn by pi may go either way. Quaternions of any length.
StiffSample floating(Random& random, int i) {
  const double lever = 1.0;
  const double ball = 0.0625;
  const double post = 0.0625;
  const double gap = i % 2 == 0 ? random.decades(-3.0, -1.0) : -random.decades(-3.0, -1.5);
  const double away = lever + ball + post + gap;
  const double less = i % 3 == 0 ? 0.0 : random.decades(-9.0, -1.0);
  const Eigen::Vector4d ends(0.0, 1.0, std::cos(0.5 * less), std::sin(0.5 * less));
  swept::World world;
  world.add("left", swept::Cylinder{post, 1.0}, Isometry3d(Eigen::Translation3d(0.0, away, 0.0)));
  world.add("right", swept::Cylinder{post, 1.0}, Isometry3d(Eigen::Translation3d(0.0, -away, 0.0)));
  StiffSample sample;
  sample.checker =
      checkerOf(chainWithBall({{"floating"}}, Vector3d(lever, 0, 0), ball), std::move(world), 1e-5);
  const double scale = random.decades(-3.0, 3.0);
  sample.from = {0, 0, 0, 0, 0, scale * ends[0], scale * ends[1]};
  sample.to = {0, 0, 0, 0, 0, ends[2], ends[3]};
  const Real angle = 2 * atan2(Real(ends[2]), Real(ends[3]));
  const Real& quarter = boost::math::constants::half_pi<Real>();
  const auto distanceAt = [=](const Real& turned) {
    const Real half = (turned - quarter) / 2;
    const Real between = Real(away) - lever;
    const Real s = sin(half);
    return Real(sqrt(between * between + 4 * Real(away) * lever * s * s) - ball - post);
  };
  sample.distance = [=](const Real& t) { return distanceAt(t * angle); };
  sample.least = distanceAt(quarter);
  if (sample.least <= 0) {
    const Real between = Real(away) - lever;
    const Real radii = Real(ball) + post;
    const Real s = sqrt((radii * radii - between * between) / (4 * Real(away) * lever));
    sample.contact = (quarter - 2 * asin(s)) / angle;
  }
  sample.path = lever * angle.convert_to<double>();
  return sample;
}

}  // namespace

std::vector<StiffCase> slideCases() {
  return {thin("plates 1e-3 m thick", 1e-3, 10.0),
          thin("plates 1e-6 m thick", 1e-6, 10.0),
          {"a chain of 100 joints", "ordinary turn", 30.0, zigzag},
          {"a floating base turns by pi", "ordinary turn", 10.0, floating}};
}

}  // namespace extremes
