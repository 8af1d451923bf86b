// SPDX-License-Identifier: BSD-3-Clause
#include "refuter.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "judge.hpp"
#include "random_motions.hpp"

using swept::Verdict;

namespace {

using State = std::vector<double>;

double seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

void refuseBad(const RefuterOptions& options) {
  std::ostringstream out;
  if (!(options.step > 0.0 && std::isfinite(options.step))) {
    out << "step is " << options.step << " rad or m; allowed: finite and above zero";
  } else if (!(options.skew >= 1.0 && std::isfinite(options.skew))) {
    out << "skew is " << options.skew << "; allowed: finite, 1 or more";
  } else if (options.motions < 1) {
    out << options.motions << " motions; allowed: 1 or more";
  } else {
    return;
  }
  throw std::invalid_argument(out.str());
}

}  // namespace

void RefuterReport::add(const RefuterReport& other) {
  motions += other.motions;
  free += other.free;
  collision += other.collision;
  undecided += other.undecided;
  grazing += other.grazing;
  states += other.states;
  leastRoomOfFree = std::min(leastRoomOfFree, other.leastRoomOfFree);
  widestStop = std::max(widestStop, other.widestStop);
  roomiestUndecided = std::max(roomiestUndecided, other.roomiestUndecided);
  undecidedAnywhere += other.undecidedAnywhere;
  checkerSeconds += other.checkerSeconds;
  oracleSeconds += other.oracleSeconds;
  failures.insert(failures.end(), other.failures.begin(), other.failures.end());
}

RefuterReport refute(const Scenario& scenario, const RefuterOptions& options) {
  refuseBad(options);
  RefuterReport report;
  RandomMotions motions(scenario, options.seed, options.skew);
  Judge judge(scenario, options, report);
  swept::Workspace workspace(*scenario.checker);
  for (int i = 0; i < options.motions; ++i) {
    const double start = seconds();
    const auto [from, to] = motions.next();
    const State a = scenario.groupOf(from), b = scenario.groupOf(to);
    const double asked = seconds();
    const auto certificate = scenario.checker->certifyMotion(a, b, workspace);
    const double answered = seconds();
    judge.motion(from, to, certificate);
    if (certificate.verdict == Verdict::Undecided && motions.fromAnywhere()) {
      ++report.undecidedAnywhere;
    }
    if (i % 8 == 0) judge.sameAgain(a, b, certificate);
    report.checkerSeconds += answered - asked;
    report.oracleSeconds += seconds() - answered + (asked - start);
  }
  return report;
}

RefuterReport refuteMotion(const Scenario& scenario, const RefuterOptions& options,
                           const State& from, const State& to) {
  refuseBad(options);
  RefuterReport report;
  swept::Workspace workspace(*scenario.checker);
  const State a = scenario.full(from), b = scenario.full(to);
  Judge(scenario, options, report)
      .motion(a, b, scenario.checker->certifyMotion(from, to, workspace));
  return report;
}

std::string summary(const RefuterReport& r) {
  std::ostringstream out;
  out << r.motions << " motions: " << r.free << " free, " << r.collision << " collision, "
      << r.undecided << " undecided (" << r.undecidedAnywhere << " of the plain ones); "
      << r.grazing << " grazing; " << r.states << " states judged; least room of a free motion "
      << r.leastRoomOfFree << " m; widest stop " << r.widestStop << " m; checker "
      << std::setprecision(3) << r.checkerSeconds << " s, oracle " << r.oracleSeconds << " s; "
      << r.failures.size() << " failures";
  return out.str();
}
