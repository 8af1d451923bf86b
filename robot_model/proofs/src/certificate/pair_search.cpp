// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/pair_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "certificate/stopping.hpp"
#include "swept/core/distance.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// The most halvings of a motion: shorter intervals are not worth the space in the file.
constexpr int kDepth = 24;
/// The most pairs of nodes that are examined in one interval.
constexpr int kNodes = 20'000;
/// Two nodes that keep this share of what the bodies have to spare in the middle of an interval
/// need less time, not smaller parts.
constexpr double kShare = 0.3;

/// Few digits for a small file: `digits` behind the point.
double rounded(double value, double digits) {
  const double unit = std::pow(10.0, digits);
  return std::round(value * unit) / unit;
}

/// Four significant digits or a little less, never more than the value.
double roundedDown(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 3.0);
  const double candidate = std::floor(value / unit) * unit;
  // The nearest number with few digits may be larger than the value.
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", candidate);
  const double few = std::strtod(text, nullptr);
  return few <= value ? few : value;
}

}  // namespace

/// One interval while its planes are looked for.
struct PairSearch::Between {
  const verify::PairMotion& motion;
  std::optional<double> distance =
      {};              ///< m, of the two bodies in the middle, when it was asked for
  int nodes = kNodes;  ///< pairs of nodes that may still be looked at
  double middle = 0.0;
  std::optional<verify::PairMotion> still = {};  ///< in the middle alone, when it was asked for
};

const verify::PairMotion& PairSearch::stillOf(Between& between) const {
  if (!between.still) between.still.emplace(model_, motion_, pair_, between.middle, between.middle);
  return *between.still;
}

double PairSearch::distanceOf(Between& between) const {
  if (between.distance) return *between.distance;
  double least = std::numeric_limits<double>::infinity();
  const Isometry3d a_from_b = between.motion.placedA().reference_from_link.inverse() *
                              between.motion.placedB().reference_from_link;
  for (const CertifiedBody::Part& a : a_.parts())
    for (const CertifiedBody::Part& b : b_.parts())
      least = std::min(least, distance(a.shape, b.shape,
                                       a.body_from_shape.inverse() * a_from_b * b.body_from_shape)
                                  .lower);
  between.distance = least;
  return least;
}

Json PairSearch::plane(const Between& between, int a, int b, const Vector3d& direction) const {
  for (const double digits : {3.0, 7.0}) {
    const Vector3d few(rounded(direction.x(), digits), rounded(direction.y(), digits),
                       rounded(direction.z(), digits));
    const double gap = between.motion.gap(a, b, few);
    if (!(gap > keep_)) continue;
    const double bound = roundedDown(gap);
    if (bound > keep_) return {few.x(), few.y(), few.z(), bound};
  }
  return nullptr;
}

Json PairSearch::tree(Between& between, int a, int b) {
  throwIfStopped(stop_);
  if (--between.nodes < 0) return nullptr;
  const Isometry3d& placedA = between.motion.placedA().reference_from_link;
  const Isometry3d& placedB = between.motion.placedB().reference_from_link;
  const CertifiedBody::Part& partA = a_.shapeOf(a);
  const CertifiedBody::Part& partB = b_.shapeOf(b);
  const Isometry3d reference_from_a = placedA * partA.body_from_shape;
  const DistanceResult found = distance(
      partA.shape, partB.shape, reference_from_a.inverse() * placedB * partB.body_from_shape);
  if (found.lower > 0.0 && !found.normal.isZero()) {
    const Vector3d way = reference_from_a.linear() * found.normal;
    Json leaf = plane(between, a, b, way);
    if (!leaf.is_null()) return leaf;
    // Of smaller parts, the tolerances of joints take less.
    const double play = between.motion.play(a, b, way);
    const double spare = distanceOf(between) - keep_ - play;
    // What tolerances take beyond the first order is there in the shortest interval, too.
    const double apart =
        play > 0.0 ? stillOf(between).gap(a, b, way) : found.lower - a_.grownBy(a) - b_.grownBy(b);
    if (apart >= keep_ + kShare * (play > 0.0 ? std::max(spare, 0.0) : spare)) return nullptr;
  }
  const bool leafA = a_.body().isLeaf(a), leafB = b_.body().isLeaf(b);
  if (leafA && leafB) return nullptr;
  const bool divideA = leafB || (!leafA && a_.sizeOf(a) > b_.sizeOf(b));
  const auto& nodes = (divideA ? a_ : b_).body().nodes();
  const verify::Body::Node& inner = nodes[static_cast<std::size_t>(divideA ? a : b)];
  Json halves = Json::array();
  for (const int half : {inner.left, inner.right}) {
    Json own = tree(between, divideA ? half : a, divideA ? b : half);
    if (own.is_null()) return nullptr;
    halves.push_back(std::move(own));
  }
  return {{divideA ? "a" : "b", std::move(halves)}};
}

Json PairSearch::besideFlat(const verify::PairMotion& motion, std::size_t flat) const {
  for (const int side : {1, -1}) {
    const double gap = motion.gapToFlat(0, flat, side);
    if (!(gap > keep_)) continue;
    const double bound = roundedDown(gap);
    if (bound > keep_) return {side, bound};
  }
  return nullptr;
}

bool PairSearch::intervals(double begin, double end, int depth, Json& list, bool flat,
                           std::size_t index) {
  const verify::PairMotion motion(model_, motion_, pair_, begin, end);
  Json proof;
  if (flat) {
    proof = besideFlat(motion, index);
  } else {
    Between between{.motion = motion, .middle = 0.5 * (begin + end)};
    proof = tree(between, 0, 0);
    if (between.distance && !(*between.distance > keep_)) return false;
  }
  if (!proof.is_null()) {
    list.push_back({begin, end, std::move(proof)});
    return true;
  }
  if (depth >= kDepth) return false;
  const double middle = 0.5 * (begin + end);
  return intervals(begin, middle, depth + 1, list, flat, index) &&
         intervals(middle, end, depth + 1, list, flat, index);
}

Json PairSearch::run() {
  Json entry = {{"a", a_.body().name()}, {"b", b_.body().name()}};
  if (!b_.body().nodes().empty()) {
    Json list = Json::array();
    if (!intervals(0.0, 1.0, 0, list, false, 0)) return nullptr;
    entry["intervals"] = std::move(list);
  }
  if (b_.body().flats().empty()) return entry;
  entry["flats"] = Json::array();
  for (std::size_t i = 0; i < b_.body().flats().size(); ++i) {
    Json list = Json::array();
    if (!intervals(0.0, 1.0, 0, list, true, i)) return nullptr;
    entry["flats"].push_back(std::move(list));
  }
  return entry;
}

}  // namespace swept
