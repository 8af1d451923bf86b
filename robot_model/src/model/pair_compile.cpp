// SPDX-License-Identifier: BSD-3-Clause
#include "model/compile.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

#include "kinematics/common_ancestors.hpp"
#include "model/pair_model.hpp"
#include "model/pair_reasons.hpp"
#include "rules/name_pattern.hpp"
#include "swept/core/distance.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// m. More than the error of a norm whose squares underflow, and of values computed from it.
constexpr double kUnderflow = 1e-140;

/// Shapes nearer than the errors of their sources may be in contact.
bool touch(const Shape& a, const Shape& b, const Isometry3d& a_from_b, double sourceError) {
  if (sourceError > 0.0) return !(distance(a, b, a_from_b).lower > sourceError);
  return collide(a, b, a_from_b) != Contact::Separate;
}

/// Rounding of the relative pose of two geometries, in metres at their points: proportional to the
/// coordinates and to the number of multiplied transforms.
double poseRounding(double magnitudes, double transforms) {
  if (!(magnitudes < kLargestNorm)) return std::numeric_limits<double>::infinity();
  return tolerance::kRoundingPerJoint * magnitudes * (transforms + 2.0) + kUnderflow;
}

/// m. At rest: the rounding from a motion's translations is computed with the motion.
double magnitudeOf(const RobotGeometry& robot) {
  return std::max(robot.levers.spanAtRest, robot.magnitude);
}

class PairCompiler {
 public:
  explicit PairCompiler(PairModel& model)
      : model_(model),
        rules_(model.options.rules),
        ancestors_(model.kinematics),
        slots_(model.robotGeometry.size()) {}

  void compile() {
    for (const CollisionRules::Rule& rule : rules_.rules()) {
      requireKnown(rule.bodyA);
      if (!rule.bodyB.empty()) requireKnown(rule.bodyB);
    }
    for (const CollisionBody& collisionBody : model_.collisionBodies)
      paddings_.push_back(rules_.padding(collisionBody.name));
    firstOf_.assign(model_.collisionBodies.size() + 1, 0);
    for (const RobotGeometry& geometry : model_.robotGeometry)
      ++firstOf_[geometry.collisionBody + 1];
    std::partial_sum(firstOf_.begin(), firstOf_.end(), firstOf_.begin());
    pairWithWorld();
    indexWorldPairs();
    pairCarriers();
    model_.measuredPairs +=
        static_cast<std::int64_t>(model_.pairs.size()) - std::int64_t{model_.firstSelfPair};
    for (const GeometryPair& pair : model_.pairs) {
      model_.largestMargin = std::max(model_.largestMargin, pair.margin);
      model_.largestRounding = std::max(model_.largestRounding, pair.rounding);
      model_.largestSpan = std::max(model_.largestSpan, spanOf(model_, pair));
      model_.largestTransforms = std::max(model_.largestTransforms, transformsOf(model_, pair));
    }
  }

 private:
  void requireKnown(const std::string& name) const {
    const bool known = isPattern(name) ||
                       std::ranges::find(model_.collisionBodies, name, &CollisionBody::name) !=
                           model_.collisionBodies.end() ||
                       model_.world->find(name) != nullptr;
    if (!known) {
      throw std::invalid_argument("Checker: a rule names '" + name +
                                  "', which is no link, attached body or body of the world");
    }
  }

  template <typename Pair>
  void add(const Pair& pair, std::vector<Pair>& pairs, const char* what) const {
    if (pairs.size() == model_.options.maxPairs) {
      throw std::invalid_argument(
          "Checker: more than " + std::to_string(model_.options.maxPairs) + " pairs of " + what +
          " to check: the group has " + std::to_string(model_.robotGeometry.size()) +
          " shapes, the world " + std::to_string(model_.worldGeometry.size()));
    }
    pairs.push_back(pair);
  }

  double marginOf(const std::string& a, double paddingA, const std::string& b, double paddingB,
                  bool selfPair) const {
    const double margin = model_.options.marginOf(selfPair);
    if (rules_.empty()) return margin;
    const auto* rule = rules_.find(CollisionRules::Kind::Margin, a, b);
    return rule != nullptr ? rule->value : margin + paddingA + paddingB;
  }

  std::optional<bool> allowed(const std::string& a, const std::string& b) const {
    return rules_.empty() ? std::nullopt : rules_.allowed(a, b);
  }

  int motionBoundSlot(int geometry, int reference) {
    // The joints after the reference body.
    const auto first = static_cast<std::size_t>(ancestors_.depth(reference));
    std::vector<int>& slots = slots_[geometry];
    if (slots.size() <= first) slots.resize(first + 1, -1);
    if (slots[first] >= 0) return slots[first];
    slots[first] = static_cast<int>(model_.motionBounds.size());
    model_.motionBounds.push_back({geometry, first});
    return slots[first];
  }

  /// The largest distance of any point of the geometry from its first moving joint, if it is
  /// bounded.
  bool outOfReach(const RobotGeometry& robot, const WorldGeometry& world, double margin) const {
    for (const int i : robot.levers.path)
      if (slidesFreely(model_.kinematics.bodies[i].type)) return false;
    const MovingBody& base = model_.kinematics.bodies[robot.levers.path.front()];
    const Vector3d center = world.box_from_world * base.parent_from_joint.translation();
    const Vector3d outside = (center.cwiseAbs() - world.halfExtents).cwiseMax(Vector3d::Zero());
    // Anywhere within the limits: compileMotion refuses values beyond them.
    const double magnitude = std::max(robot.levers.span, robot.magnitude);
    const double slack = poseRounding(magnitude + world.magnitude, robot.transforms);
    return outside.stableNorm() >
           robot.levers.reachFromBase + margin + slack + robot.sourceError + world.sourceError;
  }

  void pairWithWorld() {
    const std::vector<WorldBody>& bodies = model_.world->bodies();
    std::vector<double> worldPaddings;
    for (const WorldBody& body : bodies) worldPaddings.push_back(rules_.padding(body.name));
    model_.firstBodyPair.assign(model_.collisionBodies.size(), -1);
    model_.likeWorldPairs.resize(model_.robotGeometry.size());
    for (std::size_t c = 0; c < model_.collisionBodies.size(); ++c) {
      const CollisionBody& collisionBody = model_.collisionBodies[c];
      if (collisionBody.kind == CollisionBody::Kind::Obstacle || firstOf_[c] == firstOf_[c + 1])
        continue;
      const std::size_t base = model_.bodyPairs.size();
      for (std::size_t k = 0; k < bodies.size(); ++k) {
        BodyPair pair{.a = static_cast<int>(c), .b = static_cast<int>(k)};
        pair.margin =
            marginOf(collisionBody.name, paddings_[c], bodies[k].name, worldPaddings[k], false);
        if (allowed(collisionBody.name, bodies[k].name).value_or(false))
          pair.reason = PairReason::Allowed;
        else
          pair.reason = collisionBody.body == 0 ? PairReason::Unmoved : PairReason::OutOfReach;
        add(pair, model_.bodyPairs, "bodies");
      }
      for (int i = firstOf_[c]; i < firstOf_[c + 1]; ++i)
        for (std::size_t j = 0; j < model_.worldGeometry.size(); ++j)
          pairWithPart(i, static_cast<int>(j),
                       model_.bodyPairs[base + model_.worldGeometry[j].body]);
      measureAll(c, base);
    }
  }

  void indexWorldPairs() {
    model_.firstWorldPair.assign(model_.robotGeometry.size() + 1, 0);
    for (const GeometryPair& pair : model_.pairs) ++model_.firstWorldPair[pair.a + 1];
    std::partial_sum(model_.firstWorldPair.begin(), model_.firstWorldPair.end(),
                     model_.firstWorldPair.begin());
    model_.firstSelfPair = static_cast<std::uint32_t>(model_.pairs.size());
  }

  void pairWithPart(int a, int b, BodyPair& bodies) {
    const RobotGeometry& robot = model_.robotGeometry[a];
    const WorldGeometry& world = model_.worldGeometry[b];
    if (bodies.reason == PairReason::Allowed) return;
    if (bodies.reason == PairReason::Unmoved) {
      bodies.touching =
          bodies.touching ||
          touch(robot.shape, world.shape, robot.body_from_shape.inverse() * world.world_from_shape,
                robot.sourceError + world.sourceError);
      return;
    }
    if (outOfReach(robot, world, bodies.margin)) return;
    bodies.reason = PairReason::Checked;
    GeometryPair pair;
    pair.a = a;
    pair.motionBoundA = motionBoundSlot(a, 0);
    pair.margin = bodies.margin;
    add(worldPair(model_, pair, b), model_.pairs, "shapes");
  }

  /// Verdicts leave out a piece that is out of reach, since they ask whether some piece comes near.
  /// A distance between two bodies is that of the nearest of all of their pieces: the nearest piece
  /// may be just out of reach, beside one that is in reach and far away.
  void measureAll(std::size_t collisionBody, std::size_t firstBodyPair) {
    double farthest = 0.0, sourceError = 0.0;
    std::int64_t parts = 0;
    for (const WorldGeometry& world : model_.worldGeometry) {
      if (model_.bodyPairs[firstBodyPair + world.body].reason != PairReason::Checked) continue;
      farthest = std::max(farthest, world.magnitude);
      sourceError = std::max(sourceError, world.sourceError);
      ++parts;
    }
    if (parts == 0) return;
    model_.firstBodyPair[collisionBody] = static_cast<int>(firstBodyPair);
    for (int i = firstOf_[collisionBody]; i < firstOf_[collisionBody + 1]; ++i) {
      const RobotGeometry& robot = model_.robotGeometry[i];
      GeometryPair& like = model_.likeWorldPairs[i];
      like.a = i;
      like.motionBoundA = motionBoundSlot(i, 0);
      like.rounding = poseRounding(magnitudeOf(robot) + farthest, robot.transforms) +
                      robot.sourceError + sourceError;
      model_.measuredPairs += parts;
    }
  }

  /// The body with which a frame fixed in `body` moves, and its frame from that of `body`.
  int movingBody(int body, Isometry3d& moving_from_body) const {
    moving_from_body.setIdentity();
    for (; body != 0 && model_.kinematics.bodies[body].type == JointType::Fixed;
         body = model_.kinematics.bodies[body].parent)
      moving_from_body = model_.kinematics.bodies[body].parent_from_joint * moving_from_body;
    return body;
  }

  void pairCarriers() {
    const std::set<std::pair<int, int>> disabled = disabledCarriers(model_);
    const std::size_t count = model_.collisionBodies.size();
    for (std::size_t a = 0; a < count; ++a) {
      // Obstacles come last, and are not checked against each other.
      if (model_.collisionBodies[a].kind == CollisionBody::Kind::Obstacle) break;
      const std::size_t base = model_.bodyPairs.size();
      for (std::size_t b = a + 1; b < count && firstOf_[a] < firstOf_[a + 1]; ++b)
        if (firstOf_[b] < firstOf_[b + 1])
          add(carrierPair(static_cast<int>(a), static_cast<int>(b), disabled), model_.bodyPairs,
              "bodies");
      ancestors_.setFirst(model_.collisionBodies[a].body);
      for (int i = firstOf_[a]; i < firstOf_[a + 1]; ++i)
        for (std::size_t k = base; k < model_.bodyPairs.size(); ++k)
          for (int j = firstOf_[model_.bodyPairs[k].b]; j < firstOf_[model_.bodyPairs[k].b + 1];
               ++j)
            pairGeometries(i, j, model_.bodyPairs[k]);
    }
  }

  BodyPair carrierPair(int a, int b, const std::set<std::pair<int, int>>& disabled) const {
    const CollisionBody& first = model_.collisionBodies[a];
    const CollisionBody& second = model_.collisionBodies[b];
    BodyPair pair{.a = a, .b = b, .ofRobot = true};
    const bool selfPair = second.kind != CollisionBody::Kind::Obstacle;
    pair.margin = marginOf(first.name, paddings_[a], second.name, paddings_[b], selfPair);
    const std::optional<bool> rule = allowed(first.name, second.name);
    Isometry3d ignored;
    if (rule.value_or(false))
      pair.reason = PairReason::Allowed;
    else if (!rule && disabled.contains({a, b}))
      pair.reason = PairReason::Disabled;
    else if (movingBody(first.body, ignored) == movingBody(second.body, ignored))
      pair.reason = PairReason::Rigid;
    return pair;
  }

  /// The first geometry belongs to the collision body whose body is the first one of `ancestors_`.
  void pairGeometries(int i, int j, BodyPair& bodies) {
    const RobotGeometry& a = model_.robotGeometry[i];
    const RobotGeometry& b = model_.robotGeometry[j];
    if (bodies.reason == PairReason::Rigid) {
      Isometry3d moving_from_a;
      Isometry3d moving_from_b;
      movingBody(a.body, moving_from_a);
      movingBody(b.body, moving_from_b);
      bodies.touching = bodies.touching || touch(a.shape, b.shape,
                                                 (moving_from_a * a.body_from_shape).inverse() *
                                                     moving_from_b * b.body_from_shape,
                                                 a.sourceError + b.sourceError);
    }
    if (bodies.reason != PairReason::Checked) return;
    GeometryPair pair;
    pair.self = true;
    pair.a = i;
    pair.b = j;
    pair.reference = ancestors_.with(b.body);
    pair.motionBoundA = motionBoundSlot(i, pair.reference);
    pair.motionBoundB = motionBoundSlot(j, pair.reference);
    pair.sourceError = a.sourceError + b.sourceError;
    pair.rounding = poseRounding(magnitudeOf(a) + magnitudeOf(b), a.transforms + b.transforms) +
                    pair.sourceError;
    pair.margin = bodies.margin;
    add(pair, model_.pairs, "shapes");
  }

  PairModel& model_;
  const CollisionRules& rules_;
  std::vector<double> paddings_;  ///< m, per collision body
  std::vector<int> firstOf_;      ///< per collision body: of its geometry, the first
  CommonAncestors ancestors_;
  /// Per geometry and number of joints before the first that counts: index into motionBounds; -1:
  /// none yet.
  std::vector<std::vector<int>> slots_;
};

}  // namespace

void compilePairs(PairModel& model) {
  PairCompiler(model).compile();
}

GeometryPair worldPair(const PairModel& model, const GeometryPair& like, int worldGeometry) {
  const RobotGeometry& robot = model.robotGeometry[like.a];
  const double magnitudes = magnitudeOf(robot) + model.worldGeometry[worldGeometry].magnitude;
  GeometryPair pair = like;
  pair.b = worldGeometry;
  pair.sourceError = robot.sourceError + model.worldGeometry[worldGeometry].sourceError;
  pair.rounding = poseRounding(magnitudes, robot.transforms) + pair.sourceError;
  return pair;
}

}  // namespace swept::detail
