// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "report/course_parts.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace swept {
namespace {

/// m, from the link's origin.
double reachOf(const Link& link) {
  double reach = 0.0;
  for (const CollisionGeometry& geometry : link.collision) {
    if (!geometry.cover || geometry.cover->nodes.empty()) continue;
    const CoverBall& ball = geometry.cover->nodes.front().ball;
    const Eigen::Vector3d center = geometry.link_from_shape * ball.center.cast<double>();
    reach = std::max(reach, center.norm() + static_cast<double>(ball.radius));
  }
  return reach;
}

/// m per unit of t. No point of the robot's collision geometry is faster on the motion.
double fastest(const Checker& checker, const ReportMotion& motion) {
  double speed = 0.0;
  for (const Link& link : checker.robot().links()) {
    if (link.collision.empty()) continue;
    const LinkMotion path(checker.robot(), checker.group().name, link.name, motion.from, motion.to,
                          checker.options().reference);
    const MotionRates rates = path.rates(0.0, 1.0);
    speed = std::max(speed, rates.speed + rates.angularSpeed * reachOf(link));
  }
  return speed;
}

/// A motion that collides, and when.
struct ContactQuery {
  ReportMotion motion;
  double begin = 0.0;  ///< proven free until then
  double contact = 0.0;
  double speed = 0.0;  ///< m per unit of t
};

/// Of motions that collide, those whose first contact is known.
std::vector<ContactQuery> contactQueries(const Checker& truth,
                                         const std::vector<ReportMotion>& motions,
                                         const ReportTick& tick) {
  std::vector<ContactQuery> queries;
  Workspace workspace(truth);
  for (const ReportMotion& motion : motions) {
    const MotionCertificate found =
        truth.certifyMotion(motion.from, motion.to, workspace, MotionQuery::FirstContact);
    tick(0);
    if (found.verdict != Verdict::Collision) continue;
    queries.push_back({.motion = motion,
                       .begin = found.freeUntil,
                       .contact = found.witness->t,
                       .speed = fastest(truth, motion)});
  }
  return queries;
}

/// What a method says: free until `until`, or the first known contact there; and, of what is proven
/// free, by when it ends.
struct ContactAnswer {
  bool found = false;
  double until = 0.0;
  std::optional<double> latest;
};

ContactAnswer certifiedAnswer(AskedMethod& method, const ReportMotion& motion) {
  const MotionCertificate certificate = method.checker().certifyMotion(
      motion.from, motion.to, method.workspace(), MotionQuery::FirstContact);
  if (certificate.verdict == Verdict::Free) return {};
  return {.found = true,
          .until = certificate.freeUntil,
          .latest = certificate.witness ? certificate.witness->t : 1.0};
}

/// The first of the states that collides, from the start on.
ContactAnswer discreteAnswer(const AskedMethod& method, const ompl::base::State* from,
                             const ompl::base::State* to) {
  std::pair<ompl::base::State*, double> last{nullptr, 0.0};
  if (method.validator().checkMotion(from, to, last)) return {};
  const double step = 1.0 / method.space().validSegmentCount(from, to);
  return {.found = true, .until = last.second + step, .latest = {}};
}

}  // namespace

void addFirstContacts(LengthTally& tally, std::vector<AskedMethod>& asked, const Checker& truth,
                      const std::vector<ReportMotion>& motions, int passes,
                      const Stopwatch& stopwatch, const ReportTick& tick) {
  const std::vector<ContactQuery> queries = contactQueries(truth, motions, tick);
  std::vector<ReportMotion> chosen;
  for (const ContactQuery& query : queries) chosen.push_back(query.motion);
  const OmplMotions states(truth, chosen);
  struct Result {
    ContactAnswer answer;
    double time = std::numeric_limits<double>::infinity();
  };
  std::vector<std::vector<Result>> results(asked.size(), std::vector<Result>(queries.size()));
  const auto ask = [&](std::size_t method, std::size_t i) {
    Result& result = results[method][i];
    const double taken = stopwatch.time([&] {
      result.answer = asked[method].method().kind == Validator::Kind::Certified
                          ? certifiedAnswer(asked[method], chosen[i])
                          : discreteAnswer(asked[method], states.from[i].get(), states.to[i].get());
    });
    result.time = std::min(result.time, taken);
  };
  inTurns(asked.size(), queries.size(), passes, ask, tick);
  for (std::size_t method = 0; method < asked.size(); ++method) {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const ContactQuery& query = queries[i];
      const ContactAnswer& answer = results[method][i].answer;
      LengthAnswer length{.missed = !answer.found, .error = 0.0, .bound = {}};
      const double known = answer.latest ? query.begin : query.contact;
      length.error = query.speed * std::abs(answer.until - known);
      if (answer.latest) length.bound = query.speed * (*answer.latest - answer.until);
      tally.add(method, length, results[method][i].time);
    }
  }
}

}  // namespace swept
