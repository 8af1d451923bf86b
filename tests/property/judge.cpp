// SPDX-License-Identifier: BSD-3-Clause
#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

using swept::MotionCertificate;
using swept::Verdict;

namespace {

constexpr double kNear = 5e-3;     // m, closer than this is grazing
constexpr double kWitness = 1e-6;  // m, how far a witness point may be off
constexpr double kFar = 0.02;      // m, clearances beyond this are all alike

}  // namespace

std::string commas(const std::vector<double>& values) {
  std::ostringstream out;
  out << std::setprecision(17);
  for (size_t i = 0; i < values.size(); ++i) out << (i ? "," : "") << values[i];
  return out.str();
}

void Judge::motion(const State& from, const State& to, const MotionCertificate& certificate,
                   swept::MotionQuery query) {
  from_ = &from;
  to_ = &to;
  ++report_.motions;
  switch (certificate.verdict) {
    case Verdict::Free:
      ++report_.free;
      break;
    case Verdict::Collision:
      ++report_.collision;
      break;
    case Verdict::Violation:
      fail("a violation without constraints");
      break;
    case Verdict::Undecided:
      ++report_.undecided;
      break;
  }
  const bool free = certificate.verdict == Verdict::Free;
  if (free != (certificate.freeUntil == 1.0)) fail("freeUntil does not fit the verdict");
  if (certificate.witness.has_value() != (certificate.verdict == Verdict::Collision))
    fail("a witness is there exactly when the verdict is collision");
  provenPrefix(free ? 1.0 : certificate.freeUntil, free);
  if (!free && query == swept::MotionQuery::FirstContact) stop(certificate.freeUntil);
  if (certificate.verdict == Verdict::Undecided) grazes(certificate.undecidedAt);
  if (certificate.witness) witness(certificate);
}

void Judge::sameAgain(const State& a, const State& b, const MotionCertificate& known) {
  swept::Workspace fresh(*scenario_.checker);
  const auto again = scenario_.checker->certifyMotion(a, b, fresh);
  const auto quick = scenario_.checker->certifyMotion(a, b, fresh, swept::MotionQuery::VerdictOnly);
  if (again.verdict != known.verdict || again.freeUntil != known.freeUntil)
    fail("the answer changed with a fresh workspace");
  const auto opposite = [&](Verdict v) {
    return v != known.verdict && v != Verdict::Undecided && known.verdict != Verdict::Undecided;
  };
  if (quick.verdict != known.verdict) fail("VerdictOnly and FirstContact disagree");
  const auto back = scenario_.checker->certifyMotion(b, a, fresh);
  if (opposite(back.verdict)) fail("the way back gets the opposite answer");
}

void Judge::fail(const std::string& what) {
  const std::string from = commas(scenario_.groupOf(*from_));
  const std::string to = commas(scenario_.groupOf(*to_));
  std::ostringstream out;
  out << what << "\n  " << (scenario_.onlyHere ? "refute --robot " : "swept motion ")
      << scenario_.robot.string() << ' ' << scenario_.worldArguments;
  if (!scenario_.srdf.empty()) out << " --srdf " << scenario_.srdf.string();
  out << " --group " << scenario_.group << " --margin " << margin_ << " --tolerance " << tolerance_;
  if (scenario_.onlyHere)
    out << " --from=" << from << " --to=" << to;
  else
    out << " -- " << from << ' ' << to;
  report_.failures.push_back(out.str());
}

double Judge::room(double t, double enough) {
  ++report_.states;
  return judge_.clearance(at(t), margin_ + enough).upper - margin_;
}

bool Judge::refuted(double t) {
  ++report_.states;
  const State q = at(t);
  if (const auto hit = judge_.hit(q)) {
    std::ostringstream out;
    out << std::setprecision(17) << "REFUTED: said to be free, but at t = " << t << ' ' << hit.bodyA
        << " overlaps " << hit.bodyB;
    fail(out.str());
    return true;
  }
  return false;
}

void Judge::provenPrefix(double end, bool whole) {
  if (!(end > 0)) return;
  const double length = judge_.arm().largestChange(*from_, *to_) * end;
  const double steps = length / options_.step;
  if (!(steps >= 0.0 && steps < 1e9)) {
    std::ostringstream out;
    out << "a way of " << length << " rad or m has " << steps << " steps; allowed: 0 to 1e9";
    throw std::invalid_argument(out.str());
  }
  const int n = 1 + static_cast<int>(steps);
  for (int i = 0; i <= n - (whole ? 0 : 1); ++i)
    if (refuted(end * i / n)) return;
  const double least = narrowest(end, n);
  if (least < kNear) ++report_.grazing;
  if (whole) report_.leastRoomOfFree = std::min(report_.leastRoomOfFree, least);
  if (least < -1e-9 || (least <= 0 && margin_ == 0)) {
    std::ostringstream out;
    out << "REFUTED: said to be free, but the room left is " << least << " m";
    fail(out.str());
  }
}

double Judge::narrowest(double end, int n) {
  const int coarse = std::clamp(n / 40, 8, 60);
  double best = kFar, bestT = 0;
  auto look = [&](double t) {
    const double r = room(t, best);
    if (r < best) best = r, bestT = t;
  };
  // Not the very end of a prefix: what lies there is what ended it.
  const double last = end * (1 - 1e-12);
  for (int i = 0; i <= coarse; ++i) look(last * i / coarse);
  if (best >= kFar) return best;
  double reach = 0.5 * end / coarse;
  for (int i = 0; i < 14 && best > 0; ++i, reach *= 0.6) {
    const double middle = bestT;
    look(std::max(0.0, middle - reach));
    look(std::min(last, middle + reach));
  }
  if (best > 1e-3) return best;
  const double width = std::min(0.25, 2.0 / n) * end, middle = bestT;
  for (int i = 0; i <= 100 && best > 0; ++i) {
    const double t = middle + width * (i / 50.0 - 1);
    if (t >= 0 && t <= last && refuted(t)) return 0;
  }
  return best;
}

void Judge::stop(double t) {
  ++report_.states;
  const oracle::Gap gap = judge_.clearance(at(t), margin_ + kFar);
  report_.widestStop = std::max(report_.widestStop, gap.lower - margin_);
  if (gap.lower > margin_ + 2 * tolerance_) {
    std::ostringstream out;
    out << std::setprecision(17) << "the proven prefix ends at t = " << t << " with "
        << gap.lower - margin_ << " m of room";
    fail(out.str());
  }
}

void Judge::grazes(double undecidedAt) {
  const double length = judge_.arm().largestChange(*from_, *to_);
  const int n = 1 + static_cast<int>(length / options_.step);
  double least = kFar;
  for (int i = 0; i <= 100; ++i)
    least = std::min(least, room(std::clamp(undecidedAt + (i - 50) / 10.0 / n, 0.0, 1.0), least));
  if (least > tolerance_) least = std::min(least, narrowest(1.0, n));
  report_.roomiestUndecided = std::max(report_.roomiestUndecided, least);
  if (least > tolerance_ + 1e-4) {
    std::ostringstream out;
    out << "undecided, but the least room found is " << least << " m";
    fail(out.str());
  }
}

void Judge::witness(const MotionCertificate& certificate) {
  const swept::Witness& w = *certificate.witness;
  std::ostringstream out;
  if (!(w.t >= certificate.freeUntil && w.t <= 1)) out << " t = " << w.t << " is off;";
  const auto pairs = judge_.pairs();
  const bool known = std::any_of(pairs.begin(), pairs.end(), [&](const auto& p) {
    return (p.first == w.bodyA && p.second == w.bodyB) ||
           (p.first == w.bodyB && p.second == w.bodyA);
  });
  if (!known) {
    fail("the witness names a pair that is not checked: " + w.bodyA + ", " + w.bodyB);
    return;
  }
  const State q = at(w.t);
  const double offA = judge_.distanceTo(w.bodyA, q, w.pointA);
  const double offB = judge_.distanceTo(w.bodyB, q, w.pointB);
  const double apart = (w.pointA - w.pointB).norm();
  if (!(offA <= kWitness)) out << " point A is " << offA << " m off " << w.bodyA << ';';
  if (!(offB <= kWitness)) out << " point B is " << offB << " m off " << w.bodyB << ';';
  if (!(apart <= margin_ + kWitness)) out << " the points are " << apart << " m apart;";
  if (!(std::abs(apart - w.distance) <= kWitness)) out << " distance says " << w.distance << ';';
  if (!out.str().empty()) fail("the witness does not hold:" + out.str());
}
