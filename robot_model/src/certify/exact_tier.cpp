// SPDX-License-Identifier: BSD-3-Clause
#include "certify/exact_tier.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "certify/near_pairs.hpp"
#include "certify/work_limits.hpp"

namespace swept::detail {

namespace {

/// An interval in which a pair cannot approach by more than this share of the tolerance is not
/// split further. Then the distance at its middle, and so at its begin, is below the tolerance: a
/// motion that keeps more than margin + tolerance is always proven, and freeUntil ends within the
/// tolerance of what stopped it.
constexpr double kStopShare = 0.45;

/// Share of the motion's tolerance that the search for an earlier contact uses. A pair that passes
/// closer than the tolerance must not hide the pair that meets first.
constexpr double kContactShare = 1.0 / 16.0;

class ExactSearch {
 public:
  ExactSearch(const CheckerModel& model, PairQuery& query, ConfirmedContacts& contacts,
              ProofWork& work, Effort& effort)
      : model_(model), query_(query), contacts_(contacts), work_(work), effort_(effort) {}

  void run() {
    if (!contacts_.any() && searchAll()) {
      work_.open.clear();
      work_.provenUntil = 1.0;
    } else if (!contacts_.settle()) {
      // Near the tolerance a proof may depend on the directions that neighbouring intervals
      // suggest. A second attempt in another order settles some pairs that the first left open.
      provePrefix();
    }
  }

 private:
  /// The result of one interval. Open pairs are in work.unresolved.
  struct Outcome {
    bool contact = false;      ///< at the middle
    bool atTolerance = false;  ///< some open pair moves less than the query's tolerance
  };

  Outcome examine(const OpenInterval& interval, std::span<const std::uint32_t> pairs,
                  bool dropAtTolerance) {
    work_.unresolved.clear();
    Outcome outcome;
    if (pairs.empty()) return outcome;
    query_.moveTo(interval.middle(), interval.half());
    ++effort_.intervals;
    for (const std::uint32_t pair : pairs) {
      if (outcome.contact) {  // not looked at: still open
        work_.unresolved.push_back(pair);
        continue;
      }
      const PairAnswer answer = prove(pair, interval.half());
      if (answer.status == Separation::Separated) continue;
      const bool atTolerance = answer.travel <= kStopShare * query_.tolerance();
      if (answer.status == Separation::Contact) {
        outcome.contact = true;
        keepContact(pair, interval.middle(), answer);
      } else if (atTolerance) {
        outcome.contact = keepTubeContact(pair, interval.middle(), answer);
      }
      outcome.atTolerance = outcome.atTolerance || atTolerance;
      if (!(atTolerance && dropAtTolerance)) work_.unresolved.push_back(pair);
    }
    return outcome;
  }

  PairAnswer prove(std::uint32_t pair, double half) {
    const PairAnswer answer = query_.prove(pair, half);
    ++(answer.culled ? effort_.culled : effort_.distances);
    return answer;
  }

  void keepContact(std::uint32_t pair, double t, const PairAnswer& answer) {
    if (t < contacts_.horizon()) contacts_.add(query_.witness(pair, t, answer));
  }

  /// Of a configuration beside the motion.
  bool keepTubeContact(std::uint32_t pair, double t, const PairAnswer& answer) {
    if (t >= contacts_.horizon()) return false;
    std::optional<Witness> witness = query_.tubeContact(pair, answer);
    if (!witness) return false;
    contacts_.add(*std::move(witness));
    return true;
  }

  bool budgetLeft() const { return workLeft(model_, effort_); }

  /// Examines all open work, one level of the bisection at a time, so that contacts show early
  /// wherever they are. Ends at the first contact, or with the level in which an interval turned
  /// out undecidable. True: all of it is proven.
  bool searchAll() {
    OpenWork& now = work_.now;
    OpenWork& next = work_.next;
    groupByInterval(work_);
    while (!now.intervals.empty()) {
      next.clear();
      bool undecided = false;
      for (const OpenInterval& interval : now.intervals) {
        if (!budgetLeft()) return false;
        const Outcome outcome = examine(interval, now.pairsOf(interval), true);
        if (outcome.contact) return false;
        undecided = undecided || outcome.atTolerance;
        const std::size_t first = next.pairs.size();
        next.pairs.insert(next.pairs.end(), work_.unresolved.begin(), work_.unresolved.end());
        next.pushHalves(interval.begin, interval.end, first);
        if (next.pairs.size() > kMostWaiting) return false;
      }
      if (undecided) return false;
      std::swap(now, next);
    }
    return true;
  }

  /// Finds, from the left, the largest t up to which everything is proven, to within the tolerance,
  /// and the first contact. A contact on the way moves the witness forward in time, and nothing
  /// behind it matters any more. Without a contact the search ends where the proof does. With one
  /// it goes on from there: the proof may have ended at a pair that passes close by, or at one of
  /// several that are about to meet.
  void provePrefix() {
    auto& [stack, pairs] = work_.now;
    stackByTime(work_);
    while (!stack.empty()) {
      const OpenInterval interval = stack.back();
      stack.pop_back();
      if (interval.begin >= contacts_.horizon()) break;
      const double middle = interval.middle();
      const bool divides = interval.begin < middle && middle < interval.end;
      if (!divides || !budgetLeft()) return endPrefix(interval.begin);
      const OpenPairs open = sortOpenPairs(interval, work_);
      // Nothing from the contact on matters.
      const bool behind = middle >= contacts_.horizon();
      const bool met = contacts_.any();
      const auto first = pairs.begin() + static_cast<std::ptrdiff_t>(interval.first);
      const std::span<const std::uint32_t> asked(first, behind ? 0 : open.onAll);
      query_.setTolerance((met ? kContactShare : 1.0) * model_.options.tolerance);
      const Outcome outcome = examine(interval, asked, met);
      if (contacts_.settle()) return;
      if (outcome.atTolerance && met && interval.begin == 0.0 && meetAtBegin(asked))
        return endPrefix(0.0);
      // Pairs that are open on a part only wait for that part.
      work_.unresolved.insert(work_.unresolved.end(),
                              first + static_cast<std::ptrdiff_t>(asked.size()),
                              first + static_cast<std::ptrdiff_t>(open.onAll + open.onPart));
      pairs.resize(interval.first);
      if (outcome.contact) work_.now.clear();
      const bool tooMany = pairs.size() + 2 * work_.unresolved.size() > kMostWaiting;
      if (tooMany || (outcome.atTolerance && !contacts_.any())) return endPrefix(interval.begin);
      if (outcome.atTolerance && met) endPrefix(interval.begin);
      if (work_.unresolved.empty()) continue;
      if (!outcome.contact && !behind) push(middle, interval.end);
      push(interval.begin, middle);
    }
    endPrefix(std::min(contacts_.horizon(), 1.0));
    work_.open.clear();
  }

  /// Whether one of these pairs is in contact where the motion begins.
  bool meetAtBegin(std::span<const std::uint32_t> pairs) {
    query_.moveTo(0.0, 0.0);
    for (const std::uint32_t pair : pairs) {
      const PairAnswer answer = prove(pair, 0.0);
      if (answer.status == Separation::Contact)
        keepContact(pair, 0.0, answer);
      else if (answer.status == Separation::Separated || !keepTubeContact(pair, 0.0, answer))
        continue;
      return true;
    }
    return false;
  }

  /// The first call sets the end. The search may go on behind it.
  void endPrefix(double end) {
    if (prefixEnded_) return;
    prefixEnded_ = true;
    work_.provenUntil = end;
  }

  void push(double begin, double end) {
    auto& [stack, pairs] = work_.now;
    stack.push_back({begin, end, pairs.size(), work_.unresolved.size()});
    pairs.insert(pairs.end(), work_.unresolved.begin(), work_.unresolved.end());
  }

  const CheckerModel& model_;
  PairQuery& query_;
  ConfirmedContacts& contacts_;
  ProofWork& work_;
  Effort& effort_;
  bool prefixEnded_ = false;
};

}  // namespace

void ExactTier::prove(ProofWork& work) {
  if (!oracle_.start()) return;
  if (work.everything) {
    // Every pair whose boxes, swept over the whole motion, come near each other.
    work.open.clear();
    query_.moveTo(0.5, 0.5);
    NearGeometries(model_, query_, workspace_).collect(0.5, work.open.pairs);
    if (!work.open.pairs.empty())
      work.open.intervals.push_back({0.0, 1.0, 0, work.open.pairs.size()});
    work.everything = false;
  }
  ExactSearch(model_, query_, contacts_, work, effort_).run();
}

}  // namespace swept::detail
