// SPDX-License-Identifier: BSD-3-Clause
#include "report/shape_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "swept/core/signed_distance.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace swept {
namespace {

/// A shape where it is in a state.
struct PlacedShape {
  const Shape* shape;
  Eigen::Isometry3d model_from_shape;
};

/// None: the robot has no such link.
std::vector<PlacedShape> shapesOfLink(const Checker& checker, const std::string& name,
                                      const std::vector<double>& q) {
  std::vector<PlacedShape> shapes;
  const Robot& robot = checker.robot();
  const std::optional<int> link = robot.findLink(name);
  if (!link) return shapes;
  const LinkMotion still(robot, checker.group().name, name, q, q, checker.options().reference);
  const Eigen::Isometry3d model_from_link = still.at(0.0);
  for (const CollisionGeometry& geometry : robot.links()[*link].collision)
    shapes.push_back({&geometry.shape, model_from_link * geometry.link_from_shape});
  return shapes;
}

std::vector<PlacedShape> shapesInWorld(const Checker& checker, const std::string& name) {
  std::vector<PlacedShape> shapes;
  if (const WorldBody* found = checker.world().find(name))
    for (const WorldBody::Part& part : found->parts)
      shapes.push_back({&part.shape, part.world_from_shape});
  return shapes;
}

struct ShapeQuery {
  const Shape* a;
  const Shape* b;
  Eigen::Isometry3d a_from_b;
  SignedDistanceResult truth;
};

/// The nearest, or deepest, shapes of a link and another, or else a body of the world.
std::optional<ShapeQuery> nearestShapes(const Checker& checker, const std::string& bodyA,
                                        const std::string& bodyB, bool selfPair,
                                        const std::vector<double>& q) {
  std::optional<ShapeQuery> nearest;
  for (const PlacedShape& a : shapesOfLink(checker, bodyA, q)) {
    for (const PlacedShape& b :
         selfPair ? shapesOfLink(checker, bodyB, q) : shapesInWorld(checker, bodyB)) {
      const Eigen::Isometry3d a_from_b = a.model_from_shape.inverse() * b.model_from_shape;
      const SignedDistanceResult truth = signedDistance(*a.shape, *b.shape, a_from_b);
      if (!nearest || truth.lower < nearest->truth.lower)
        nearest = ShapeQuery{a.shape, b.shape, a_from_b, truth};
    }
  }
  return nearest;
}

void askAll(LengthTally& tally, const std::vector<ShapeQuery>& queries, int passes,
            const Stopwatch& stopwatch, const ReportTick& tick) {
  struct Result {
    SignedDistanceResult answer;
    double time = std::numeric_limits<double>::infinity();
  };
  const std::vector<ReportMethod>& methods = tally.methods();
  std::vector<std::vector<Result>> results(methods.size(), std::vector<Result>(queries.size()));
  const auto ask = [&](std::size_t method, std::size_t i) {
    const ShapeQuery& query = queries[i];
    Result& result = results[method][i];
    const double taken = stopwatch.time([&] {
      result.answer = signedDistance(*query.a, *query.b, query.a_from_b, methods[method].setting);
    });
    result.time = std::min(result.time, taken);
  };
  inTurns(methods.size(), queries.size(), passes, ask, tick);
  for (std::size_t method = 0; method < methods.size(); ++method) {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Result& result = results[method][i];
      tally.add(method,
                {.error = std::abs(result.answer.lower - queries[i].truth.lower),
                 .bound = result.answer.upper - result.answer.lower},
                result.time);
    }
  }
}

}  // namespace

void addShapePairs(LengthTally& distances, LengthTally& penetrations, const Checker& truth,
                   RandomMotions& random, std::size_t states, int passes,
                   const Stopwatch& stopwatch, const ReportTick& tick) {
  Workspace workspace(truth);
  std::vector<ShapeQuery> apart, deep;
  for (std::size_t i = 0; i < states; ++i) {
    const std::vector<double> q = random.state();
    const StateReport report = truth.reportState(q, workspace);
    const bool contact = !report.contacts.empty();
    const std::string& bodyA = contact ? report.contacts.front().bodyA : report.nearestA;
    const std::string& bodyB = contact ? report.contacts.front().bodyB : report.nearestB;
    const bool selfPair = contact ? report.contacts.front().selfPair : report.nearestSelfPair;
    const std::optional<ShapeQuery> query = nearestShapes(truth, bodyA, bodyB, selfPair, q);
    // Finite answers only: a half-space may reach everywhere.
    if (query && std::isfinite(query->truth.lower))
      (query->truth.upper > 0.0 ? apart : deep).push_back(*query);
    tick(0);
  }
  askAll(distances, apart, passes, stopwatch, tick);
  askAll(penetrations, deep, passes, stopwatch, tick);
}

}  // namespace swept
