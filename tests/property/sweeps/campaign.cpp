// SPDX-License-Identifier: BSD-3-Clause
#include "campaign.hpp"

#include <algorithm>
#include <chrono>
#include <sstream>

namespace sweeps {

using swept::ContinuousResult;
using swept::Verdict;

namespace {

double now() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(time).count();
}

ContinuousResult ask(const Sweep& sweep, swept::ContinuousWorkspace& workspace) {
  const auto motionA = sweep.pathA.motion(), motionB = sweep.pathB.motion();
  return continuousCollide(sweep.a.shape, *motionA, sweep.b.shape, *motionB, sweep.options,
                           workspace);
}

std::string described(const ContinuousResult& r) {
  std::ostringstream out;
  out.precision(17);
  out << toString(r.verdict) << " [" << r.freeUntil << ", " << r.contactBy << "], "
      << r.effort.intervals << " intervals";
  return out.str();
}

class Campaign {
 public:
  explicit Campaign(const CampaignOptions& options) : options_(options) {}

  CampaignReport run() {
    for (std::uint64_t i = 0; i < options_.count; ++i) one(options_.first + i);
    return std::move(report_);
  }

 private:
  void one(std::uint64_t index) {
    const Sweep sweep = makeSweep(options_.seed, index);
    Random random(~options_.seed, index);
    const double before = now();
    const ContinuousResult result = ask(sweep, workspace_);
    const double asked = now();
    Judgement judgement = Judge(sweep).judge(result, random);
    if (options_.symmetries > 0 && random.below(options_.symmetries) == 0) {
      otherWays(sweep, result, random, judgement);
    }
    report_.querySeconds += asked - before;
    report_.oracleSeconds += now() - asked;
    report_.slowest = std::max(report_.slowest, asked - before);
    tally(sweep, result, judgement);
    for (const std::string& fault : judgement.faults) {
      report_.failures.push_back(fault + "\n    " + described(result) + "; " +
                                 std::string(kSceneNames[static_cast<int>(sweep.scene)]) + " of " +
                                 std::string(kKindNames[static_cast<int>(sweep.a.kind)]) + " (" +
                                 std::string(kPathNames[static_cast<int>(sweep.pathA.kind)]) +
                                 ") and " +
                                 std::string(kKindNames[static_cast<int>(sweep.b.kind)]) + " (" +
                                 std::string(kPathNames[static_cast<int>(sweep.pathB.kind)]) +
                                 ")\n    sweep_refute --seed " + std::to_string(options_.seed) +
                                 " --first " + std::to_string(index) + " --code");
    }
  }

  /// Swapped, moved, backwards: no two answers contradict each other.
  void otherWays(const Sweep& sweep, const ContinuousResult& result, Random& random,
                 Judgement& judgement) {
    ++report_.symmetries;
    Sweep other = sweep;
    std::swap(other.a, other.b);
    std::swap(other.pathA, other.pathB);
    compare("swapped", result, ask(other, workspace_), true, judgement);
    Isometry3d by = Isometry3d::Identity();
    by.linear() = random.rotation();
    by.translation() = sweep.size * random.inCube();
    other = sweep;
    other.pathA = sweep.pathA.moved(by);
    other.pathB = sweep.pathB.moved(by);
    compare("moved", result, ask(other, workspace_), true, judgement);
    other.pathA = sweep.pathA.reversed();
    other.pathB = sweep.pathB.reversed();
    compare("backwards", result, ask(other, workspace_), false, judgement);
  }

  static void compare(const char* how, const ContinuousResult& one, const ContinuousResult& other,
                      bool sameClock, Judgement& judgement) {
    const bool free = one.verdict == Verdict::Free || other.verdict == Verdict::Free;
    const bool hit = one.verdict == Verdict::Collision || other.verdict == Verdict::Collision;
    const auto complain = [&](const char* what) {
      judgement.faults.push_back(std::string(how) + ": " + what + ": " + described(one) + " and " +
                                 described(other));
    };
    if (free && hit) complain("one free, one in collision");
    constexpr double kRounding = 1e-9;
    if (sameClock && hit && !free &&
        (one.freeUntil > other.contactBy + kRounding ||
         other.freeUntil > one.contactBy + kRounding)) {
      complain("no common first contact");
    }
  }

  void tally(const Sweep& sweep, const ContinuousResult& result, const Judgement& judgement) {
    CampaignReport& r = report_;
    ++r.sweeps;
    ++(result.verdict == Verdict::Free
           ? r.free
           : (result.verdict == Verdict::Collision ? r.collision : r.undecided));
    if (result.effort.intervals >= sweep.options.maxIntervals) ++r.capped;
    if (judgement.contact) ++r.contacts;
    if (result.contactBy == 0.0) ++r.atStart;
    if (judgement.leastGap < 10.0 * sweep.options.tolerance) ++r.close;
    if (sweep.mustBeFree) ++r.mustBeFree;
    if (judgement.width) {
      ++r.crossings;
      r.widest = std::max(r.widest, *judgement.width);
    }
    r.roomiestStop = std::max(r.roomiestStop, judgement.stop);
    r.samples += static_cast<std::uint64_t>(judgement.samples);
    r.mostIntervals =
        std::max(r.mostIntervals, static_cast<std::uint64_t>(result.effort.intervals));
    ++r.scenes[static_cast<int>(sweep.scene)];
    ++r.pairs[static_cast<int>(sweep.a.kind)][static_cast<int>(sweep.b.kind)];
    ++r.paths[static_cast<int>(sweep.pathA.kind)][static_cast<int>(sweep.pathB.kind)];
  }

  CampaignOptions options_;
  CampaignReport report_;
  swept::ContinuousWorkspace workspace_;
};

template <typename Table>
std::uint64_t least(const Table& table) {
  std::uint64_t found = ~std::uint64_t{0};
  for (const auto& row : table) found = std::min(found, *std::min_element(row.begin(), row.end()));
  return found;
}

}  // namespace

CampaignReport runCampaign(const CampaignOptions& options) {
  return Campaign(options).run();
}

void CampaignReport::add(const CampaignReport& o) {
  for (const auto member :
       {&CampaignReport::sweeps, &CampaignReport::free, &CampaignReport::collision,
        &CampaignReport::undecided, &CampaignReport::capped, &CampaignReport::contacts,
        &CampaignReport::atStart, &CampaignReport::close, &CampaignReport::mustBeFree,
        &CampaignReport::symmetries, &CampaignReport::crossings, &CampaignReport::samples}) {
    this->*member += o.*member;
  }
  for (std::size_t i = 0; i < scenes.size(); ++i) scenes[i] += o.scenes[i];
  for (int i = 0; i < kKinds; ++i)
    for (int k = 0; k < kKinds; ++k) pairs[i][k] += o.pairs[i][k];
  for (int i = 0; i < kPathKinds; ++i)
    for (int k = 0; k < kPathKinds; ++k) paths[i][k] += o.paths[i][k];
  widest = std::max(widest, o.widest);
  roomiestStop = std::max(roomiestStop, o.roomiestStop);
  mostIntervals = std::max(mostIntervals, o.mostIntervals);
  slowest = std::max(slowest, o.slowest);
  querySeconds += o.querySeconds;
  oracleSeconds += o.oracleSeconds;
  failures.insert(failures.end(), o.failures.begin(), o.failures.end());
}

std::string summary(const CampaignReport& r) {
  std::ostringstream out;
  out << r.sweeps << " sweeps: " << r.free << " free, " << r.collision << " collision, "
      << r.undecided << " undecided (" << r.capped << " at their cap); " << r.contacts
      << " contacts by construction, " << r.mustBeFree << " free by construction, " << r.atStart
      << " in contact at 0, " << r.close << " proven within ten tolerances of contact; ";
  for (std::size_t i = 0; i < r.scenes.size(); ++i) {
    out << r.scenes[i] << ' ' << kSceneNames[i] << (i + 1 < r.scenes.size() ? ", " : "; ");
  }
  out << "least of " << kKinds * kKinds << " pairs " << least(r.pairs) << ", of "
      << kPathKinds * kPathKinds << " pairs of motions " << least(r.paths) << "; " << r.crossings
      << " straight crossings at most " << r.widest << " tolerances wide, proofs ended at most "
      << r.roomiestStop << " tolerances beyond the margin; " << r.symmetries << " asked four ways; "
      << r.samples << " samples; at most " << r.mostIntervals << " intervals, " << 1e3 * r.slowest
      << " ms; query " << r.querySeconds << " s, oracle " << r.oracleSeconds << " s; "
      << r.failures.size() << " failures";
  return out.str();
}

}  // namespace sweeps
