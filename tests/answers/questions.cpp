// SPDX-License-Identifier: BSD-3-Clause
#include "questions.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <limits>

#include "swept/robot_model/allowed_collision_matrix.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "swept/robot_model/path_clearance.hpp"

namespace swept::answers {
namespace {

// Configurations.

/// s. Moving obstacles move in these, and stand still around them.
constexpr double kTimeBegin = -2.0;
constexpr double kTimeEnd = 15.0;

bool hasTime(const Site& site) {
  return static_cast<std::size_t>(site.checker->dimension()) >
         site.checker->group().variables.size();
}

struct Bounds {
  double lower = 0.0;
  double upper = 0.0;
};

/// What is drawn from: limits, a turn, or the room around the robot.
Bounds boundsOf(const Site& site, std::size_t i) {
  const Group& group = site.checker->group();
  if (i == group.variables.size()) return {kTimeBegin, kTimeEnd};
  const Variable& variable = site.model->variables()[group.variables[i]];
  const double most = variable.cyclic ? 3.14159265358979 : 1.5;
  return {std::isfinite(variable.lower) ? variable.lower : -most,
          std::isfinite(variable.upper) ? variable.upper : most};
}

Values anywhere(const Site& site, Random& random) {
  Values q(static_cast<std::size_t>(site.checker->dimension()));
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Bounds bounds = boundsOf(site, i);
    q[i] = random.uniform(bounds.lower, bounds.upper);
  }
  return q;
}

Values anchor(const Site& site, Random& random) {
  if (site.anchors.empty()) return anywhere(site, random);
  Values q = site.anchors[random.below(site.anchors.size())];
  if (hasTime(site)) q.push_back(random.uniform(kTimeBegin, kTimeEnd));
  return q;
}

Values step(const Site& site, const Values& from, double length, Random& random) {
  Values way(from.size());
  double squared = 0;
  for (double& value : way) {
    value = random.uniform(-1, 1);
    squared += value * value;
  }
  Values to = from;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Bounds bounds = boundsOf(site, i);
    const double least = std::min(bounds.lower, from[i]);
    const double most = std::max(bounds.upper, from[i]);
    to[i] =
        std::clamp(from[i] + way[i] * (length / std::sqrt(std::max(squared, 1e-9))), least, most);
  }
  return to;
}

/// From an anchor, a part of the ranges between `least` and `most`. Draws in one order: that of
/// arguments is each compiler's own.
Values stepFromAnchor(const Site& site, double least, double most, Random& random) {
  const double length = random.uniform(least, most);
  const Values from = anchor(site, random);
  return step(site, from, length, random);
}

/// Anywhere, near what has a name, at limits, a little or far beyond them, or no number.
Values state(const Site& site, Random& random) {
  const std::size_t which = random.below(64);
  if (which < 24) return anywhere(site, random);
  if (which < 56) return stepFromAnchor(site, 0, 1.5, random);
  Values q = anywhere(site, random);
  const std::size_t i = random.below(q.size());
  const Bounds bounds = boundsOf(site, i);
  if (which < 60) q[i] = random.oneIn(2) ? bounds.lower : bounds.upper;
  if (which == 60) q[i] = bounds.upper + random.uniform(0, 2e-5);
  if (which == 61) q[i] = bounds.lower - random.uniform(0, 1);
  if (which == 62) q[i] += 6.28318530717958648 * static_cast<double>(random.below(5));
  if (which == 63) {
    q[i] = random.oneIn(2) ? std::numeric_limits<double>::quiet_NaN()
                           : std::numeric_limits<double>::infinity();
  }
  return q;
}

struct Ends {
  Values from;
  Values to;
};

Ends shortMotion(const Site& site, Random& random) {
  Values from = random.oneIn(3) ? anywhere(site, random) : stepFromAnchor(site, 0, 1, random);
  double length = random.uniform(0.02, 0.4);
  if (random.oneIn(8)) length *= std::pow(10.0, -random.uniform(0, 6));
  if (random.oneIn(64)) length = 0;
  Values to = step(site, from, length, random);
  return {std::move(from), std::move(to)};
}

Ends longMotion(const Site& site, Random& random) {
  Values from = random.oneIn(2) ? anchor(site, random) : state(site, random);
  Values to = random.oneIn(3) ? anchor(site, random) : state(site, random);
  return {std::move(from), std::move(to)};
}

Ends anyMotion(const Site& site, Random& random) {
  return random.oneIn(3) ? longMotion(site, random) : shortMotion(site, random);
}

MotionQuery anyQuery(Random& random) {
  return random.oneIn(2) ? MotionQuery::VerdictOnly : MotionQuery::FirstContact;
}

Ends asked(const Ends& motion, Answer& answer) {
  answer.question("from", motion.from);
  answer.question("to", motion.to);
  return motion;
}

std::vector<Values> path(const Site& site, std::size_t states, Random& random, Answer& answer) {
  std::vector<Values> all{stepFromAnchor(site, 0, 0.5, random)};
  while (all.size() < states)
    all.push_back(step(site, all.back(), random.uniform(0.02, 0.6), random));
  answer.question("path", all);
  return all;
}

// Answers.

void put(Answer& answer, const Witness& witness) {
  answer.detail("witness t", witness.t);
  answer.detail("witness bodyA", witness.bodyA);
  answer.detail("witness bodyB", witness.bodyB);
  answer.detail("witness selfPair", witness.selfPair);
  answer.detail("witness pointA", witness.pointA);
  answer.detail("witness pointB", witness.pointB);
  answer.detail("witness distance", witness.distance);
  answer.detail("witness margin", witness.margin);
}

void put(Answer& answer, const MotionCertificate& certificate) {
  answer.result("verdict", certificate.verdict);
  answer.detail("freeUntil", certificate.freeUntil);
  answer.detail("undecidedAt", certificate.undecidedAt);
  answer.detail("has witness", certificate.witness.has_value());
  if (certificate.witness) put(answer, *certificate.witness);
  answer.detail("intervals", certificate.effort.intervals);
  answer.detail("distances", certificate.effort.distances);
  answer.detail("culled", certificate.effort.culled);
  answer.detail("lanes", certificate.effort.lanes);
}

void put(Answer& answer, const NearestPair& pair) {
  answer.result("clearance", pair.clearance);
  answer.detail("bodyA", pair.bodyA);
  answer.detail("bodyB", pair.bodyB);
}

void putInterval(Answer& answer, const ClearanceInterval& interval) {
  answer.result("lower", interval.lower);
  answer.result("upper", interval.upper);
  answer.detail("t", interval.t);
  answer.detail("bodyA", interval.bodyA);
  answer.detail("bodyB", interval.bodyB);
}

void putInterval(Answer& answer, const PathClearanceInterval& interval) {
  putInterval(answer, static_cast<const ClearanceInterval&>(interval));
  answer.detail("segment", interval.segment ? static_cast<std::int64_t>(*interval.segment) : -1);
}

void putClearance(Answer& answer, const auto& clearance) {
  putInterval(answer, clearance);
  answer.detail("selfPair", clearance.selfPair);
  answer.detail("intervals", clearance.intervals);
  putInterval(answer, clearance.world);
  putInterval(answer, clearance.self);
}

void put(Answer& answer, const std::vector<Checker::Pair>& pairs) {
  answer.result("pairs", pairs.size());
  for (const Checker::Pair& pair : pairs) {
    answer.result("bodyA", pair.bodyA);
    answer.result("bodyB", pair.bodyB);
    answer.result("selfPair", pair.selfPair);
    answer.result("margin", pair.margin);
    answer.detail("reason", pair.reason);
  }
}

// Questions.

void askState(const Site& site, Workspace* workspace, Random& random, Answer& answer) {
  const Values q = state(site, random);
  answer.question("q", q);
  answer.result("verdict", site.checker->checkState(q, *workspace));
  answer.detail("withinLimits", site.checker->withinLimits(q));
}

void askStates(const Site& site, Workspace* workspace, Random& random, Answer& answer) {
  Values all;
  std::vector<Verdict> verdicts(1 + random.below(40));
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const Values q = state(site, random);
    all.insert(all.end(), q.begin(), q.end());
  }
  answer.question("states", all);
  if (random.oneIn(8)) {
    site.checker->checkStates(all, verdicts, 1U);
  } else {
    site.checker->checkStates(all, verdicts, *workspace);
  }
  for (const Verdict verdict : verdicts) answer.result("verdict", verdict);
}

void askReport(const Site& site, Workspace* workspace, Random& random, Answer& answer) {
  const Values q = state(site, random);
  answer.question("q", q);
  const StateReport report = site.checker->reportState(q, *workspace);
  answer.result("verdict", report.verdict);
  answer.result("clearance", report.clearance);
  answer.detail("finite", report.finite);
  answer.detail("outsideLimits", report.outsideLimits);
  answer.detail("contacts", report.contacts.size());
  for (const Witness& witness : report.contacts) put(answer, witness);
  answer.detail("nearestA", report.nearestA);
  answer.detail("nearestB", report.nearestB);
  answer.detail("nearestSelfPair", report.nearestSelfPair);
  put(answer, report.world);
  put(answer, report.self);
}

void askClearance(const Site& site, Workspace* workspace, Random& random, Answer& answer) {
  const Values q = state(site, random);
  answer.question("q", q);
  answer.result("clearance", site.checker->clearance(q, *workspace));
}

void askSignedClearance(const Site& site, Workspace* workspace, Random& random, Answer& answer) {
  const Values q = state(site, random);
  answer.question("q", q);
  Values gradient(random.oneIn(4) ? 0 : q.size());
  const SignedClearance clearance = site.checker->signedClearance(q, *workspace, gradient);
  answer.result("lower", clearance.lower);
  answer.result("upper", clearance.upper);
  answer.detail("pointA", clearance.pointA);
  answer.detail("pointB", clearance.pointB);
  answer.detail("normal", clearance.normal);
  answer.detail("gradient", gradient);
}

template <MotionQuery query, Ends (*draw)(const Site&, Random&)>
void askMotion(const Site& site, Workspace* workspace, Random& random, Answer& answer) {
  const Ends motion = asked(draw(site, random), answer);
  put(answer, site.checker->certifyMotion(motion.from, motion.to, *workspace, query));
}

/// Halves the way to a contact until hardly anything is left, then asks about the states and
/// motions there. What it asks hangs on its own answers alone.
void askTouching(const Site& site, Workspace* workspace, Random& random, Answer& answer) {
  const Checker& checker = *site.checker;
  Values from = anchor(site, random);
  for (int i = 0; i < 8 && checker.checkState(from, *workspace) != Verdict::Free; ++i)
    from = stepFromAnchor(site, 0, 1, random);
  const Ends motion = asked({from, anywhere(site, random)}, answer);
  double open = 0;
  double shut = 1;
  const std::size_t halvings = 8 + random.below(40);
  for (std::size_t i = 0; i < halvings; ++i) {
    const double middle = (open + shut) / 2;
    const Verdict verdict =
        checker.checkState(checker.interpolate(motion.from, motion.to, middle), *workspace);
    answer.detail("verdict of a state", verdict);
    (verdict == Verdict::Free ? open : shut) = middle;
  }
  const Eigen::VectorXd last = checker.interpolate(motion.from, motion.to, open);
  const Eigen::VectorXd first = checker.interpolate(motion.from, motion.to, shut);
  answer.detail("last", last);
  answer.result("last verdict", checker.checkState(last, *workspace));
  answer.result("first verdict", checker.checkState(first, *workspace));
  put(answer, checker.certifyMotion(motion.from, last, *workspace, anyQuery(random)));
  put(answer, checker.certifyMotion(last, first, *workspace, anyQuery(random)));
}

void askMotions(const Site& site, Workspace*, Random& random, Answer& answer) {
  Values from;
  Values to;
  std::vector<MotionCertificate> certificates(1 + random.below(12));
  for (std::size_t i = 0; i < certificates.size(); ++i) {
    const Ends motion = asked(anyMotion(site, random), answer);
    from.insert(from.end(), motion.from.begin(), motion.from.end());
    to.insert(to.end(), motion.to.begin(), motion.to.end());
  }
  site.checker->certifyMotions(from, to, certificates, anyQuery(random), 1);
  for (const MotionCertificate& certificate : certificates) put(answer, certificate);
}

void askBothQueries(const Site& site, Workspace* workspace, Random& random, Answer& answer) {
  const Ends motion = asked(anyMotion(site, random), answer);
  for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact})
    put(answer, site.checker->certifyMotion(motion.from, motion.to, *workspace, query));
}

ClearanceQuery anyClearance(Random& random, Answer& answer) {
  constexpr std::array kQueries{ClearanceQuery::Least, ClearanceQuery::ByKind,
                                ClearanceQuery::World, ClearanceQuery::Self};
  constexpr std::array kNames{"least", "by kind", "world", "self"};
  const std::size_t which = random.below(kQueries.size());
  answer.question("query", kNames[which]);
  return kQueries[which];
}

double anyAccuracy(Random& random) {
  return std::pow(10.0, -random.uniform(1, 3));
}

void askMotionClearance(const Site& site, Workspace* workspace, Random& random, Answer& answer) {
  const Ends motion = asked(shortMotion(site, random), answer);
  const ClearanceQuery query = anyClearance(random, answer);
  putClearance(answer, site.checker->motionClearance(motion.from, motion.to, anyAccuracy(random),
                                                     *workspace, query));
}

void askPathClearance(const Site& site, Workspace* workspace, Random& random, Answer& answer) {
  const auto states = path(site, 1 + random.below(4), random, answer);
  const ClearanceQuery query = anyClearance(random, answer);
  putClearance(answer,
               pathClearance(*site.checker, states, anyAccuracy(random), *workspace, query));
}

void askPath(const Site& site, Workspace*, Random& random, Answer& answer) {
  const auto states = path(site, 1 + random.below(4), random, answer);
  const PathCertificate certificate =
      certifyPath(*site.checker, states, {.clearances = random.oneIn(3), .threads = 1});
  answer.result("verdict", certificate.verdict());
  answer.result("segments", certificate.segments.size());
  for (const CertifiedSegment& segment : certificate.segments) {
    put(answer, segment.certificate);
    answer.result("has clearance", segment.clearance.has_value());
    if (segment.clearance) putClearance(answer, *segment.clearance);
  }
}

void askInterpolation(const Site& site, Workspace*, Random& random, Answer& answer) {
  const Ends motion = asked(anyMotion(site, random), answer);
  const double t = random.oneIn(8) ? static_cast<double>(random.below(2)) : random.uniform(0, 1);
  answer.question("t", t);
  const Eigen::VectorXd q = site.checker->interpolate(motion.from, motion.to, t);
  answer.result("q", q);
  answer.result("withinLimits", site.checker->withinLimits(q));
}

void askLinkMotion(const Site& site, Workspace*, Random& random, Answer& answer) {
  const Ends motion = asked(anyMotion(site, random), answer);
  const Robot& robot = *site.model;
  const Group& group = site.checker->group();
  const std::string& link = robot.links()[random.below(robot.links().size())].name;
  answer.question("link", link);
  const std::size_t values = group.variables.size();
  const Values from(motion.from.begin(), motion.from.begin() + static_cast<std::ptrdiff_t>(values));
  const Values to(motion.to.begin(), motion.to.begin() + static_cast<std::ptrdiff_t>(values));
  const auto& reference = site.checker->options().reference;
  const LinkMotion way(robot, group.name, link, from, to, reference);
  const double t = random.uniform(0, 1);
  const double until = random.uniform(t, 1);
  answer.question("t", t);
  answer.result("pose", way.at(t));
  answer.result("pose of from", linkPose(robot, group.name, link, from, reference));
  answer.detail("reference point", way.reference());
  for (const Twist& twist : {way.velocity(t), way.state(t).twist}) {
    answer.detail("linear", twist.linear);
    answer.detail("angular", twist.angular);
  }
  const MotionRates rates = way.rates(t, until);
  answer.result("speed", rates.speed);
  answer.result("acceleration", rates.acceleration);
  answer.result("angularSpeed", rates.angularSpeed);
  answer.result("angularAcceleration", rates.angularAcceleration);
  const Eigen::Vector3d center = random.inBox({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2});
  const MotionBound bound = way.bound({center, random.uniform(0, 0.3)}, t, until);
  answer.result("along", bound.along(random.direction()));
  answer.result("most", bound.most());
  answer.detail("curvature", bound.curvature);
  answer.detail("travel", bound.travel);
  answer.result("rounding", way.rounding(random.uniform(0, 1)));
}

void askPlaced(const Site& site, Workspace*, Random& random, Answer& answer) {
  const Values q = state(site, random);
  answer.question("q", q);
  const auto& attached = site.checker->options().attached;
  const std::string name =
      attached.empty() ? "nobody" : attached[random.below(attached.size())].name;
  const WorldBody body = site.checker->detachedBody(name, q);
  for (const WorldBody::Part& part : body.parts) answer.result("pose", part.world_from_shape);
}

void askExplain(const Site& site, Workspace*, Random& random, Answer& answer) {
  const std::vector<Checker::Pair>& pairs =
      random.oneIn(2) ? site.checker->checkedPairs() : site.checker->skippedPairs();
  if (pairs.empty()) return;
  const Checker::Pair& pair = pairs[random.below(pairs.size())];
  answer.question("bodyA", pair.bodyA);
  answer.question("bodyB", pair.bodyB);
  answer.detail("sentence", site.checker->explain(pair.bodyB, pair.bodyA));
}

void askPairs(const Site& site, Workspace*, Random&, Answer& answer) {
  put(answer, site.checker->checkedPairs());
  put(answer, site.checker->skippedPairs());
  put(answer, site.checker->staticContacts());
  answer.result("linksWithoutGeometry", site.checker->linksWithoutGeometry());
  answer.result("checksNothing", site.checker->checksNothing());
  answer.result("dimension", site.checker->dimension());
}

void askRobot(const Site& site, Workspace*, Random&, Answer& answer) {
  const Robot& robot = *site.model;
  answer.result("name", robot.name());
  answer.result("modelFrame", robot.modelFrame());
  answer.result("defaultState", robot.defaultState());
  for (const Link& link : robot.links()) {
    answer.result("link", link.name);
    answer.result("parentJoint", link.parentJoint);
    for (const CollisionGeometry& geometry : link.collision) {
      answer.result("shape", geometry.shape.index());
      answer.result("link_from_shape", geometry.link_from_shape);
      const Aabb box = boundingBox(geometry.shape);
      answer.result("lower", box.lower);
      answer.result("upper", box.upper);
      answer.detail("source", std::filesystem::path(geometry.source).filename().string());
    }
  }
  for (const Joint& joint : robot.joints()) {
    answer.result("joint", joint.name);
    answer.result("type", joint.type);
    answer.result("parent_from_joint", joint.parent_from_joint);
    answer.result("axis", joint.axis);
  }
  for (const Variable& variable : robot.variables()) {
    answer.result("variable", variable.name);
    answer.result("lower", variable.lower);
    answer.result("upper", variable.upper);
    answer.result("cyclic", variable.cyclic);
  }
  for (const Group& group : robot.groups()) {
    answer.result("group", group.name);
    answer.result("variables", group.variables);
    answer.result("tipLink", group.tipLink);
  }
  for (const DisabledPair& pair : robot.disabledPairs()) {
    answer.result("linkA", pair.linkA);
    answer.result("linkB", pair.linkB);
    answer.detail("reason", pair.reason);
  }
}

/// Of robots of few links alone: all others take too long.
void askMatrix(const Site& site, Workspace*, Random& random, Answer& answer) {
  const Robot& robot = *site.model;
  constexpr std::size_t kFew = 24;
  if (robot.links().size() > kFew) return;
  AllowedCollisionMatrixOptions options;
  options.budget = 50'000;
  options.samples = 100;
  options.seed = static_cast<std::uint32_t>(random.bits());
  options.threads = 1;
  for (const LinkPairReport& pair : computeAllowedCollisionMatrix(robot, options)) {
    answer.result("linkA", pair.linkA);
    answer.result("linkB", pair.linkB);
    answer.result("status", pair.status);
    answer.detail("joint", pair.joint);
    answer.detail("variables", pair.variables);
    if (pair.witness) answer.detail("witness", *pair.witness);
    answer.detail("proven", pair.proven);
    answer.detail("effort", pair.effort);
    answer.detail("nearest", pair.nearest);
  }
}

Ends noMotion(const Site& site, Random& random) {
  const Values q = state(site, random);
  return {q, q};
}

constexpr auto kVerdict = MotionQuery::VerdictOnly;
constexpr auto kContact = MotionQuery::FirstContact;

constexpr std::array kKinds{
    Kind{"state", 0.2745, About::Scene, false, askState},
    Kind{"states", 0.015, About::Scene, false, askStates},
    Kind{"report", 0.009, About::Scene, false, askReport},
    Kind{"clearance", 0.006, About::Scene, false, askClearance},
    Kind{"signed_clearance", 0.012, About::Scene, false, askSignedClearance},
    Kind{"short_motion", 0.2, About::Scene, true, askMotion<kVerdict, shortMotion>},
    Kind{"short_contact", 0.15, About::Scene, true, askMotion<kContact, shortMotion>},
    Kind{"long_motion", 0.06, About::Scene, true, askMotion<kVerdict, longMotion>},
    Kind{"long_contact", 0.05, About::Scene, true, askMotion<kContact, longMotion>},
    Kind{"no_motion", 0.004, About::Scene, true, askMotion<kContact, noMotion>},
    Kind{"touching", 0.03, About::Scene, false, askTouching},
    Kind{"motions", 0.006, About::Scene, true, askMotions},
    Kind{"both", 0.01, About::Scene, true, askBothQueries},
    Kind{"motion_clearance", 0.008, About::Scene, false, askMotionClearance},
    Kind{"path_clearance", 0.0025, About::Scene, false, askPathClearance},
    Kind{"path", 0.003, About::Scene, true, askPath},
    Kind{"interpolation", 0.07, About::Scene, false, askInterpolation},
    Kind{"link_motion", 0.08, About::Scene, false, askLinkMotion},
    Kind{"placed", 0.005, About::Scene, false, askPlaced},
    Kind{"explain", 0.005, About::Scene, false, askExplain},
    Kind{"pairs", 0, About::SceneOnce, false, askPairs},
    Kind{"robot", 0, About::RobotOnce, false, askRobot},
    Kind{"matrix", 0, About::RobotOnce, false, askMatrix},
};

}  // namespace

std::span<const Kind> kinds() {
  return kKinds;
}

Answer ask(const Kind& kind, const Site& site, Workspace* workspace, Random random,
           std::ostream* text) {
  Answer answer(text);
  try {
    kind.ask(site, workspace, random, answer);
  } catch (const std::exception& error) {
    answer.result("throws", true);
    answer.detail("message", error.what());
  }
  return answer;
}

}  // namespace swept::answers
