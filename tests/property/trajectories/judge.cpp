// SPDX-License-Identifier: BSD-3-Clause
#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "errors.hpp"

namespace trajectories {

namespace {

using swept::Verdict;
using State = std::vector<double>;

constexpr double kSampleTime = 1e-3;  // s
constexpr double kSampleWay = 1e-3;   // rad or m
/// rad or m. Between swept's curve and the judge's.
constexpr double kCurveError = 1e-9;
/// States that are asked about at once.
constexpr std::size_t kTogether = 512;
constexpr std::size_t kMostFaults = 3;  // of one answer
/// Places that are measured, and steps down from the narrowest of these.
constexpr int kPlaces = 8;
constexpr int kClimbs = 3;

std::string text(const State& q) {
  std::ostringstream out;
  out << std::setprecision(17);
  for (std::size_t i = 0; i < q.size(); ++i) out << (i == 0 ? "" : ",") << q[i];
  return out.str();
}

/// rad or m. The way of the joint that goes farthest along a piece.
double longestWay(const Truth& truth, std::size_t piece) {
  constexpr int kSteps = 16;
  const double begin = truth.knots[piece];
  const double length = truth.knots[piece + 1] - begin;
  State last, now, ways;
  for (int i = 0; i <= kSteps; ++i) {
    truth.at(piece, begin + length * i / kSteps, 0, now);
    ways.resize(now.size());
    for (std::size_t k = 0; k < now.size() && i > 0; ++k) ways[k] += std::abs(now[k] - last[k]);
    last = now;
  }
  return *std::ranges::max_element(ways);
}

}  // namespace

Judge::Judge(const Stage& stage, std::size_t most, Random& random)
    : stage_(stage), most_(most), random_(random), workspace_(stage.plain) {}

std::vector<std::string> Judge::faultsOf(const RandomCurve& curve,
                                         const swept::TrajectoryQuery& query,
                                         const swept::TrajectoryCertificate& found,
                                         Judged& judged) {
  curve_ = &curve;
  clock_ = query.clock;
  faults_.clear();
  const double begin = curve.truth.knots.front();
  const double end = curve.truth.knots.back();
  if ((found.verdict == Verdict::Free) != (found.freeUntil == end) || found.freeUntil < begin)
    if (found.verdict == Verdict::Free || found.freeUntil < begin || found.freeUntil > end)
      fault("freeUntil " + text({found.freeUntil}), begin, {});
  if (found.contact.has_value() != (found.verdict == Verdict::Collision) ||
      found.undecided.has_value() != (found.verdict == Verdict::Undecided))
    fault("parts of the answer that are of another verdict", begin, {});
  if (found.contact) judgeContact(*found.contact);
  if (found.undecided) judgeUndecided(*found.undecided);
  if (found.freeUntil > begin) {
    sample(found.freeUntil, judged);
    climb(found.freeUntil, judged);
  }
  return faults_;
}

void Judge::fault(const std::string& what, double t, const State& q) {
  if (faults_.size() < kMostFaults)
    faults_.push_back(what + ", at " + text({t}) + " s: " + text(q));
}

State Judge::at(double t) const {
  State q;
  curve_->truth.at(curve_->truth.pieceAt(t), t, 0, q);
  return q;
}

void Judge::complete(double t, State& q) const {
  if (stage_.timed) q.push_back(clock_ + t);
}

void Judge::sample(double end, Judged& judged) {
  const Truth& truth = curve_->truth;
  std::vector<std::size_t> counts;
  std::size_t all = 0;
  for (std::size_t piece = 0; piece < truth.pieces(); ++piece) {
    const double length = std::min(end, truth.knots[piece + 1]) - truth.knots[piece];
    const double steps =
        length > 0.0
            ? std::ceil(std::max(length / kSampleTime, longestWay(truth, piece) / kSampleWay))
            : 0.0;
    counts.push_back(static_cast<std::size_t>(steps));
    all += counts.back();
  }
  const double share =
      most_ > 0 && all > most_ ? static_cast<double>(most_) / static_cast<double>(all) : 1.0;
  State q;
  std::size_t kind = 0;
  for (std::size_t piece = 0; piece < truth.pieces(); ++piece) {
    const auto count =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(counts[piece])));
    const double begin = truth.knots[piece];
    const double length = std::min(end, truth.knots[piece + 1]) - begin;
    for (std::size_t i = 0; i <= count && length > 0.0; ++i) {
      const double within = i == 0 || i == count ? 0.0 : random_.uniform(-0.5, 0.5);
      const double t = std::min(
          begin + length * (static_cast<double>(i) + within) / static_cast<double>(count), end);
      truth.at(piece, t, 0, q);
      displace(stage_, kErrors[kind++ % kErrors.size()], random_, q);
      complete(t, q);
      times_.push_back(t);
      states_.insert(states_.end(), q.begin(), q.end());
      ++judged.samples;
      if (times_.size() == kTogether) ask(end);
    }
  }
  ask(end);
}

void Judge::ask(double end) {
  std::vector<Verdict> verdicts(times_.size());
  stage_.plain.checkStates(states_, verdicts, workspace_);
  const std::size_t size = states_.size() / std::max<std::size_t>(1, times_.size());
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i] != Verdict::Collision) continue;
    const auto first = states_.begin() + static_cast<std::ptrdiff_t>(i * size);
    fault("free until " + text({end}) + " s, but in contact", times_[i],
          State(first, first + static_cast<std::ptrdiff_t>(size)));
  }
  times_.clear();
  states_.clear();
}

void Judge::climb(double end, Judged& judged) {
  const double begin = curve_->truth.knots.front();
  const double margin = stage_.plain.options().margin;
  double narrowest = std::numeric_limits<double>::infinity();
  double where = begin;
  State gradient(stage_.values() + (stage_.timed ? 1 : 0));
  State steepest;
  const auto measure = [&](State q, double t) {
    complete(t, q);
    const swept::SignedClearance found = stage_.plain.signedClearance(q, workspace_, gradient);
    judged.leastRoom = std::min(judged.leastRoom, found.upper - margin);
    if (stage_.plain.checkState(q, workspace_) == Verdict::Collision)
      fault("free until " + text({end}) + " s, but in contact beside", t, q);
    return found.upper;
  };
  for (int i = 0; i < kPlaces; ++i) {
    const double t = begin + (end - begin) * (i + random_.uniform(0.0, 1.0)) / kPlaces;
    const double room = measure(at(t), t);
    if (!(room < narrowest)) continue;
    narrowest = room;
    where = t;
    steepest = gradient;
  }
  if (steepest.empty()) return;
  const double step = (end - begin) / (2 * kPlaces);
  for (int i = 0; i < kClimbs; ++i) {
    const double t =
        i == 0 ? where
               : std::clamp(where + step * random_.uniform(-1.0, 1.0) / (i * i), begin, end);
    State q = at(t);
    gradient = steepest;
    for (int k = 0; k < 2; ++k) {
      State beside = q;
      displaceAgainst(stage_, gradient, random_, beside);
      measure(std::move(beside), t);
    }
  }
}

void Judge::judgeContact(const swept::TrajectoryContact& contact) {
  State q(contact.configuration.begin(), contact.configuration.end());
  const double beyond = beyondTube(stage_, q, at(contact.time));
  if (beyond > kCurveError)
    fault("a contact that is " + text({beyond}) + " outside of the tube", contact.time, q);
  complete(contact.time, q);
  if (stage_.plain.checkState(q, workspace_) == Verdict::Free)
    fault("a contact that is none", contact.time, q);
}

/// What keeps more than margin and tolerance is proven free, unless the tube takes from it.
void Judge::judgeUndecided(const swept::TrajectoryPlace& place) {
  if (stage_.widest > 0.0) return;
  State q = at(place.time);
  complete(place.time, q);
  const swept::CheckerOptions& options = stage_.plain.options();
  if (stage_.plain.signedClearance(q, workspace_).upper > options.margin + options.tolerance)
    fault("undecided where there is room", place.time, q);
}

}  // namespace trajectories
