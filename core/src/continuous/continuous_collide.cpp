// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/continuous/continuous_collide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "continuous/leaf_contact.hpp"
#include "continuous/relative_motion.hpp"
#include "continuous/slice_descent.hpp"
#include "geometry/nearest_rotation.hpp"
#include "narrowphase/convex_pair.hpp"
#include "narrowphase/enclosure.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

struct ContinuousWorkspace::Data {
  /// An interval, and the range [begin, end) of the workspace's pairs that are open in it.
  struct Interval {
    double from;
    double to;
    std::size_t begin;
    std::size_t end;
  };

  std::vector<detail::OpenPair> open;
  std::vector<Interval> waiting;  ///< the earliest last
};

ContinuousWorkspace::ContinuousWorkspace() : data_(std::make_unique<Data>()) {}
ContinuousWorkspace::ContinuousWorkspace(ContinuousWorkspace&&) noexcept = default;
ContinuousWorkspace& ContinuousWorkspace::operator=(ContinuousWorkspace&&) noexcept = default;
ContinuousWorkspace::~ContinuousWorkspace() = default;

namespace {

using detail::LeafContact;
using detail::MotionSlice;
using detail::OpenPair;
using detail::Side;
using detail::SliceDescent;
using Eigen::Isometry3d;
using Interval = ContinuousWorkspace::Data::Interval;

/// Share of the tolerance that distances may use.
constexpr double kQueryShare = 1.0 / 16.0;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Contacts are located to this share of the tolerance: an interval of that length before a contact
/// is short (less than two thirds; see isShort()).
constexpr double kContactShare = 0.6;

/// In units of t. Shorter intervals have no middle.
constexpr double kShortest = 1e-15;

/// Quick to compute, though not the smallest: moving nodes have their own bounds anyway.
BoundingSphere ballAround(const Side& side, const Shape& shape) {
  if (side.isConvex()) return boundingSphere(shape);
  const detail::OrientedBox& box = side.bvh->rootBox();
  const double half = std::sqrt(static_cast<double>(box.half[0]) * box.half[0] +
                                static_cast<double>(box.half[1]) * box.half[1] +
                                static_cast<double>(box.half[2]) * box.half[2]);
  return {box.center, half * (1.0 + 1e-6)};
}

bool areFinite(const ContinuousOptions& options) {
  return std::isfinite(options.margin) && std::isfinite(options.tolerance) &&
         std::isfinite(options.timeTolerance);
}

/// Intervals in order of time, each with the open pairs of the interval that it is a part of.
class TimeSearch {
 public:
  TimeSearch(const Shape& a, const Motion& motionA, const Shape& b, const Motion& motionB,
             const ContinuousOptions& options, ContinuousWorkspace::Data& data)
      : shapeA_(a),
        shapeB_(b),
        a_(Side::of(a)),
        b_(Side::of(b)),
        motionA_(motionA),
        motionB_(motionB),
        motion_(ballAround(a_, a), motionA, ballAround(b_, b), motionB),
        options_(options),
        leaves_(a_, b_, motion_, options.margin, kQueryShare * options.tolerance),
        open_(data.open),
        waiting_(data.waiting) {}

  ContinuousResult run() {
    if (!(options_.margin >= 0.0) || !areFinite(options_)) return result_;
    if (decidedAtStart()) return result_;
    open_.assign(1, OpenPair{});
    waiting_.assign(1, Interval{0.0, 1.0, 0, 1});
    while (!waiting_.empty()) {
      const Interval next = waiting_.back();
      waiting_.pop_back();
      if (result_.effort.intervals >= options_.maxIntervals || grazed_ >= tolerance::kMaxGrazing) {
        stopAt(next.from);
        break;
      }
      examine(next);
    }
    result_.freeUntil = std::min(firstUnproven_, result_.contactBy);
    if (contact_) {
      result_.verdict = Verdict::Collision;
    } else if (firstUnproven_ > 1.0) {
      result_.verdict = Verdict::Free;
    }
    return result_;
  }

 private:
  /// True: the query is finished.
  bool decidedAtStart() {
    const Isometry3d world_from_a = detail::rigidPose(motionA_.at(0.0));
    const Isometry3d a_from_b = world_from_a.inverse() * detail::rigidPose(motionB_.at(0.0));
    if (!world_from_a.matrix().allFinite() || !a_from_b.matrix().allFinite()) return true;
    // Touching without a margin is decided exactly; a distance only says how far apart they are.
    const bool exact = !(options_.margin > 0.0);
    if (exact && collide(shapeA_, shapeB_, a_from_b) != Contact::Touching) return false;
    DistanceOptions options;
    options.enough = options.contact = options_.margin;
    options.tolerance = exact ? 0.0 : kQueryShare * options_.tolerance;
    const DistanceResult found = distance(shapeA_, shapeB_, a_from_b, options);
    if (!exact && !(found.upper <= options_.margin)) return false;
    noteContact(0.0, world_from_a, found.pointA, found.pointB);
    result_.verdict = Verdict::Collision;
    return true;
  }

  void noteContact(double t, const Isometry3d& world_from_a, const Eigen::Vector3d& pointA,
                   const Eigen::Vector3d& pointB) {
    contact_ = true;
    result_.contactBy = t;
    result_.pointA = world_from_a * pointA;
    result_.pointB = world_from_a * pointB;
  }

  void stopAt(double t) { firstUnproven_ = std::min(firstUnproven_, t); }

  void examine(const Interval& interval) {
    open_.resize(interval.end);
    const MotionSlice slice = motion_.over(interval.from, interval.to, options_.margin);
    if (!slice.finite) {
      stopAt(interval.from);
      waiting_.clear();
      return;
    }
    ++result_.effort.intervals;
    const bool last = isShort(interval.to - interval.from, kInfinity);
    const SliceDescent::Goal goal{options_.margin, kQueryShare * options_.tolerance,
                                  last ? kInfinity : shortApproach()};
    SliceDescent descent(a_, b_, slice, goal, open_, result_.effort);
    for (std::size_t i = interval.begin; i < interval.end; ++i) {
      const OpenPair pair = open_[i];
      descent.look(pair);
    }
    if (descent.contact()) {
      noteContact(slice.middle, slice.world_from_a, descent.contact()->pointA,
                  descent.contact()->pointB);
      bracket(interval, slice, descent);
    } else if (open_.size() > interval.end) {
      divide(interval, slice, descent);
    }
  }

  /// After a contact at the middle: searches an earlier one.
  void bracket(const Interval& interval, const MotionSlice& slice, const SliceDescent& descent) {
    waiting_.clear();
    // The approach shrinks at least in proportion to the interval.
    if (isShort(slice.middle - interval.from, 0.5 * descent.approach())) {
      stopAt(interval.from);
      return;
    }
    LeafContact::Range range = rangeOf(slice, descent);
    range.from = interval.from;
    range.to = slice.middle;
    range.touching = true;
    lookForContact(open_[interval.end], range);
    push({interval.from, result_.contactBy, interval.end, open_.size()});
  }

  /// Continues with the unproven part of an interval.
  void divide(const Interval& interval, const MotionSlice& slice, const SliceDescent& descent) {
    if (isShort(interval.to - interval.from, descent.approach())) {
      stopAt(interval.from);
      ++grazed_;
      if (!lookThrough(interval, slice, descent)) lookInside(interval.to);
      return;
    }
    const SliceDescent::Proven& proven = descent.proven();
    Interval before = interval, after = interval;
    before.begin = after.begin = interval.end;
    before.end = after.end = open_.size();
    const double half = slice.half(), middle = slice.middle;
    before.to = proven.before < 1.0 ? std::min(middle, middle - proven.before * half + kShortest)
                                    : before.from;
    after.from =
        proven.after < 1.0 ? std::max(middle, middle + proven.after * half - kShortest) : after.to;
    // If an interval ends with a contact, its pair is known.
    const bool ends = contact_ && interval.to == result_.contactBy;
    if (descent.nearest() && !ends && proven.after > 0.0) {
      LeafContact::Range range = rangeOf(slice, descent);
      range.from = after.from;
      range.to = after.to;
      if (lookForContact(*descent.nearest(), range)) {
        waiting_.clear();
        after.to = result_.contactBy;
      }
    }
    push(after);
    push(before);
  }

  /// Thin things can touch and part again within one short interval. All that is left of it is
  /// pairs of leaves.
  bool lookThrough(const Interval& interval, const MotionSlice& slice,
                   const SliceDescent& descent) {
    LeafContact::Range range = rangeOf(slice, descent);
    range.resolution =
        std::max(kContactShare * options_.tolerance * slice.half() / descent.approach(), kShortest);
    range.from = interval.from;
    range.to = contact_ ? std::min(interval.to, result_.contactBy) : interval.to;
    bool found = false;
    for (std::size_t i = interval.end; i < open_.size(); ++i) {
      if (!lookForContact(open_[i], range)) continue;
      found = true;
      range.to = result_.contactBy;
    }
    if (found) waiting_.clear();
    return found;
  }

  /// A flat body can pass through a surface within one short interval: afterwards it is apart from
  /// the surface, and inside.
  void lookInside(double t) {
    if (contact_ && t >= result_.contactBy) return;
    const Isometry3d world_from_a = detail::rigidPose(motionA_.at(t));
    const std::optional<Eigen::Vector3d> point =
        detail::enclosedPoint(a_, b_, world_from_a.inverse() * detail::rigidPose(motionB_.at(t)));
    if (!point) return;
    noteContact(t, world_from_a, *point, *point);
    waiting_.clear();
  }

  LeafContact::Range rangeOf(const MotionSlice& slice, const SliceDescent& descent) const {
    LeafContact::Range range;
    const double half = slice.half();
    range.resolution =
        std::max(kContactShare * std::max(options_.tolerance * half / descent.approach(),
                                          options_.timeTolerance),
                 kShortest);
    range.bend = slice.approach.curvature / (half * half);
    return range;
  }

  bool lookForContact(const OpenPair& pair, const LeafContact::Range& range) {
    const std::optional<LeafContact::Found> found = leaves_.find(pair, range, result_.effort);
    if (found) noteContact(found->t, found->world_from_a, found->pointA, found->pointB);
    return found.has_value();
  }

  void push(const Interval& interval) {
    if (interval.from < interval.to) waiting_.push_back(interval);
  }

  /// `approach`: m, in half of it. The first contact may be after the middle of an interval, and is
  /// then found in the next one: both together are as long as requested.
  bool isShort(double length, double approach) const {
    return approach <= shortApproach() || 1.5 * length <= options_.timeTolerance ||
           length <= kShortest;
  }
  /// m. Pieces below this are divided too, so that short intervals leave only pairs of leaves.
  double shortApproach() const { return options_.tolerance / 3.0; }

  const Shape& shapeA_;
  const Shape& shapeB_;
  const Side a_;
  const Side b_;
  const Motion& motionA_;
  const Motion& motionB_;
  const detail::RelativeMotion motion_;
  const ContinuousOptions& options_;
  const LeafContact leaves_;
  std::vector<OpenPair>& open_;
  std::vector<Interval>& waiting_;
  ContinuousResult result_;
  double firstUnproven_ = 2.0;  ///< beyond every t: none
  int grazed_ = 0;
  bool contact_ = false;
};

}  // namespace

ContinuousResult continuousCollide(const Shape& a, const Motion& motionA, const Shape& b,
                                   const Motion& motionB, const ContinuousOptions& options,
                                   ContinuousWorkspace& workspace) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return continuousCollide(a, motionA, b, motionB, options, workspace); });
  }
  return TimeSearch(a, motionA, b, motionB, options, workspace.data()).run();
}

ContinuousResult continuousCollide(const Shape& a, const Motion& motionA, const Shape& b,
                                   const Motion& motionB, const ContinuousOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return continuousCollide(a, motionA, b, motionB, options); });
  }
  ContinuousWorkspace workspace;
  return continuousCollide(a, motionA, b, motionB, options, workspace);
}

}  // namespace swept
