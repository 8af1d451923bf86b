// SPDX-License-Identifier: BSD-3-Clause
#include "intervals.hpp"

#include <algorithm>
#include <cstdio>

namespace swept::verify {
namespace {

std::string shortText(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

/// One list of intervals of one pair.
class Intervals {
 public:
  Intervals(const Model& model, const Motion& motion, PairToProve pair, std::string place)
      : model_(model),
        motion_(motion),
        pair_(pair),
        a_(model.bodies[static_cast<std::size_t>(pair.a)]),
        b_(model.bodies[static_cast<std::size_t>(pair.b)]),
        place_(std::move(place)) {}

  /// `check(motion, tree)` for each interval.
  template <typename Check>
  void forEach(const Json& list, const Check& check) {
    if (!list.is_array()) throw Refusal(place_ + ": the intervals are not a list");
    double covered = 0.0;
    for (const Json& interval : list) {
      if (!interval.is_array() || interval.size() != 3)
        throw Refusal(place_ + ": an interval is not begin, end and what proves it");
      const double begin = readNumber(interval[0], place_ + ", begin of an interval");
      const double end = readNumber(interval[1], place_ + ", end of an interval");
      if (!(begin == covered && end > begin && end <= 1.0))
        throw Refusal(place_ + ": the interval from " + shortText(begin) + " to " + shortText(end) +
                      " does not begin at " + shortText(covered) + " and end later, at most at 1");
      at_ = place_ + ", " + shortText(begin) + " to " + shortText(end);
      check(PairMotion(model_, motion_, pair_, begin, end), interval[2]);
      ++summary_.intervals;
      covered = end;
    }
    if (covered != 1.0)
      throw Refusal(place_ + ": nothing proves it from " + shortText(covered) + " to 1");
  }

  void checkTree(const PairMotion& motion, int nodeA, int nodeB, const Json& tree) {
    if (tree.is_array()) {
      if (tree.size() != 4) throw Refusal(at_ + ": a plane is not a direction and a bound");
      const Eigen::Vector3d direction(readNumber(tree[0], at_), readNumber(tree[1], at_),
                                      readNumber(tree[2], at_));
      return checkBound(motion.gap(nodeA, nodeB, direction), tree[3]);
    }
    for (const bool first : {true, false}) {
      const char* key = first ? "a" : "b";
      const Body& body = first ? a_ : b_;
      const int node = first ? nodeA : nodeB;
      if (!tree.is_object() || !tree.contains(key)) continue;
      const Json& halves = tree[key];
      if (body.isLeaf(node) || !halves.is_array() || halves.size() != 2)
        throw Refusal(at_ + ": a node that is no two halves is divided");
      const Body::Node& inner = body.nodes()[static_cast<std::size_t>(node)];
      for (const std::size_t k : {0, 1}) {
        const int half = k == 0 ? inner.left : inner.right;
        checkTree(motion, first ? half : nodeA, first ? nodeB : half, halves[k]);
      }
      return;
    }
    throw Refusal(at_ + ": neither a plane nor two halves");
  }

  void checkFlat(const PairMotion& motion, std::size_t flat, const Json& leaf) {
    if (!leaf.is_array() || leaf.size() != 2 || (leaf[0] != 1 && leaf[0] != -1))
      throw Refusal(at_ + ": not a side, 1 or -1, and a bound");
    checkBound(motion.gapToFlat(0, flat, leaf[0].get<int>()), leaf[1]);
  }

  const Summary& summary() const { return summary_; }

 private:
  /// NaN is refused: it compares as false.
  void checkBound(double gap, const Json& claim) {
    const double bound = readNumber(claim, at_ + ", bound");
    const double margin = model_.marginOf(pair_.a, pair_.b);
    if (!(bound > margin))
      throw Refusal(at_ + ": the bound " + shortText(bound) + " m is not above the margin, " +
                    shortText(margin) + " m");
    if (!(gap >= bound))
      throw Refusal(at_ + ": the bound " + shortText(bound) + " m is not proven, only " +
                    shortText(gap) + " m is");
    summary_.clearance = std::min(summary_.clearance, bound);
    const bool world = model_.withWorld(pair_.a, pair_.b);
    double& ofKind = world ? summary_.clearanceWorld : summary_.clearanceSelf;
    ofKind = std::min(ofKind, bound);
    ++summary_.planes;
  }

  const Model& model_;
  const Motion& motion_;
  PairToProve pair_;
  const Body& a_;
  const Body& b_;
  std::string place_;
  std::string at_;
  Summary summary_;
};

}  // namespace

void Summary::add(const Summary& part) {
  segments += part.segments;
  pairs += part.pairs;
  intervals += part.intervals;
  planes += part.planes;
  clearance = std::min(clearance, part.clearance);
  clearanceWorld = std::min(clearanceWorld, part.clearanceWorld);
  clearanceSelf = std::min(clearanceSelf, part.clearanceSelf);
}

Summary checkPair(const Model& model, const Motion& motion, PairToProve pair, const Json& proof,
                  const std::string& place) {
  const Body& b = model.bodies[static_cast<std::size_t>(pair.b)];
  Intervals check(model, motion, pair, place);
  if (!b.nodes().empty())
    check.forEach(at(proof, "intervals", place), [&](const PairMotion& part, const Json& tree) {
      check.checkTree(part, 0, 0, tree);
    });
  if (b.flats().empty()) return check.summary();
  const Json& lists = at(proof, "flats", place);
  if (!lists.is_array() || lists.size() != b.flats().size())
    throw Refusal(place + ": not one proof for each plane and half-space");
  for (std::size_t i = 0; i < lists.size(); ++i)
    check.forEach(lists[i], [&](const PairMotion& part, const Json& leaf) {
      check.checkFlat(part, i, leaf);
    });
  return check.summary();
}

}  // namespace swept::verify
