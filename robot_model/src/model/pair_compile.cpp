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
#include "threads/for_each_index.hpp"

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
    reserveBodyPairs();
    pairWithWorld();
    pairCarriers();
    model_.measuredPairs += static_cast<std::int64_t>(model_.pairs.size());
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
  void add(const Pair& pair, std::vector<Pair>& pairs, std::size_t others, const char* what) const {
    if (others + pairs.size() == model_.options.maxPairs) {
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

  /// A piece of the world as seen from the first moving joint of a geometry.
  struct Seen {
    double away;         ///< m, of its box from the joint, at least
    double magnitude;    ///< m
    double sourceError;  ///< m
    int body;            ///< index into World::bodies()
  };

  /// Of the whole world. Most geometry has the same joint first.
  const std::vector<Seen>& seenFrom(int body) {
    if (body == seenFrom_) return seen_;
    seenFrom_ = body;
    const Vector3d joint = model_.kinematics.bodies[body].parent_from_joint.translation();
    seen_.resize(model_.worldGeometry.size());
    forPieces(seen_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const WorldGeometry& world = model_.worldGeometry[i];
        const Vector3d center = world.box_from_world * joint;
        const Vector3d outside = (center.cwiseAbs() - world.halfExtents).cwiseMax(Vector3d::Zero());
        seen_[i] = {outside.stableNorm(), world.magnitude, world.sourceError, world.body};
      }
    });
    return seen_;
  }

  /// Calls `work(first, last)` for pieces of a range over the world; large ones on all processors.
  template <typename Work>
  static void forPieces(std::size_t count, const Work& work) {
    constexpr std::size_t kEach = 8192;
    const std::size_t pieces = (count + kEach - 1) / kEach;
    forEachIndex(pieces, pieces < 3 ? 1 : 0,
                 [&](std::size_t i) { work(i * kEach, std::min((i + 1) * kEach, count)); });
  }

  void reserveBodyPairs() {
    std::size_t withGeometry = 0, withWorld = 0;
    for (std::size_t c = 0; c < model_.collisionBodies.size(); ++c) {
      if (firstOf_[c] == firstOf_[c + 1]) continue;
      ++withGeometry;
      withWorld += model_.collisionBodies[c].kind == CollisionBody::Kind::Obstacle ? 0 : 1;
    }
    const std::size_t all =
        withWorld * model_.world->bodies().size() +
        withGeometry * (withGeometry - std::min<std::size_t>(withGeometry, 1)) / 2;
    model_.bodyPairs.reserve(std::min(all, model_.options.maxPairs));
  }

  void pairWithWorld() {
    model_.firstBodyPair.assign(model_.collisionBodies.size(), -1);
    model_.likeWorldPairs.resize(model_.robotGeometry.size());
    model_.firstWorldPair.assign(model_.robotGeometry.size() + 1, 0);
    for (const WorldBody& body : model_.world->bodies())
      worldPaddings_.push_back(rules_.padding(body.name));
    for (std::size_t c = 0; c < model_.collisionBodies.size(); ++c)
      if (model_.collisionBodies[c].kind != CollisionBody::Kind::Obstacle &&
          firstOf_[c] < firstOf_[c + 1])
        pairWithWorld(c);
    for (const WorldPair& pair : model_.worldPairs) ++model_.firstWorldPair[pair.a + 1];
    std::partial_sum(model_.firstWorldPair.begin(), model_.firstWorldPair.end(),
                     model_.firstWorldPair.begin());
    model_.firstSelfPair = static_cast<std::uint32_t>(model_.worldPairs.size());
  }

  void pairWithWorld(std::size_t c) {
    const std::vector<WorldBody>& bodies = model_.world->bodies();
    const CollisionBody& collisionBody = model_.collisionBodies[c];
    const std::size_t base = model_.bodyPairs.size();
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      BodyPair pair{.a = static_cast<int>(c), .b = static_cast<int>(k)};
      pair.margin =
          marginOf(collisionBody.name, paddings_[c], bodies[k].name, worldPaddings_[k], false);
      if (allowed(collisionBody.name, bodies[k].name).value_or(false))
        pair.reason = PairReason::Allowed;
      else
        pair.reason = collisionBody.body == 0 ? PairReason::Unmoved : PairReason::OutOfReach;
      add(pair, model_.bodyPairs, 0, "bodies");
    }
    for (int i = firstOf_[c]; i < firstOf_[c + 1]; ++i) {
      if (collisionBody.body == 0)
        findStandingContacts(i, base);
      else
        pairGeometryWithWorld(i, base);
    }
    if (collisionBody.body != 0) measureAll(c, base);
  }

  /// With a geometry that does not move.
  void findStandingContacts(int a, std::size_t base) {
    const RobotGeometry& robot = model_.robotGeometry[a];
    const Isometry3d shape_from_body = robot.body_from_shape.inverse();
    std::vector<char> touching(model_.worldGeometry.size(), 0);
    forPieces(touching.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const WorldGeometry& world = model_.worldGeometry[i];
        const BodyPair& bodies = model_.bodyPairs[base + world.body];
        if (bodies.reason != PairReason::Unmoved || bodies.touching) continue;
        touching[i] = touch(robot.shape, world.shape, shape_from_body * world.world_from_shape,
                            robot.sourceError + world.sourceError)
                          ? 1
                          : 0;
      }
    });
    for (std::size_t i = 0; i < touching.size(); ++i)
      if (touching[i] != 0) model_.bodyPairs[base + model_.worldGeometry[i].body].touching = true;
  }

  void pairGeometryWithWorld(int a, std::size_t base) {
    if (model_.worldGeometry.empty()) return;
    const RobotGeometry& robot = model_.robotGeometry[a];
    const std::vector<Seen>& seen = seenFrom(robot.levers.path.front());
    const bool isAnywhere = std::ranges::any_of(robot.levers.path, [this](int i) {
      return slidesFreely(model_.kinematics.bodies[i].type);
    });
    // Anywhere within the limits: compileMotion refuses values beyond them.
    const double magnitude = std::max(robot.levers.span, robot.magnitude);
    std::vector<char> isPaired(seen.size(), 0);
    forPieces(seen.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const BodyPair& bodies = model_.bodyPairs[base + seen[i].body];
        if (bodies.reason == PairReason::Allowed) continue;
        const double slack = poseRounding(magnitude + seen[i].magnitude, robot.transforms);
        // No point of the geometry is farther from its first moving joint than it reaches.
        const bool isOut = seen[i].away > robot.levers.reachFromBase + bodies.margin + slack +
                                              robot.sourceError + seen[i].sourceError;
        isPaired[i] = isAnywhere || !isOut ? 1 : 0;
      }
    });
    const auto count = static_cast<std::size_t>(std::ranges::count(isPaired, 1));
    if (count == 0) return;
    motionBoundSlot(a, 0);
    makeRoomFor(count);
    const double ownMagnitude = magnitudeOf(robot);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (isPaired[i] == 0) continue;
      add(WorldPair{a, static_cast<int>(i)}, model_.worldPairs, 0, "shapes");
      BodyPair& bodies = model_.bodyPairs[base + seen[i].body];
      bodies.reason = PairReason::Checked;
      model_.largestMargin = std::max(model_.largestMargin, bodies.margin);
      const double rounding = poseRounding(ownMagnitude + seen[i].magnitude, robot.transforms) +
                              (robot.sourceError + seen[i].sourceError);
      model_.largestRounding = std::max(model_.largestRounding, rounding);
    }
    model_.largestSpan = std::max(model_.largestSpan, robot.levers.spanAtRest);
    model_.largestTransforms = std::max(model_.largestTransforms, robot.transforms);
  }

  /// For pairs of one geometry. The geometry behind it has about as many.
  void makeRoomFor(std::size_t count) {
    const std::size_t wanted = model_.worldPairs.size() + count;
    if (wanted <= model_.worldPairs.capacity()) return;
    std::size_t left = 0;
    for (const RobotGeometry& geometry : model_.robotGeometry) left += geometry.body != 0 ? 1 : 0;
    const bool isFirst = model_.worldPairs.empty();
    model_.worldPairs.reserve(std::min(isFirst ? count * left : wanted + wanted / 2,
                                       std::max(model_.options.maxPairs, wanted)));
  }

  /// Verdicts leave out a piece that is out of reach, since they ask whether some piece comes near.
  /// A distance between two bodies is that of the nearest of all of their pieces: the nearest piece
  /// may be just out of reach, beside one that is in reach and far away.
  void measureAll(std::size_t collisionBody, std::size_t firstBodyPair) {
    double farthest = 0.0, sourceError = 0.0;
    std::int64_t parts = 0;
    for (const Seen& world : seen_) {
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
          add(carrierPair(static_cast<int>(a), static_cast<int>(b), disabled), model_.bodyPairs, 0,
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
    add(pair, model_.pairs, model_.worldPairs.size(), "shapes");
  }

  PairModel& model_;
  const CollisionRules& rules_;
  std::vector<double> paddings_;  ///< m, per collision body
  std::vector<int> firstOf_;      ///< per collision body: of its geometry, the first
  CommonAncestors ancestors_;
  /// Per geometry and number of joints before the first that counts: index into motionBounds; -1:
  /// none yet.
  std::vector<std::vector<int>> slots_;
  std::vector<double> worldPaddings_;  ///< m, per body of the world
  std::vector<Seen> seen_;
  int seenFrom_ = -1;  ///< body whose joint that is from
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
