// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/allowed_collision_matrix.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "acm/contact_search.hpp"
#include "acm/never_proof.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "text/numbers.hpp"
#include "threads/for_each_index.hpp"

namespace swept {

namespace {

using detail::ContactSearch;
using detail::KinematicModel;
using detail::LinkChain;
using detail::LinkPieces;
using detail::NeverProof;

/// Share of the budget for a first proof, before the more expensive search for contacts: most pairs
/// are far apart.
constexpr std::int64_t kFirstProof = 16;

/// Of the budget: a fraction of a second.
constexpr std::int64_t kLongestSlice = 500'000;

/// s. A longer time counts as unlimited: no clock can measure it.
constexpr double kLongestTime = 1e8;

/// Share of the budget for all pairs, before the open ones get the whole, if the time is limited.
constexpr std::int64_t kFirstRound = 64;

class Examiner {
 public:
  Examiner(const Robot& robot, const AllowedCollisionMatrixOptions& options)
      : robot_(robot),
        options_(options),
        model_(detail::wholeKinematics(robot)),
        start_(robot.defaultState()),
        end_(Clock::time_point::max()) {
    if (options.seconds < kLongestTime)
      end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double>(options.seconds));
    for (std::size_t i = 0; i < robot.links().size(); ++i)
      pieces_.push_back(detail::piecesOf(robot, model_, static_cast<int>(i)));
    for (std::size_t j = 0; j < robot.joints().size(); ++j) {
      const Joint& joint = robot.joints()[j];
      if (joint.parentLink < 0) continue;
      const auto [a, b] = std::minmax(joint.parentLink, joint.childLink);
      adjacent_.emplace(std::pair{a, b}, static_cast<int>(j));
    }
  }

  std::vector<LinkPairReport> pairs() const {
    std::vector<LinkPairReport> result;
    const int count = static_cast<int>(pieces_.size());
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b) {
        if (pieces_[a].pieces.empty() || pieces_[b].pieces.empty()) continue;
        LinkPairReport report;
        report.linkA = a;
        report.linkB = b;
        result.push_back(std::move(report));
      }
    return result;
  }

  /// Only the links of the report are used. `budget`: that of the options, or less.
  void examine(LinkPairReport& report, std::int64_t budget) const;
  bool isOver() const { return Clock::now() >= end_; }

 private:
  using Clock = std::chrono::steady_clock;

  Eigen::VectorXd configuration(const LinkChain& chain, const ContactSearch::Values& values) const {
    Eigen::VectorXd q = start_;
    for (std::size_t k = 0; k < values.size(); ++k) q[chain.variables()[k]] = values[k];
    return q;
  }
  bool canSample(const LinkPairReport& report) const;
  void classifyContact(ContactSearch& search, std::uint64_t seed, LinkPairReport& report) const;
  void prove(const LinkChain& chain, LinkChain::Place& place, ContactSearch& search,
             std::uint64_t seed, std::int64_t budget, LinkPairReport& report) const;
  NeverProof::State goOn(NeverProof& proof, std::int64_t from, std::int64_t budget) const;
  void contact(const LinkChain& chain, const ContactSearch::Values& values,
               LinkPairReport& report) const {
    report.status = PairStatus::MayCollide;
    report.witness = configuration(chain, values);
  }

  const Robot& robot_;
  const AllowedCollisionMatrixOptions& options_;
  const KinematicModel model_;
  const Eigen::VectorXd start_;
  std::vector<LinkPieces> pieces_;
  std::map<std::pair<int, int>, int> adjacent_;
  Clock::time_point end_;
};

void Examiner::examine(LinkPairReport& report, std::int64_t budget) const {
  const std::pair links(report.linkA, report.linkB);
  report = LinkPairReport();
  std::tie(report.linkA, report.linkB) = links;
  const LinkChain chain(robot_, model_, model_.bodyOfLink[report.linkA],
                        model_.bodyOfLink[report.linkB]);
  report.variables = chain.variables();
  const auto adjacent = adjacent_.find({report.linkA, report.linkB});
  if (adjacent != adjacent_.end()) {
    report.status = PairStatus::Adjacent;
    report.joint = adjacent->second;
    return;
  }
  LinkChain::Place place;
  chain.startFrom(start_, place);
  ContactSearch search(pieces_[report.linkA], pieces_[report.linkB], chain, options_.margin, place);
  // Each pair has its own, so that no pair depends on the number of pairs before it.
  const std::uint64_t seed = (std::uint64_t{options_.seed} << 32) +
                             (static_cast<std::uint64_t>(report.linkA) << 16) +
                             static_cast<std::uint64_t>(report.linkB);
  ContactSearch::Values atStart;
  for (const int v : chain.variables()) atStart.push_back(start_[v]);
  if (search.isContact(atStart)) {
    report.witness = start_;
    report.nearest = search.least();
    classifyContact(search, seed, report);
  } else if (isOver()) {
    report.outOfTime = true;
  } else {
    prove(chain, place, search, seed, budget, report);
    report.nearest = search.least();
  }
}

/// Values without limits, those of planar and floating joints, cannot be sampled.
bool Examiner::canSample(const LinkPairReport& report) const {
  return options_.samples > 0 && std::ranges::all_of(report.variables, [this](int v) {
           return std::isfinite(robot_.variables()[v].upper - robot_.variables()[v].lower);
         });
}

void Examiner::classifyContact(ContactSearch& search, std::uint64_t seed,
                               LinkPairReport& report) const {
  const bool apart = search.findApart(options_.samples, seed).has_value();
  // Without samples only the default state is known, unless it is the only state.
  const bool looked = report.variables.empty() || canSample(report);
  report.status = looked && !apart ? PairStatus::Always : PairStatus::Default;
}

void Examiner::prove(const LinkChain& chain, LinkChain::Place& place, ContactSearch& search,
                     std::uint64_t seed, std::int64_t budget, LinkPairReport& report) const {
  if (const auto found = search.findContact(options_.samples, seed)) {
    contact(chain, *found, report);
    return;
  }
  const LinkPieces& a = pieces_[report.linkA];
  const LinkPieces& b = pieces_[report.linkB];
  if (!chain.bounded() || !a.covered() || !b.covered()) {
    if (const auto found = search.descend({})) contact(chain, *found, report);
    return;
  }
  NeverProof proof(a, b, chain, options_.margin, place);
  NeverProof::State state = proof.run(budget / kFirstProof);
  if (state != NeverProof::State::Proven) {
    if (const auto found = search.descend(proof.nearest())) {
      contact(chain, *found, report);
    } else if (state == NeverProof::State::Open) {
      state = goOn(proof, budget / kFirstProof, budget);
    }
  }
  report.proven = proof.share();
  report.effort = proof.effort();
  report.outOfTime = state == NeverProof::State::Open && report.effort < budget;
  if (state == NeverProof::State::Proven) {
    report.status = PairStatus::Never;
    report.proven = 1.0;
  } else if (!report.witness) {
    if (const auto found = search.descend(proof.nearest())) contact(chain, *found, report);
  }
  report.outOfTime = report.outOfTime && !report.witness;
}

/// In slices that are at most as long as the work before them, so that the end of the time is
/// noticed.
NeverProof::State Examiner::goOn(NeverProof& proof, std::int64_t from, std::int64_t budget) const {
  NeverProof::State state = NeverProof::State::Open;
  for (std::int64_t upTo = from; upTo < budget && state == NeverProof::State::Open && !isOver();) {
    upTo = std::min(budget, upTo + std::clamp<std::int64_t>(upTo, 1, kLongestSlice));
    state = proof.run(upTo);
  }
  return state;
}

/// Reports are updated one by one.
class Progress {
 public:
  Progress(const AllowedCollisionMatrixOptions& options, std::size_t all)
      : options_(options), all_(all) {}
  void done() {
    if (!options_.progress) return;
    const std::lock_guard lock(mutex_);
    options_.progress(++done_, all_);
  }

 private:
  const AllowedCollisionMatrixOptions& options_;
  const std::size_t all_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

bool isOpen(const LinkPairReport& report, std::int64_t budget) {
  return report.status == PairStatus::Unknown && report.effort >= budget;
}

void requireUsable(const AllowedCollisionMatrixOptions& options) {
  if (!(options.margin >= 0.0) || !std::isfinite(options.margin)) {
    throw std::invalid_argument("computeAllowedCollisionMatrix: margin " +
                                detail::formatNumber(options.margin) +
                                " m must be a finite number that is not negative");
  }
  const auto requireCount = [](const std::string& what, std::int64_t count) {
    if (count >= 0) return;
    throw std::invalid_argument("computeAllowedCollisionMatrix: " + what + " " +
                                std::to_string(count) + " must not be negative");
  };
  if (!(options.seconds > 0.0))
    throw std::invalid_argument("computeAllowedCollisionMatrix: seconds " +
                                detail::formatNumber(options.seconds) + " must be above 0");
  requireCount("budget", options.budget);
  requireCount("samples", options.samples);
}

}  // namespace

std::string_view toString(PairStatus status) {
  switch (status) {
    case PairStatus::Unknown:
      return "unknown";
    case PairStatus::Adjacent:
      return "adjacent";
    case PairStatus::Never:
      return "never";
    case PairStatus::MayCollide:
      return "may collide";
    case PairStatus::Default:
      return "default";
    case PairStatus::Always:
      return "always";
  }
  return "unknown";
}

std::vector<LinkPairReport> computeAllowedCollisionMatrix(
    const Robot& robot, const AllowedCollisionMatrixOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return computeAllowedCollisionMatrix(robot, options); });
  }
  requireUsable(options);
  const Examiner examiner(robot, options);
  std::vector<LinkPairReport> reports = examiner.pairs();
  Progress progress(options, reports.size());
  const bool limited = options.seconds < kLongestTime;
  const std::int64_t first = limited ? options.budget / kFirstRound : options.budget;
  std::vector<std::size_t> open;
  detail::forEachIndex(reports.size(), options.threads, [&](std::size_t i) {
    examiner.examine(reports[i], first);
    if (!limited || reports[i].outOfTime || !isOpen(reports[i], first)) progress.done();
  });
  if (!limited) return reports;
  for (std::size_t i = 0; i < reports.size(); ++i)
    if (!reports[i].outOfTime && isOpen(reports[i], first)) open.push_back(i);
  detail::forEachIndex(open.size(), options.threads, [&](std::size_t i) {
    LinkPairReport& report = reports[open[i]];
    if (examiner.isOver())
      report.outOfTime = true;
    else
      examiner.examine(report, options.budget);
    progress.done();
  });
  return reports;
}

}  // namespace swept
