// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "certificate/constraints_json.hpp"
#include "certificate/model_json.hpp"
#include "certificate/pair_search.hpp"
#include "certificate/stopping.hpp"
#include "certificate/trajectory_json.hpp"
#include "verify/check.hpp"
#include "verify/constraint.hpp"
#include "verify/line.hpp"
#include "verify/trajectory.hpp"

namespace swept {
namespace {

/// The share of the clearance beyond the margin that the planes have to prove.
constexpr double kShareOfClearance = 0.5;
/// The same where joints have tolerances, which clearances do not count: as much as there is.
constexpr std::array kSharesInTube = {kShareOfClearance, 0.1, 0.0};

class CertificateSearch {
 public:
  CertificateSearch(const Checker& checker, const Json& model, double clock,
                    const std::stop_token& stop)
      : stop_(stop),
        model_(modelAt(model, clock)),
        pairs_(verify::pairsToProve(model_)),
        constraints_(verify::readConstraints(constraintsJson(checker), model_)),
        inTube_(model.contains("tracking")) {
    const std::vector<CertifiedBody> sources = certifiedBodies(checker);
    for (std::size_t i = 0; i < sources.size(); ++i)
      bodies_.emplace_back(model_.bodies[i], sources[i]);
    findMeasured(checker, sources);
  }

  const verify::Model& model() const { return model_; }

  /// Null where a pair or a constraint is not proven; then `missing` says which.
  Json segment(const verify::Motion& motion, double clearance, std::string& missing) {
    Json proofs = Json::array();
    for (const verify::PairToProve& pair : pairs_) {
      throwIfStopped(stop_);
      Json entry = pairProof(motion, pair, clearance);
      if (entry.is_null()) {
        missing = nameOf(pair.a) + " - " + nameOf(pair.b);
        return nullptr;
      }
      entry["digest"] = verify::pairDigest(entry);
      proofs.push_back(std::move(entry));
    }
    for (const verify::Constraint& constraint : constraints_)
      if (!isShown(motion, constraint)) {
        missing = constraint.name;
        return nullptr;
      }
    return proofs;
  }

 private:
  static verify::Model modelAt(const Json& json, double clock) {
    verify::Model model = verify::readModel(json);
    model.clock = clock;
    return model;
  }

  /// Whether verifying will show it: the file has nothing for a constraint but itself.
  bool isShown(const verify::Motion& motion, const verify::Constraint& constraint) const {
    try {
      verify::checkConstraint(model_, motion, constraint, constraint.name);
    } catch (const verify::Refusal&) {
      return false;
    }
    return true;
  }

  const std::string& nameOf(int body) const {
    return model_.bodies[static_cast<std::size_t>(body)].name();
  }

  Json pairProof(const verify::Motion& motion, verify::PairToProve pair, double clearance) {
    const double margin = model_.marginOf(pair.a, pair.b);
    const bool measured = measured_.contains({pair.a, pair.b});
    for (const double share : kSharesInTube) {
      const double more = measured ? std::max(0.0, share * (clearance - margin)) : 0.0;
      const double keep = std::isfinite(more) ? margin + more : margin;
      Json entry = PairSearch(model_, motion, pair, bodies_[static_cast<std::size_t>(pair.a)],
                              bodies_[static_cast<std::size_t>(pair.b)], keep, stop_)
                       .run();
      if (!entry.is_null() || !inTube_ || keep == margin) return entry;
    }
    return nullptr;
  }

  void findMeasured(const Checker& checker, const std::vector<CertifiedBody>& sources) {
    std::map<std::pair<std::string, bool>, int> numbers;
    for (std::size_t i = 0; i < sources.size(); ++i)
      numbers[{sources[i].name, sources[i].link >= 0}] = static_cast<int>(i);
    for (const Checker::Pair& pair : checker.checkedPairs())
      measured_.insert(
          std::minmax(numbers.at({pair.bodyA, true}), numbers.at({pair.bodyB, pair.selfPair})));
  }

  const std::stop_token& stop_;
  verify::Model model_;
  std::vector<verify::PairToProve> pairs_;
  std::vector<verify::Constraint> constraints_;
  bool inTube_;
  std::deque<SearchedBody> bodies_;
  /// Pairs that the clearances cover. Bodies out of a link's reach have to be proven apart as well,
  /// and may be nearer than these.
  std::set<std::pair<int, int>> measured_;
};

/// `motionOf` and `clearanceOf`: of a segment. `knots`: what each two of are one.
template <typename MotionOf, typename ClearanceOf>
Certificate certificateBetween(const Checker& checker, const Json& knots, double clock,
                               const MotionOf& motionOf, const ClearanceOf& clearanceOf,
                               const std::stop_token& stop) {
  Certificate certificate{.model = modelJson(checker), .proof = nullptr, .missing = {}};
  CertificateSearch search(checker, certificate.model, clock, stop);
  Json segments = Json::array();
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    std::string missing;
    Json proofs = search.segment(motionOf(search.model(), i), clearanceOf(i), missing);
    if (proofs.is_null()) {
      certificate.missing = "segment " + std::to_string(i + 1) + ", " + missing;
      return certificate;
    }
    segments.push_back({{"states_digest", verify::stateDigest(knots[i], knots[i + 1])},
                        {"pairs", std::move(proofs)}});
  }
  certificate.proof = {{"digests", verify::digestsOf(certificate.model)},
                       {"segments", std::move(segments)}};
  return certificate;
}

/// The first place where verifying would not show a line; empty: there is none.
std::string lineNotShown(const Json& modelOfProof, std::span<const std::vector<double>> states,
                         const Json& lines, const std::stop_token& stop) {
  if (lines.empty()) return {};
  const verify::Model model = verify::withoutTolerances(verify::readModel(modelOfProof));
  for (const verify::Line& line : verify::readLines(lines, model, states.size() - 1))
    for (std::size_t i = line.first; line.has(i); ++i) {
      throwIfStopped(stop);
      const std::string place = "segment " + std::to_string(i + 1) + ", " + line.name;
      try {
        verify::checkLine(verify::Motion(model, states[i], states[i + 1]), line, i, place);
      } catch (const verify::Refusal&) {
        return place;
      }
    }
  return {};
}

}  // namespace

Certificate certificateOf(const Checker& checker, std::span<const std::vector<double>> states,
                          std::span<const double> clearances, const Json& lines,
                          const std::stop_token& stop) {
  requireStanding(checker, "a path");
  Json knots = Json::array();
  for (const std::vector<double>& q : states) knots.push_back(toJson(q));
  Certificate certificate = certificateBetween(
      checker, knots, 0.0,
      [&](const verify::Model& model, std::size_t i) {
        return verify::Motion(model, states[i], states[i + 1]);
      },
      [&](std::size_t i) { return clearances[i]; }, stop);
  if (certificate.missing.empty())
    certificate.missing = lineNotShown(certificate.model, states, lines, stop);
  if (!certificate.missing.empty()) certificate.proof = nullptr;
  return certificate;
}

Certificate certificateOf(const Checker& checker, const JointTrajectory& trajectory,
                          double clearance, double clock, const std::stop_token& stop) {
  requireTimesOfTurns(checker);
  const auto pointOf = [&](std::size_t i) {
    const TrajectoryPoint& point = trajectory.points[i];
    return verify::Point{.time = point.time,
                         .positions = point.positions,
                         .velocities = point.velocities,
                         .accelerations = point.accelerations};
  };
  const Json json = trajectoryJson(trajectory);
  Certificate certificate = certificateBetween(
      checker, json["points"], clock,
      [&](const verify::Model& model, std::size_t i) {
        return verify::Motion(model, pointOf(i), pointOf(i + 1));
      },
      [&](std::size_t) { return clearance; }, stop);
  if (!certificate.proof.is_null())
    certificate.proof["digests"]["points"] = verify::pointDigests(json);
  return certificate;
}

}  // namespace swept
