// SPDX-License-Identifier: BSD-3-Clause
#include "campaign.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "judge.hpp"

namespace trajectories {

namespace {

using swept::LimitKind;
using swept::MotionQuery;
using swept::Verdict;

swept::RateLimits randomLimits(const Stage& stage, Random& random) {
  swept::RateLimits limits;
  for (const StageVariable& variable : stage.variables) {
    const auto some = [&](double low, double high) {
      return variable.orientation ? std::numeric_limits<double>::infinity()
                                  : random.decades(low, high);
    };
    limits.velocity.push_back(some(-1.0, 1.0));
    limits.acceleration.push_back(some(-1.0, 3.0));
    limits.jerk.push_back(some(0.0, 5.0));
  }
  return limits;
}

void count(Verdict verdict, Tally& tally) {
  ++tally.curves;
  tally.free += verdict == Verdict::Free ? 1 : 0;
  tally.collision += verdict == Verdict::Collision ? 1 : 0;
  tally.undecided += verdict == Verdict::Undecided ? 1 : 0;
}

/// Runs the curves of one stage.
class StageCampaign {
 public:
  StageCampaign(const CampaignOptions& options, std::uint64_t index, CampaignReport& report)
      : options_(options),
        scene_(index % scenes().size()),
        stage_(makeStage(options.seed, index)),
        workspace_(stage_.checker),
        plainWorkspace_(stage_.plain),
        report_(report) {}

  void run(std::uint64_t index) {
    Random random(options_.seed, index);
    const RandomCurve curve =
        makeCurve(stage_, workspace_, plainWorkspace_, random, options_.seconds);
    swept::TrajectoryQuery query;
    query.clock = random.uniform(-2.0, 2.0);
    if (random.chance(0.5)) query.limits = randomLimits(stage_, random);
    const swept::TrajectoryCertificate first = ask(curve, query);
    query.contact = MotionQuery::VerdictOnly;
    const swept::TrajectoryCertificate brief = ask(curve, query);
    Judge judge(stage_, options_.samples, random);
    Judged judged;
    note(index, judge.faultsOf(curve, query, first, judged));
    if (brief.verdict != first.verdict)
      note(index, {"VerdictOnly says " + std::string(toString(brief.verdict)) + ", FirstContact " +
                   std::string(toString(first.verdict))});
    Judged again;
    if (brief.verdict == Verdict::Collision)
      note(index, judge.faultsOf(curve, query, brief, again));
    if (query.limits) note(index, limitFaults(stage_, curve, *query.limits, first));
    tally(curve, first, judged);
  }

 private:
  swept::TrajectoryCertificate ask(const RandomCurve& curve, const swept::TrajectoryQuery& query) {
    return stage_.checker.certifyTrajectory(curve.curve, workspace_, query);
  }

  void note(std::uint64_t index, const std::vector<std::string>& faults) {
    for (const std::string& fault : faults)
      report_.failures.push_back("trajectory_refute --seed " + std::to_string(options_.seed) +
                                 " --first " + std::to_string(index) + " (" + stage_.scene +
                                 "): " + fault);
  }

  void tally(const RandomCurve& curve, const swept::TrajectoryCertificate& found,
             const Judged& judged) {
    count(found.verdict, report_.all);
    if (stage_.widest <= kNarrow) count(found.verdict, report_.narrow);
    count(found.verdict, report_.kinds[static_cast<std::size_t>(curve.kind)]);
    count(found.verdict, report_.scenes[scene_]);
    report_.states += judged.samples;
    report_.near += found.verdict == Verdict::Free && judged.leastRoom < kNear ? 1 : 0;
    report_.beside += found.contact && !found.contact->witness.configuration.empty() ? 1 : 0;
    report_.prefixes +=
        found.verdict != Verdict::Free && found.freeUntil > curve.curve.begin() ? 1 : 0;
    const auto beyond = [&found](bool positions) {
      return std::ranges::any_of(found.violations, [&](const swept::LimitViolation& violation) {
        return (violation.kind == LimitKind::Position) == positions;
      });
    };
    report_.tooFast += beyond(false) ? 1 : 0;
    report_.outside += beyond(true) ? 1 : 0;
  }

  const CampaignOptions& options_;
  const std::size_t scene_;
  const Stage stage_;
  swept::Workspace workspace_, plainWorkspace_;
  CampaignReport& report_;
};

std::string text(const Tally& tally) {
  return std::to_string(tally.curves) + " (" + std::to_string(tally.free) + " free, " +
         std::to_string(tally.collision) + " collision, " + std::to_string(tally.undecided) +
         " undecided)";
}

}  // namespace

void Tally::add(const Tally& other) {
  curves += other.curves;
  free += other.free;
  collision += other.collision;
  undecided += other.undecided;
}

void CampaignReport::add(const CampaignReport& other) {
  all.add(other.all);
  narrow.add(other.narrow);
  for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i].add(other.kinds[i]);
  scenes.resize(trajectories::scenes().size());
  for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i].add(other.scenes[i]);
  near += other.near;
  beside += other.beside;
  prefixes += other.prefixes;
  tooFast += other.tooFast;
  outside += other.outside;
  states += other.states;
  failures.insert(failures.end(), other.failures.begin(), other.failures.end());
}

CampaignReport runCampaign(const CampaignOptions& options) {
  CampaignReport report;
  report.scenes.resize(scenes().size());
  const std::uint64_t end = options.first + options.count;
  for (std::uint64_t index = options.first; index < end;) {
    const std::uint64_t stage = index / options.curvesOfStage;
    StageCampaign curves(options, stage, report);
    for (; index < end && index / options.curvesOfStage == stage; ++index) curves.run(index);
  }
  return report;
}

std::string summary(const CampaignReport& report) {
  std::ostringstream out;
  out << text(report.all) << " curves, " << report.states << " states; " << report.near
      << " of the free ones within 2 cm of contact, " << report.beside
      << " contacts that only the tube has, " << report.prefixes << " prefixes; " << report.tooFast
      << " too fast, " << report.outside << " outside; in narrow tubes " << text(report.narrow)
      << ";";
  for (std::size_t i = 0; i < kKindNames.size(); ++i)
    out << ' ' << kKindNames[i] << ' ' << text(report.kinds[i]) << ';';
  for (std::size_t i = 0; i < report.scenes.size(); ++i)
    out << ' ' << scenes()[i].name << ' ' << text(report.scenes[i]) << ';';
  out << ' ' << report.failures.size() << " refuted";
  return out.str();
}

}  // namespace trajectories
