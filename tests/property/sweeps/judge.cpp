// SPDX-License-Identifier: BSD-3-Clause
#include "judge.hpp"

#include <algorithm>
#include <sstream>

namespace sweeps {

using swept::ContinuousResult;
using swept::Verdict;

namespace {

/// Tolerances.
constexpr double kWidth = 1.0 + 1e-6;

template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(17);
  (out << ... << parts);
  return out.str();
}

}  // namespace

Judge::Judge(const Sweep& sweep)
    : sweep_(sweep), gap_(sweep.a, sweep.b), allowance_(1e-14 * sweep.magnitude()) {}

void Judge::fault(const std::string& what) {
  found_.faults.push_back(what);
}

double Judge::gapAt(double t) {
  ++found_.samples;
  return gap_(relative(sweep_.pathA, sweep_.pathB, t));
}

/// For certain.
bool Judge::within(double t) {
  const Isometry3d pose = relative(sweep_.pathA, sweep_.pathB, t);
  const double margin = sweep_.options.margin;
  if (margin > allowance_) return gap_(pose) <= margin - allowance_;
  for (int i = 0; i < 6; ++i) {
    Isometry3d shifted = pose;
    shifted.translation()[i / 2] += i % 2 == 0 ? allowance_ : -allowance_;
    if (gap_(shifted) > 0.01 * allowance_) return false;
  }
  return true;
}

Judgement Judge::judge(const ContinuousResult& result, Random& random) {
  found_ = {};
  checkNumbers(result);
  if (!found_.faults.empty()) return found_;
  checkKnown(result);
  refute(result.verdict == Verdict::Free ? 1.0 : result.freeUntil, random);
  if (result.verdict == Verdict::Collision) checkWitness(result);
  if (result.verdict == Verdict::Undecided) checkUndecided(result, random);
  if (result.verdict != Verdict::Free && decidable(result)) {
    checkStop(result);
  }
  return found_;
}

void Judge::checkNumbers(const ContinuousResult& r) {
  const bool free = r.verdict == Verdict::Free;
  const bool collision = r.verdict == Verdict::Collision;
  if (!(r.freeUntil >= 0.0 && r.freeUntil <= 1.0)) fault("freeUntil is not in [0, 1]");
  if (!(r.contactBy >= 0.0 && r.contactBy <= 1.0)) fault("contactBy is not in [0, 1]");
  if (!(r.freeUntil <= r.contactBy)) fault("freeUntil is after contactBy");
  if (free && r.freeUntil != 1.0) fault("free, but not until 1");
  if (!collision && r.contactBy != 1.0) fault("contactBy without a contact");
  if (collision && !(r.pointA.allFinite() && r.pointB.allFinite())) fault("witness is not finite");
  if (!(r.effort.intervals <= sweep_.options.maxIntervals + 1))
    fault("more intervals than allowed");
}

/// Whether the tolerance is to be kept to: no cap was reached, nor a tolerance of time that is
/// coarser. That two endless surfaces are parallel is lost to the rounding of any turn.
bool Judge::decidable(const ContinuousResult& r) const {
  const bool flats = sweep_.a.flat() && sweep_.b.flat();
  return r.effort.intervals < sweep_.options.maxIntervals && !flats &&
         !(sweep_.options.timeTolerance > 0.0);
}

void Judge::checkKnown(const ContinuousResult& r) {
  const bool free = r.verdict == Verdict::Free;
  if (sweep_.mustBeFree && !free && decidable(r)) {
    fault(text("keeps more than margin + tolerance by construction, but ", toString(r.verdict),
               " from ", r.freeUntil));
  }
  found_.contact = within(sweep_.t);
  if (found_.contact && (free || r.freeUntil > sweep_.t)) {
    fault(text("MISSED: in contact at ", sweep_.t, " by construction, but free until ",
               free ? 1.0 : r.freeUntil));
  }
  const bool capped = r.effort.intervals >= sweep_.options.maxIntervals;
  if (r.verdict != Verdict::Collision || !(sweep_.speed > 0.0) || capped) return;
  const double first = sweep_.t - std::max(0.0, sweep_.depth) / sweep_.closing;
  if (first < 0.0) return;
  const double time = r.contactBy - r.freeUntil;
  const swept::ContinuousOptions& o = sweep_.options;
  if (r.contactBy < first - allowance_ / sweep_.closing) fault("contact before the first");
  // Thin things are through again before the search looks.
  for (int i = 1; i <= 8; ++i) {
    const double later = sweep_.t + 0.2 * i * o.tolerance / sweep_.speed;
    if (later > 1.0 || gapAt(later) > o.margin) return;
  }
  found_.width = std::min(time * sweep_.speed / o.tolerance,
                          o.timeTolerance > 0.0 ? time / o.timeTolerance : INFINITY);
  const double rounding = 4.0 * allowance_ * sweep_.speed / (sweep_.closing * o.tolerance);
  if (*found_.width > kWidth + rounding) {
    fault(text("straight crossing at ", sweep_.t, " found only between ", r.freeUntil, " and ",
               r.contactBy, ": ", *found_.width, " tolerances"));
  }
}

void Judge::checkWitness(const ContinuousResult& r) {
  const Isometry3d atA = sweep_.pathA.at(r.contactBy), atB = sweep_.pathB.at(r.contactBy);
  const double offA = outside(sweep_.a, atA.inverse(Eigen::Isometry) * r.pointA);
  const double offB = outside(sweep_.b, atB.inverse(Eigen::Isometry) * r.pointB);
  // Rotations take the library's bound, twenty times an ulp, to the shapes' frames and back.
  const double far = r.pointA.norm() + r.pointB.norm();
  const double allowed = 100.0 * (allowance_ + 1e-14 * far);
  if (!(offA <= allowed)) fault(text("witness is ", offA, " m outside of a"));
  if (!(offB <= allowed)) fault(text("witness is ", offB, " m outside of b"));
  const double apart = (r.pointA - r.pointB).norm() - sweep_.options.margin;
  if (!(apart <= allowed)) fault(text("witnesses are ", apart, " m farther apart than the margin"));
}

std::pair<double, double> Judge::descend(double low, double high) {
  constexpr double kGolden = 0.6180339887498949;
  double x = high - kGolden * (high - low), y = low + kGolden * (high - low);
  double fx = gapAt(x), fy = gapAt(y);
  for (int i = 0; i < 24; ++i) {
    if (fx <= fy) {
      high = y, y = x, fy = fx;
      x = high - kGolden * (high - low), fx = gapAt(x);
    } else {
      low = x, x = y, fx = fy;
      y = low + kGolden * (high - low), fy = gapAt(y);
    }
  }
  return fx <= fy ? std::pair(x, fx) : std::pair(y, fy);
}

void Judge::lookAt(double t) {
  const double over = gapAt(t) - sweep_.options.margin;
  found_.leastGap = std::min(found_.leastGap, over);
  if (over <= allowance_ && within(t)) {
    fault(text("REFUTED: within the margin at ", t, " by ", -over, " m or more"));
  }
}

/// Samples, descents from the two least, and what comes shortly before the proof ends.
void Judge::refute(double until, Random& random) {
  if (!(until > 0.0)) return;
  constexpr int kCount = 14;
  std::array<std::pair<double, double>, kCount> samples;
  for (int i = 0; i < kCount; ++i) {
    const double t = until * (i == 0 ? 0.0 : (i + random.uniform(-0.5, 0.5)) / kCount);
    samples[i] = {gapAt(t), t};
  }
  std::sort(samples.begin(), samples.end());
  const double step = 1.5 * until / kCount;
  for (int i = 0; i < 2 && found_.faults.empty(); ++i) {
    lookAt(samples[i].second);
    const double t = samples[i].second;
    lookAt(descend(std::max(0.0, t - step), std::min(until, t + step)).first);
  }
  for (double back = 1e-2; back > 1e-13 && found_.faults.empty(); back *= 0.03) {
    lookAt(until * (1.0 - back));
  }
  if (sweep_.t < until && found_.faults.empty()) lookAt(sweep_.t);
}

/// A proof may end only where the tolerance is nearly used up: a contact, or what cannot be told
/// from one, is at most so much relative motion away.
void Judge::checkStop(const ContinuousResult& r) {
  const swept::ContinuousOptions& o = sweep_.options;
  found_.stop = (gapAt(r.freeUntil) - o.margin) / o.tolerance;
  if (found_.stop > kWidth + 100.0 * allowance_ / o.tolerance) {
    fault(text("the proof ended at ", r.freeUntil, ", ", found_.stop,
               " tolerances beyond the margin"));
  }
}

/// What keeps more than margin + tolerance has to be Free.
void Judge::checkUndecided(const ContinuousResult& r, Random& random) {
  if (!decidable(r)) return;
  const double enough = sweep_.options.margin + sweep_.options.tolerance;
  double least = INFINITY, best = r.freeUntil;
  const double from = r.freeUntil, rest = 1.0 - from;
  for (int i = 0; i <= 200; ++i) {
    // Denser where the proof ended.
    const double share = i / 200.0;
    const double t = i % 2 == 0 ? from + rest * share * share * share * share
                                : from + rest * std::min(1.0, share + random.uniform(0.0, 5e-3));
    const double gap = gapAt(t);
    if (gap < least) least = gap, best = t;
    if (least <= enough + allowance_) return;
  }
  least = std::min(least, descend(std::max(0.0, best - 6e-3), std::min(1.0, best + 6e-3)).second);
  if (least > enough + 100.0 * allowance_) {
    fault(text("undecided from ", from, ", but no sample after is closer than ", least));
  }
}

}  // namespace sweeps
