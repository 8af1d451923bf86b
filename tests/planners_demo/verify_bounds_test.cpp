// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <random>
#include <set>

#include "models_dir.hpp"
#include "program.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "verify/intervals.hpp"
#include "verify/proof.hpp"

/// What the checker of proofs computes, against the library that it shares nothing with.
namespace swept::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

struct Subject {
  const char* robot;
  const char* group;
  const char* start;
  const char* goal;
  const char* scene;
};

/// Revolute, planar, floating and mimicking joints; tables and meshes.
constexpr Subject kSubjects[] = {
    {"rook7/rook7", "arm", "home", "ready", "shelf"},
    {"rook6_cart/rook6_cart", "whole_body", "-1.5,0,0,0,-0.6,1.2,-0.6,0,0",
     "-1.2,0.3,1,0.5,-0.5,1.75,0.32,-1.57,0", "table_objects"},
    {"drifter/drifter", "body", "home", "0.9,0.5,1.5,0,0.6,0,0.8", "table_objects"},
};

class VerifyBounds : public testing::TestWithParam<Subject> {
 protected:
  VerifyBounds() {
    const std::string base = modelsDir() + "/robots/" + GetParam().robot;
    const std::string scene = modelsDir() + "/scenes/" + GetParam().scene + ".yaml";
    const TemporaryFolder folder;
    const Outcome run = runSwept({"plan", base + ".urdf", GetParam().start, GetParam().goal,
                                  "--group", GetParam().group, "--scene", scene, "--embed", "-q",
                                  "-o", folder.path("path.json")});
    EXPECT_EQ(run.exitCode, 0) << run.out << run.err;
    path_ = Json::parse(folder.read("path.json"));
    model_ = verify::readModel(path_["model"]);
    robot_ = Robot::load(base + ".urdf", base + ".srdf");
    checker_ = std::make_unique<Checker>(robot_, GetParam().group,
                                         std::make_shared<const World>(World::load(scene)));
  }

  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random_);
  }
  /// Within the limits; up to a metre and a turn where there are none.
  std::vector<double> randomState() {
    std::vector<double> q;
    for (const int v : checker_->group().variables) {
      const Variable& variable = robot_->variables()[v];
      q.push_back(uniform(std::max(variable.lower, -3.1), std::min(variable.upper, 3.1)));
    }
    return q;
  }
  /// On the way to another random state, so that motions of all lengths come up.
  std::vector<double> near(const std::vector<double>& q) {
    const std::vector<double> other = randomState();
    const double share = std::pow(uniform(0.0, 1.0), 3.0);
    std::vector<double> result;
    for (std::size_t i = 0; i < q.size(); ++i) result.push_back(q[i] + share * (other[i] - q[i]));
    return result;
  }

  Json path_;
  verify::Model model_;
  std::shared_ptr<const Robot> robot_;
  std::unique_ptr<Checker> checker_;
  std::mt19937_64 random_{7};
};

TEST_P(VerifyBounds, TheSamePairsAreProvenAsAreChecked) {
  std::set<std::string> wanted, proven;
  for (const Checker::Pair& pair : checker_->checkedPairs())
    wanted.insert(pair.bodyA + " - " + pair.bodyB);
  for (const Checker::Pair& pair : checker_->skippedPairs())
    if (pair.reason == "out of reach") wanted.insert(pair.bodyA + " - " + pair.bodyB);
  for (const verify::PairToProve& pair : verify::pairsToProve(model_))
    proven.insert(model_.bodies[pair.a].name() + " - " + model_.bodies[pair.b].name());
  EXPECT_GE(wanted.size(), 10u);
  EXPECT_EQ(proven, wanted);
}

TEST_P(VerifyBounds, LinksMoveAsTheLibraryHasThem) {
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> from = randomState(), to = randomState();
    const verify::Motion motion(model_, from, to);
    const double t = uniform(0.0, 1.0);
    for (std::size_t link = 0; link < model_.links.size(); ++link) {
      const LinkMotion truth(*robot_, GetParam().group, model_.links[link], from, to);
      const verify::Placed placed = motion.at(static_cast<int>(link), -1, t);
      EXPECT_LE((placed.reference_from_link.matrix() - truth.at(t).matrix()).norm(), 1e-12);
      const Twist twist = truth.velocity(t);
      const Vector3d origin = placed.reference_from_link.translation();
      EXPECT_LE((placed.angular - twist.angular).norm(), 1e-11);
      EXPECT_LE((placed.linear + placed.angular.cross(origin) - twist.linear).norm(), 1e-10);
    }
  }
}

/// Points on an element, among them those farthest along some directions.
std::vector<Vector3d> pointsOf(const verify::Element& element, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<Vector3d> points;
  for (int i = 0; i < 12; ++i) {
    const Vector3d way = Vector3d(normal(random), normal(random), normal(random)).normalized();
    Vector3d best = Vector3d::Constant(1e9);
    const auto offer = [&](const Vector3d& point) {
      if (best.x() == 1e9 || way.dot(point) > way.dot(best)) best = point;
    };
    for (const Vector3d& point : element.points) offer(point);
    for (const auto& disc : element.discs)
      offer(disc.center + disc.radius * (way - way.dot(disc.axis) * disc.axis).normalized());
    if (element.ellipsoid) {
      const Vector3d local = element.ellipsoid->axes.transpose() * way;
      offer(element.ellipsoid->center + element.ellipsoid->axes * local.normalized());
    }
    points.push_back(best + element.radius * way);
  }
  return points;
}

/// At sampled times of the interval no sampled point of the node is nearer to the flat than the
/// gap.
TEST_P(VerifyBounds, NoPointsComeNearerToAFlatThanAGap) {
  const auto robotsBodies =
      static_cast<std::size_t>(std::ranges::find(model_.linkOf, -1) - model_.linkOf.begin());
  int positive = 0, tight = 0, atBegin = 0;
  constexpr int kCases = 1500;
  for (int i = 0; i < kCases; ++i) {
    const std::vector<double> from = randomState(), to = near(from);
    verify::Model model = model_;
    const Vector3d normal =
        Vector3d(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)).normalized();
    const verify::Flat flat{normal, uniform(-1.0, 1.0), false};
    model.bodies.emplace_back("wall", std::vector<verify::Element>{}, std::vector{flat},
                              std::vector<verify::Surface>{});
    model.linkOf.push_back(-1);
    model.paddings.push_back(0.0);
    const auto body = static_cast<int>(random_() % robotsBodies);
    const verify::Body& a = model.bodies[body];
    const auto node = static_cast<int>(random_() % a.nodes().size());
    const double begin = uniform(0.0, 1.0), end = std::min(1.0, begin + std::pow(uniform(0, 1), 2));
    const verify::Motion motion(model, from, to);
    const verify::PairMotion between(model, motion,
                                     {body, static_cast<int>(model.bodies.size()) - 1}, begin, end);
    const int side = uniform(-1.0, 1.0) < 0.0 ? -1 : 1;
    const auto least = [&](double t) {
      const Isometry3d pose =
          LinkMotion(*robot_, GetParam().group, model.links[model.linkOf[body]], from, to).at(t);
      double distance = INFINITY;
      const verify::Body::Node& range = a.nodes()[node];
      const std::size_t stride = 1 + (range.last - range.first) / 8;
      for (std::size_t e = range.first; e < range.last; e += stride)
        for (const Vector3d& point : pointsOf(a.elements()[e], random_))
          distance = std::min(distance, side * (normal.dot(pose * point) - flat.offset));
      return distance;
    };
    const double first = least(begin);
    double sampled = first;
    for (const double share : {1.0, uniform(0.0, 1.0), uniform(0.0, 1.0)})
      sampled = std::min(sampled, least(begin + share * (end - begin)));
    const double gap = between.gapToFlat(node, 0, side);
    if (!(gap > 0.0)) continue;
    ++positive;
    tight += gap > 0.5 * sampled ? 1 : 0;
    atBegin += sampled == first ? 1 : 0;
    ASSERT_LE(gap, sampled) << a.name() << ", " << begin << " to " << end;
  }
  EXPECT_GE(positive, kCases / 8);
  EXPECT_GE(tight, positive / 4);
  EXPECT_GE(atBegin, positive / 8);
  EXPECT_LE(atBegin, positive - positive / 8);
}

/// At sampled times of the interval no two sampled points of the two nodes are nearer than the gap.
TEST_P(VerifyBounds, NoPointsComeNearerThanAGap) {
  const std::vector<verify::PairToProve> pairs = verify::pairsToProve(model_);
  int positive = 0, tight = 0;
  constexpr int kCases = 1500;
  for (int i = 0; i < kCases; ++i) {
    const std::vector<double> from = randomState(), to = near(from);
    const verify::Motion motion(model_, from, to);
    const verify::PairToProve pair = pairs[random_() % pairs.size()];
    const verify::Body& a = model_.bodies[pair.a];
    const verify::Body& b = model_.bodies[pair.b];
    if (b.nodes().empty()) continue;
    const auto nodeA = static_cast<int>(random_() % a.nodes().size());
    const auto nodeB = static_cast<int>(random_() % b.nodes().size());
    const double begin = uniform(0.0, 1.0), end = std::min(1.0, begin + std::pow(uniform(0, 1), 2));
    const verify::PairMotion between(model_, motion, pair, begin, end);
    const auto placedPoints = [&](const verify::Body& body, int node, int link, double t) {
      Isometry3d pose = Isometry3d::Identity();
      if (link >= 0)
        pose = LinkMotion(*robot_, GetParam().group, model_.links[link], from, to).at(t);
      std::vector<Vector3d> points;
      const verify::Body::Node& range = body.nodes()[node];
      const std::size_t stride = 1 + (range.last - range.first) / 8;
      for (std::size_t e = range.first; e < range.last; e += stride)
        for (const Vector3d& point : pointsOf(body.elements()[e], random_))
          points.push_back(pose * point);
      return points;
    };
    const auto least = [&](double t) {
      double distance = INFINITY;
      const auto ofB = placedPoints(b, nodeB, model_.linkOf[pair.b], t);
      for (const Vector3d& p : placedPoints(a, nodeA, model_.linkOf[pair.a], t))
        for (const Vector3d& q : ofB) distance = std::min(distance, (p - q).norm());
      return distance;
    };
    double sampled = INFINITY;
    for (const double share : {0.0, 1.0, uniform(0.0, 1.0), uniform(0.0, 1.0)})
      sampled = std::min(sampled, least(begin + share * (end - begin)));
    const Vector3d way = placedPoints(b, nodeB, model_.linkOf[pair.b], begin).front() -
                         placedPoints(a, nodeA, model_.linkOf[pair.a], begin).front();
    // In the frame that the pair is seen from.
    const int reference =
        model_.linkOf[pair.b] < 0
            ? -1
            : verify::commonAncestor(model_, model_.linkOf[pair.a], model_.linkOf[pair.b]);
    const Isometry3d model_from_reference =
        reference < 0 ? Isometry3d::Identity()
                      : LinkMotion(*robot_, GetParam().group, model_.links[reference], from, to)
                            .at(0.5 * (begin + end));
    const double gap = between.gap(nodeA, nodeB, model_from_reference.linear().transpose() * way);
    if (!(gap > 0.0)) continue;
    ++positive;
    tight += gap > 0.5 * sampled ? 1 : 0;
    ASSERT_LE(gap, sampled) << a.name() << " - " << b.name() << ", " << begin << " to " << end;
  }
  EXPECT_GE(positive, kCases / 4);
  EXPECT_GE(tight, positive / 4);
}

/// The bound on accelerations, against differences of places along the motion.
TEST_P(VerifyBounds, NoPointAcceleratesMore) {
  double largestShare = 0.0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<double> from = randomState(), to = randomState();
    const verify::Motion motion(model_, from, to);
    for (std::size_t k = 0; k < model_.bodies.size(); ++k) {
      const int link = model_.linkOf[k];
      if (link < 0) continue;
      const verify::Bounds bounds = motion.bounds(link, -1, model_.bodies[k].reach(), 0.5, 0.5);
      const double most = 4.0 * bounds.acceleration;  // per unit of t, of which it is half
      const LinkMotion truth(*robot_, GetParam().group, model_.links[link], from, to);
      constexpr double kStep = 1e-3;
      const double t = uniform(kStep, 1.0 - kStep);
      for (const Vector3d& point : pointsOf(model_.bodies[k].elements().front(), random_)) {
        const Vector3d change = (truth.at(t + kStep) * point - 2.0 * (truth.at(t) * point) +
                                 truth.at(t - kStep) * point) /
                                (kStep * kStep);
        EXPECT_LE(change.norm(), most * (1.0 + 1e-6) + 1e-6);
        EXPECT_LE((truth.at(t) * point).norm(), bounds.extent * (1.0 + 1e-9));
        if (most > 0.0) largestShare = std::max(largestShare, change.norm() / most);
      }
    }
  }
  EXPECT_GE(largestShare, 0.3) << "a bound that is never near says little";
}

INSTANTIATE_TEST_SUITE_P(Robots, VerifyBounds, testing::ValuesIn(kSubjects));

}  // namespace
}  // namespace swept::test
