// SPDX-License-Identifier: BSD-3-Clause
#include "refutation.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "judge.hpp"

namespace soak {

using swept::MotionCertificate;
using swept::Verdict;

namespace {

constexpr double kTouch = 1e-6;  // m: so close, the oracle calls it contact
constexpr double kFar = 0.01;    // m: distances beyond the margin and this are all alike
constexpr int kRebuilt = 16;     // one sample in so many is asked in a checker made anew

bool same(const swept::Witness& a, const swept::Witness& b) {
  return a.t == b.t && a.bodyA == b.bodyA && a.bodyB == b.bodyB && a.pointA == b.pointA &&
         a.pointB == b.pointB && a.distance == b.distance;
}

bool same(const MotionCertificate& a, const MotionCertificate& b) {
  if (a.witness.has_value() != b.witness.has_value()) return false;
  return a.verdict == b.verdict && a.freeUntil == b.freeUntil && a.undecidedAt == b.undecidedAt &&
         (!a.witness || same(*a.witness, *b.witness));
}

std::string text(const MotionCertificate& answer, bool motion) {
  std::ostringstream out;
  out << std::setprecision(17) << toString(answer.verdict);
  if (!motion) return out.str();
  out << ", free until " << answer.freeUntil << ", undecided at " << answer.undecidedAt;
  if (answer.witness)
    out << ", contact at " << answer.witness->t << ' ' << answer.witness->bodyA << " - "
        << answer.witness->bodyB;
  return out.str();
}

}  // namespace

std::string reproducer(const Sample& sample, std::uint64_t seed) {
  const Stage& stage = sample.version->stage;
  std::ostringstream out;
  out << "  answered " << toString(sample.way) << ": " << text(sample.answer, !sample.to.empty())
      << "\n  soak --robot " << stage.files().robot.string();
  if (!stage.files().srdf.empty()) out << " --srdf " << stage.files().srdf.string();
  out << " --group " << stage.files().group << " --margin " << stage.margin() << " --seed " << seed
      << " --world " << toString(sample.version->key) << " --from=" << commas(sample.from);
  if (!sample.to.empty()) out << " --to=" << commas(sample.to);
  if (!sample.to.empty() && sample.query == swept::MotionQuery::VerdictOnly)
    out << " --verdict-only";
  return out.str();
}

MotionCertificate ask(const swept::Checker& checker, const Sample& sample) {
  swept::Workspace workspace(checker);
  if (!sample.to.empty())
    return checker.certifyMotion(sample.from, sample.to, workspace, sample.query);
  MotionCertificate answer;
  answer.verdict = checker.checkState(sample.from, workspace);
  return answer;
}

void Refutation::fail(const Sample& sample, const std::string& what) {
  failures_.add(what + '\n' + reproducer(sample, seed_));
}

void Refutation::sameAgain(const Sample& sample, const swept::Checker& checker, const char* where) {
  const MotionCertificate again = ask(checker, sample);
  if (!same(sample.answer, again))
    fail(sample, std::string("asked again ") + where + ": " + text(again, !sample.to.empty()));
}

void Refutation::judge(const Sample& sample) {
  const Version& version = *sample.version;
  sameAgain(sample, *version.checker, "of the same version by one thread");
  if ((counts_.states + counts_.motions) % kRebuilt == 0) {
    const auto world = std::make_shared<const swept::World>(version.stage.worldOf(version.key));
    sameAgain(sample, version.stage.empty().withWorld(world), "in the same world made anew");
    ++counts_.rebuilt;
  }
  sample.to.empty() ? state(sample) : motion(sample);
}

void Refutation::state(const Sample& sample) {
  ++counts_.states;
  ++counts_.oracleStates;
  const Version& version = *sample.version;
  const Scenario scenario = version.stage.judged(version.key, *version.checker);
  const std::vector<double> q = scenario.full(sample.from);
  const double margin = version.stage.margin();
  const oracle::Gap gap = scenario.oracle->clearance(q, margin + kFar);
  const auto hit = scenario.oracle->hit(q);
  std::ostringstream out;
  if (sample.answer.verdict == Verdict::Free) {
    if (hit) out << "REFUTED: said to be free, but " << hit.bodyA << " overlaps " << hit.bodyB;
    // Two roundings of a distance are no refutation.
    else if (gap.upper < margin - 1e-9)
      out << "REFUTED: said to be free, but the distance is " << gap.upper << " m";
  } else if (gap.lower > margin + kTouch) {
    out << "said to be " << toString(sample.answer.verdict) << ", but nothing is closer than "
        << gap.lower << " m";
  }
  if (!out.str().empty()) fail(sample, out.str());
}

void Refutation::motion(const Sample& sample) {
  ++counts_.motions;
  const Version& version = *sample.version;
  const Scenario scenario = version.stage.judged(version.key, *version.checker);
  const RefuterOptions options;
  RefuterReport report;
  Judge judge(scenario, options, report);
  judge.motion(scenario.full(sample.from), scenario.full(sample.to), sample.answer, sample.query);
  counts_.oracleStates += report.states;
  counts_.leastRoomOfFree = std::min(counts_.leastRoomOfFree, report.leastRoomOfFree);
  // Its second line is a command for a world that has a file.
  for (const std::string& failure : report.failures)
    fail(sample, failure.substr(0, failure.find('\n')));
}

}  // namespace soak
