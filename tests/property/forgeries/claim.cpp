// SPDX-License-Identifier: BSD-3-Clause
#include "claim.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "verify/check.hpp"
#include "verify/motion.hpp"
#include "verify/proof.hpp"
#include "verify/trajectory.hpp"

namespace forgeries {
namespace {

using Eigen::Vector3d;
using swept::verify::Body;
using swept::verify::Element;
using swept::verify::Model;
using swept::verify::Motion;
using swept::verify::PairMotion;
using swept::verify::PairToProve;

constexpr int kHalvings = 3;

Vector3d middleOf(const Body& body, int node) {
  const Element& element = body.elements()[body.nodes()[static_cast<std::size_t>(node)].first];
  if (!element.points.empty()) return element.points.front();
  return element.discs.empty() ? element.ellipsoid->center : element.discs.front().center;
}

/// What proves one pair during one segment.
class PairClaim {
 public:
  PairClaim(const Model& model, const Motion& motion, PairToProve pair, Random& random)
      : model_(model),
        motion_(motion),
        pair_(pair),
        a_(model.bodies[static_cast<std::size_t>(pair.a)]),
        b_(model.bodies[static_cast<std::size_t>(pair.b)]),
        keep_(model.marginOf(pair.a, pair.b)),
        random_(random) {}

  Json run() {
    Json entry = {{"a", a_.name()}, {"b", b_.name()}};
    if (!b_.nodes().empty()) entry["intervals"] = list({});
    if (b_.flats().empty()) return entry;
    entry["flats"] = Json::array();
    for (std::size_t i = 0; i < b_.flats().size(); ++i) entry["flats"].push_back(list(i));
    return entry;
  }

 private:
  Json list(std::optional<std::size_t> flat) {
    Json intervals = Json::array();
    double begin = 0.0;
    for (const double end : ends()) {
      cover(begin, end, 0, flat, intervals);
      begin = end;
    }
    return intervals;
  }

  /// Of the first intervals: one, some, or those of the smallest numbers.
  std::vector<double> ends() {
    std::vector<double> ends{1.0};
    if (random_.chance(0.7)) return ends;
    for (std::size_t i = random_.below(3); i > 0; --i) ends.push_back(random_.uniform(0.0, 1.0));
    if (random_.chance(0.3)) ends.push_back(random_.pick({5e-324, 1e-310, 1e-160, 1e-17}));
    if (random_.chance(0.3)) ends.push_back(1.0 - 0x1p-53);
    if (random_.chance(0.3)) ends.push_back(std::nextafter(ends.back(), 0.5));
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
  }

  void cover(double begin, double end, int depth, std::optional<std::size_t> flat,
             Json& intervals) {
    const PairMotion motion(model_, motion_, pair_, begin, end);
    bool holds = true;
    Json proof = flat ? beside(motion, *flat, holds) : tree(motion, 0, 0, holds);
    const double middle = 0.5 * (begin + end);
    if (holds || depth == kHalvings || !(begin < middle && middle < end)) {
      intervals.push_back({begin, end, std::move(proof)});
      return;
    }
    cover(begin, middle, depth + 1, flat, intervals);
    cover(middle, end, depth + 1, flat, intervals);
  }

  /// The gap itself; where it is nothing, what it should be.
  Json bound(double gap, bool& holds) const {
    if (gap > keep_ && std::isfinite(gap)) return gap;
    holds = false;
    return std::isfinite(keep_) ? std::nextafter(keep_, std::numeric_limits<double>::max()) : 1.0;
  }

  Json beside(const PairMotion& motion, std::size_t flat, bool& holds) const {
    const double above = motion.gapToFlat(0, flat, 1), below = motion.gapToFlat(0, flat, -1);
    const int side = below > above ? -1 : 1;
    return {side, bound(side > 0 ? above : below, holds)};
  }

  Json tree(const PairMotion& motion, int nodeA, int nodeB, bool& holds) {
    const Vector3d between = motion.placedB().reference_from_link * middleOf(b_, nodeB) -
                             motion.placedA().reference_from_link * middleOf(a_, nodeA);
    Vector3d best = Vector3d::UnitX();
    double most = -std::numeric_limits<double>::infinity();
    const auto offer = [&](const Vector3d& way) {
      const double gap = motion.gap(nodeA, nodeB, way);
      if (!(gap > most)) return;
      most = gap;
      best = way;
    };
    offer(between * random_.pick({1.0, 1.0, 1.0, 1e-315, 1e-160, 1e200}));
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) offer(side * Vector3d::Unit(axis));
    offer(Vector3d(random_.normal(), random_.normal(), random_.normal()));
    if (!(most > keep_) || random_.chance(0.1)) {
      const bool divideA = !a_.isLeaf(nodeA);
      if (divideA || !b_.isLeaf(nodeB)) return halves(motion, nodeA, nodeB, divideA, holds);
    }
    return {best.x(), best.y(), best.z(), bound(most, holds)};
  }

  Json halves(const PairMotion& motion, int nodeA, int nodeB, bool divideA, bool& holds) {
    const Body::Node& inner =
        (divideA ? a_ : b_).nodes()[static_cast<std::size_t>(divideA ? nodeA : nodeB)];
    Json both = Json::array();
    for (const int half : {inner.left, inner.right})
      both.push_back(tree(motion, divideA ? half : nodeA, divideA ? nodeB : half, holds));
    return {{divideA ? "a" : "b", std::move(both)}};
  }

  const Model& model_;
  const Motion& motion_;
  PairToProve pair_;
  const Body& a_;
  const Body& b_;
  double keep_;
  Random& random_;
};

/// What each two of are a segment.
const Json& knotsOf(const Json& path) {
  return path.contains("trajectory") ? path["trajectory"]["points"] : path["states"];
}

std::vector<Motion> motionsOf(const Json& path, const Model& model) {
  std::vector<Motion> motions;
  if (path.contains("trajectory")) {
    const auto points = swept::verify::readPoints(path["trajectory"], model);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      motions.emplace_back(model, points[i], points[i + 1]);
    return motions;
  }
  const auto states = path["states"].get<std::vector<std::vector<double>>>();
  for (std::size_t i = 0; i + 1 < states.size(); ++i)
    motions.emplace_back(model, states[i], states[i + 1]);
  return motions;
}

}  // namespace

void takePositions(Json& path) {
  if (!path.contains("trajectory")) return;
  Json& points = path["trajectory"]["points"];
  for (std::size_t i = 0; i < points.size(); ++i) points[i]["positions"] = path["states"][i];
}

void claimMost(Json& path, Random& random) {
  takePositions(path);
  const Model model = swept::verify::readModel(path["model"]);
  const std::vector<PairToProve> pairs = swept::verify::pairsToProve(model);
  Json segments = Json::array();
  for (const Motion& motion : motionsOf(path, model)) {
    Json proofs = Json::array();
    for (const PairToProve& pair : pairs)
      proofs.push_back(PairClaim(model, motion, pair, random).run());
    segments.push_back({{"states_digest", ""}, {"pairs", std::move(proofs)}});
  }
  path["proof"] = {{"digests", Json::object()}, {"segments", std::move(segments)}};
}

void sign(Json& path) {
  takePositions(path);
  Json& proof = path["proof"];
  proof["digests"] = swept::verify::digestsOf(path["model"]);
  proof["digests"]["claims"] = swept::verify::claimDigests(path);
  if (path.contains("trajectory"))
    proof["digests"]["points"] = swept::verify::pointDigests(path["trajectory"]);
  const Json& knots = knotsOf(path);
  for (std::size_t i = 0; i < proof["segments"].size(); ++i) {
    Json& segment = proof["segments"][i];
    segment["states_digest"] = swept::verify::stateDigest(knots[i], knots[i + 1]);
    for (Json& pair : segment["pairs"]) pair["digest"] = swept::verify::pairDigest(pair);
  }
}

}  // namespace forgeries
